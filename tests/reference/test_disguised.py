"""Sets of mechanisms that are a field in disguise: fits made up here, on a beam of ten bars."""

from types import SimpleNamespace

import pytest
from made_up_rankings import made_up, ranked

from mouse_cli.diagnosis import verdict as decided
from mouse_cli.diagnosis.search.disguised import disguised
from mouse_cli.diagnosis.search.rank import group
from mouse_cli.diagnosis.verdict import decide, judge
from mouse_cli.model.diagnosis import NAMED, UNKNOWN


@pytest.mark.parametrize(
    ("both", "key"),
    [
        (("soft@0.2:0-2", "soft@0.3:2-4"), "field-stiffness"),  # a bar in common
        (("soft@0.1:0-1", "soft@0.3:2-4"), "field-stiffness"),  # bars that meet
        (("soft@0.1:0-1", "soft@0.4:3-4"), None),
        (("soft@0.1:0-1", "support@0.0"), None),
        (("mass@0.50", "mass@0.54"), "field-mass"),
        (("mass@0.50", "mass@0.56"), None),
        (("ground-spring@0.50", "ground-spring@0.54"), "field-bed"),
        (("ground-spring@0.50", "mass@0.50"), None),
        (("mass", "mass"), None),  # without coordinates nobody knows
        (("soft@0.1:0-1",), None),
    ],
)
def test_several_of_one_group_that_touch(both, key):
    assert disguised(made_up(*both)) == key
    assert disguised(made_up(*both[::-1])) == key
    assert disguised(made_up("axial", *both)) == key


def test_laws_of_recordings_are_no_field():
    """Two springs that touch, fitted to recordings: no change of K or M, and no coordinates of a modal model."""
    part = SimpleNamespace(candidate=SimpleNamespace(group="stiffness"))
    assert disguised(SimpleNamespace(recipes=(part, part), nameless=None, data=None)) is None


def test_its_probability_is_that_of_the_field(monkeypatch):
    """Two stretches that touch lead; neither they nor a field of stiffness give a name, and the field is shown."""
    monkeypatch.setattr(decided, "unmeasured_hz", lambda one: ())
    monkeypatch.setattr(decided, "held_out", lambda model, baseline, best: None)
    monkeypatch.setattr(decided, "averaged", lambda model, ranking: None)
    bare, field = made_up(misfit=90.0), made_up(nameless="field-stiffness")
    touching, apart = made_up("soft@0.1:0-1", "soft@0.2:2-2"), made_up("soft@0.1:0-1", "soft@0.8:7-8")
    given = {"p": (0.96, 0.035, 0.005), "odds": (9.0, 6.0, 0.0)}
    ranking = ranked(touching, field, bare, **given)
    assert ranking.groups[0] == ("field-stiffness", pytest.approx(0.995)) and group(touching) == "field-stiffness"
    found = judge(ranking, True, None)
    assert (found.kind, found.field) == (UNKNOWN, field)
    assert decide(ranked(apart, field, bare, **given))[0] == NAMED
