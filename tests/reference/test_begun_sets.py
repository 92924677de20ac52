"""Sets that begin early, where no leading mechanism explains the data alone: which, and when."""

from types import SimpleNamespace

import pytest

from mouse_cli.diagnosis.search import alone as early
from mouse_cli.diagnosis.search.found import Found
from mouse_cli.diagnosis.search.rank import _once
from mouse_cli.model.diagnosis import Site

GROUPS = {"turns": "support", "in-a-wall": "support", "mass": "mass"}


def of(nats: float, misfit: float, *names: str) -> SimpleNamespace:
    """A fit of so many mechanisms on 100 degrees of freedom."""
    recipes = tuple(SimpleNamespace(candidate=SimpleNamespace(key=name, group=GROUPS[name]), parts=()) for name in names)
    sites = (Site("node", ()),) * len(names)
    return SimpleNamespace(log_evidence=nats, misfit=misfit, dof=100, recipes=recipes, sites=sites, errs_alike=False)


@pytest.fixture
def asked(monkeypatch):
    """What is begun, and what is exchanged for what; pairs leave `pair`, three of one kind what is in `three`."""
    told = SimpleNamespace(begun=[], exchanged=[], renamed=[], pair=of(-900.0, 1800.0, "mass", "turns"), three={})

    def added_up(study, count, found, smaller, kind="", most=16):
        told.begun.append((count, kind))
        one = told.three.get(kind) if count == 3 else told.pair if not kind else None
        if one is not None:
            found[tuple(recipe.candidate.key for recipe in one.recipes)] = one

    def exchanged(study, one, names):
        told.exchanged.append((one, names))
        return of(-60.0, 100.0, "turns", "turns", "turns")

    monkeypatch.setattr(early, "added_up", added_up)
    monkeypatch.setattr(early, "exchanged", exchanged)
    monkeypatch.setattr(early, "renamed", lambda study, one, name: told.renamed.append(name))
    return told


STUDY = SimpleNamespace(known={name: SimpleNamespace(group=group) for name, group in GROUPS.items()})


def test_a_pair_that_explains_the_data_is_enough(asked):
    asked.pair = of(-60.0, 100.0, "mass", "turns")
    early._begin(STUDY, Found(), [], 4)
    assert asked.begun == [(2, "")] and not asked.exchanged


def test_else_two_and_three_of_each_kind_begin_and_those_of_one_group_are_exchanged_within_it(asked):
    """Of three feet in elastic walls at the right places, each turns."""
    asked.three["in-a-wall"] = of(-300.0, 600.0, "in-a-wall", "in-a-wall", "in-a-wall")
    begun = Found()
    early._begin(STUDY, begun, [], 4)
    assert asked.begun == [(2, ""), *((count, name) for name in GROUPS for count in (2, 3))]
    assert asked.exchanged == [(asked.three["in-a-wall"], ("turns", "in-a-wall"))]
    assert asked.renamed == ["turns"] and ("turns", "turns", "turns") in begun


def test_what_is_of_several_groups_is_left_as_it_is_and_no_more_begin_than_may_be_together(asked):
    early._begin(STUDY, Found(), [], 2)
    assert {count for count, _ in asked.begun} == {2} and not asked.exchanged


def test_a_set_that_was_found_as_one_of_more_parts_is_one():
    """In another order too; what has no name, and the model as it is, stay each for itself."""

    def fit(nats: float, *names: str, nameless: object = None) -> SimpleNamespace:
        sites = tuple(Site("node", (len(name),)) for name in names)
        return SimpleNamespace(**vars(of(nats, 1.0, *names)) | {"sites": sites, "nameless": nameless})

    none, field, other = fit(0.0), fit(3.0, nameless=1), fit(2.0, nameless=1)
    one, again, alone = fit(5.0, "mass", "turns"), fit(6.0, "turns", "mass"), fit(1.0, "mass")
    assert _once([none, one, field, again, other, alone]) == [none, field, again, other, alone]
