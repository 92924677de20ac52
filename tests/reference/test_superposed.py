"""What deserves a look beside causes that are there: effects add to first order, and what is left out would not have been best."""

from itertools import combinations

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.search import looks as searched
from mouse_cli.diagnosis.search.added_up import Effects
from mouse_cli.diagnosis.search.descents import tried
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.moves import centred, renamed, together
from mouse_cli.diagnosis.search.study import MOVED, Study
from mouse_cli.diagnosis.search.superposed import KEPT, Alone, chosen
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

N = 24
K = 100e3 * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))  # equal masses of 1 kg between two walls


def chain_with(at: dict[int, float], springs: dict[int, float]) -> Reduced:
    """The chain, and six modes of it with masses (kg) and springs (N/m) added, by an eigensolution of the whole here."""
    truth = dense_solution(
        K + np.diag([springs.get(i, 0.0) for i in range(N)]), np.diag([1 + at.get(i, 0.0) for i in range(N)])
    )
    hz, shapes = np.sqrt(truth.eigenvalues[:6]) / (2 * np.pi), truth.shapes[:, :6]
    test = ModalTest(np.arange(1, 7), hz, 1e-3 * hz, np.arange(N), shapes, np.full((N, 6), 0.003))
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    prior = Gaussian(np.ones(1), np.array([0.03**2]))
    parameters = (Parameter("factor", 0.03, 1.0),)
    deck = Problem("chain", Structure(K, np.eye(N)), listed, K[row, col][:, None], parameters, prior, test)
    return reduced(deck, prior.mean)


def test_effects_add():
    """Of three places, what adds to the cause there to make the data is chosen, not what explains most by itself."""
    data = np.array([1.0, 0.6, 0.0, 0.0])
    there = np.array([1.0, 0.0, 0.0, 0.0])  # what the cause that is there explains
    effects = np.array([[0.9, 0.0, 0.0, 0.0], [0.0, 0.55, 0.0, 0.0], [0.0, 0.0, 0.3, 0.0]])
    sites = [(f"{i}", size) for i in range(3) for size in range(KEPT // 2)]
    alone = Alone(sites, np.repeat(data - effects, KEPT // 2, axis=0) + 1e-9, data)
    found = chosen(alone, data - there, np.zeros(0), np.zeros((4, 0)), np.zeros((0, 4)), KEPT)
    assert len(found) <= KEPT
    assert {text for text, _ in found} >= {"1"}
    assert sum(text == "1" for text, _ in found) == KEPT // 3


@pytest.fixture
def by_themselves():
    """Ten places and sizes of each of two candidates, T of two parameters, and how far these follow."""
    rng = np.random.default_rng(5)
    none, T = 3 * rng.standard_normal(12), rng.standard_normal((12, 2))
    alone = {
        name: Alone([(f"{name}{i // 2}", i % 2) for i in range(10)], none + rng.standard_normal((10, 12)), none)
        for name in "ab"
    }
    return alone, T, np.linalg.solve(T.T @ T + np.eye(2), np.hstack([T.T, -np.eye(2)]))


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("kind", ["", "b"])
def test_of_all_sets_those_that_add_up_best_lead(count, kind, by_themselves):
    """Beside every set the parameters of the deck adapt, here by least squares for each of them in turn."""
    alone, T, adapted = by_themselves
    none = alone["a"].none
    every = [(name, at, alone[name].residuals[i]) for name in "ab" if kind in ("", name) for i, at in enumerate(alone[name].at)]
    stacked = np.vstack([T, np.eye(2)])
    left = {}
    for some in combinations(every, count):
        if len({(name, place) for name, (place, _), _ in some}) == count:  # two of one kind at one place are one
            r = none + sum(residual - none for *_, residual in some)
            cost = np.linalg.lstsq(stacked, np.concatenate([r, np.zeros(2)]), rcond=None)[1][0]
            left[frozenset((name, at) for name, at, _ in some)] = cost
    found = Effects(alone, T, adapted).sets(count, kind)
    best = min(left, key=left.get)
    assert frozenset(found[0][1]) == best
    assert found[0][0] == pytest.approx(left[best], rel=1e-4)
    assert [cost for cost, *_ in found] == sorted(cost for cost, *_ in found)
    assert all(left[frozenset(members)] == pytest.approx(cost, rel=1e-4) for cost, members, _ in found)


def test_effects_beyond_all_measure_are_no_fault(by_themselves):
    alone, T, adapted = by_themselves
    alone["a"].residuals[3] *= 1e30
    with np.errstate(over="raise", invalid="raise"):
        found = Effects(alone, T, adapted).sets(2)
    assert all(np.isfinite(cost) for cost, *_ in found)


def looked_at(*names: str) -> Study:
    """Of a chain with a mass and a spring too many, that has looked at these candidates."""
    study = Study(chain_with({5: 0.4}, {16: 4e3}))
    for name in names:
        study.coarse.looks(name, np.zeros(study.k), ())
    return study.coarse


def test_two_that_hide_one_another_are_begun_together():
    begun = together(looked_at("mass", "ground-spring", "oscillator"), 2, 4)
    assert ["6", "17"] in [sorted((one.site(one.grid[0]).ids[0] for one in recipes), key=int) for recipes, _ in begun]
    assert all(len(c) == sum(len(one.unknowns) for one in recipes) for recipes, c in begun)


def test_sets_of_one_kind_are_of_that_kind_alone():
    study = looked_at("mass", "ground-spring")
    for count in (2, 3):
        begun = together(study, count, 4, "mass")
        assert begun and all([one.candidate.key for one in recipes] == ["mass"] * count for recipes, _ in begun)
    assert together(study, 2, 4, "oscillator") == []


def test_a_set_is_given_another_name_as_a_whole():
    """Two springs at the places of two masses: with one of them for a mass it is no better."""
    study = Study(chain_with({5: 0.4, 16: 0.6}, {}))
    at = lambda name, node: next(each for each in study.recipes(name) if each.site(each.grid[0]).ids == (node,))
    springs = study.kind(study.model, (at("ground-spring", "6"), at("ground-spring", "17")))
    one = fit(springs, np.concatenate([each.coordinates(each.grid[0]) for each in springs.recipes]), np.zeros(study.k))
    masses = renamed(study, one, "mass")
    assert [site.ids for site in masses.sites] == [("6",), ("17",)] and masses.misfit < 1e-3 < one.misfit
    assert renamed(study, one, "crack") is None


def test_what_was_looked_at_at_several_places_together_only_is_in_no_pair():
    """As where all sizes at single places were passed over for several feet at once: the others pair without it."""
    before = [tuple(each.site(each.grid[0]).text for each in recipes) for recipes, _ in together(looked_at("mass"), 2, 4)]
    study = looked_at("mass")
    none = study.alone["mass"].none
    study.alone["oscillator"] = Alone([("6 and 17", 0)], none[None, :] + 1, none)
    after = [tuple(each.site(each.grid[0]).text for each in recipes) for recipes, _ in together(study, 2, 4)]
    assert after == before != []


@pytest.mark.parametrize("name", ["ground-spring", "oscillator", "mass"])
def test_the_best_look_beside_a_cause_is_among_those_that_are_taken(name, monkeypatch):
    """At most so many of all places and sizes are looked at exactly, and the best of all of them is one."""
    few_at_most = 64
    monkeypatch.setattr(searched, "KEPT", few_at_most)
    model = chain_with({5: 0.4}, {16: 4e3})
    study = Study(model)
    first = tried(study, "mass", (), np.zeros(study.k), 1)[0][0]
    assert "6" in first.recipes[0].site(first.recipes[0].values(first.c)).text
    few = study.looks(name, first.point.x, first.recipes)
    monkeypatch.setattr(searched, "KEPT", 10**9)
    all_of_them = Study(model).looks(name, first.point.x, first.recipes)
    assert len(few) <= few_at_most < len(all_of_them)
    assert few[0][0] == pytest.approx(all_of_them[0][0], rel=1e-9)


def test_what_the_deck_alone_decides_is_built_once_for_all_parameters():
    model = chain_with({5: 0.4}, {})
    there = model.at(1.02 * model.theta)
    built = []
    first = model.once("the deck", lambda problem: built.append(problem) or problem)
    again = there.once("the deck", lambda problem: built.append(problem) or problem)
    assert first[1] is again[1] and len(built) == 1


def test_what_is_there_adapts_to_what_is_looked_at():
    """A mass half too large, which makes up for a spring: beside the true spring it is right again, and nothing is left.

    Held as it is, it would hide which spring is the true one, and whether it is a spring.
    """
    study = Study(chain_with({5: 0.4}, {16: 4e3}))
    number = next(one.number for one in study.recipes("mass") if one.site(one.grid[0]).ids == ("6",))
    there = study.with_cause((), "mass", number)
    (mass,) = there.recipes
    first = fit(there, mass.coordinates(np.array([0.6])), most=0)
    spring = next(one for one in study.recipes("ground-spring") if one.site(one.grid[0]).ids == ("17",))
    both = study.with_cause(first.recipes, "ground-spring", spring.number)
    at = both.point(np.concatenate([first.point.x, spring.coordinates(np.array([4e3]))]))
    assert study.predicted(at, first.point.x, first.recipes) < 10
    assert study.predicted(at) > 500  # the deck's parameters alone


@pytest.mark.parametrize(("stiffness", "turned"), [(40.0, False), (4e4, True)])
def test_effects_add_up_beside_what_turns_the_modes(stiffness, turned):
    """What is promised beside a spring that turns the modes is what is found there, once that is where effects add up from."""
    model = chain_with({5: 0.4}, {16: stiffness})
    study = Study(model)
    first = tried(study, "ground-spring", (), np.zeros(study.k), 1)[0][0]
    coarse, x = study.about(first).coarse, first.point.x
    assert coarse.turned(x, first.recipes) == turned
    before = coarse.promise("mass", x, first.recipes)
    centred(study, first)
    found = coarse.looks("mass", x, first.recipes)[0][0]
    assert coarse.promise("mass", x, first.recipes) == pytest.approx(found if turned else before, rel=1e-6)
    assert not turned or abs(before / found - 1) > 0.1


def test_where_causes_are_weighed_depends_on_the_fit_alone():
    """Processes of a pool have other fits behind them: within the same trifle they would weigh causes at other parameters."""
    model = chain_with({5: 0.4}, {})
    at = lambda z: fit(Model(model), np.zeros(0), np.array([z]), most=0)
    asked, fresh = Study(model), Study(model)
    asked.about(at(0.5))
    apart = MOVED / 0.03  # of the prior sd of the factor
    theta = [each.about(at(0.5 + 0.6 * apart)).model.theta for each in (asked, fresh)]
    assert theta[0].tobytes() == theta[1].tobytes()
    assert abs(theta[0][0] - model.parameters(np.array([0.5 + 0.6 * apart]))[0]) <= MOVED * 1.000001
