"""What misleads a search for causes: modes that nobody measured, places that are counted otherwise at other parameters."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.unseen import unseen
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search import study
from mouse_cli.diagnosis.search.alike import _may_rival
from mouse_cli.diagnosis.search.descents import best as likeliest
from mouse_cli.diagnosis.search.descents import settled, tried
from mouse_cli.diagnosis.search.fit import descended, fit
from mouse_cli.diagnosis.search.found import Found
from mouse_cli.diagnosis.search.optima import distinct
from mouse_cli.diagnosis.search.several import _begun
from mouse_cli.diagnosis.search.starts import surrounding
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

K = 100e3 * (2 * np.eye(5) - np.eye(5, k=1) - np.eye(5, k=-1))  # five equal masses of 1 kg between two walls


def chain(count_from: int) -> Reduced:
    """The chain and its three lowest modes, which the test counts from `count_from`."""
    lam, X = eigh(K, np.eye(5))
    hz, shapes = np.sqrt(lam[:3]) / (2 * np.pi), X[:, :3]
    numbers = np.arange(count_from, count_from + 3)
    test = ModalTest(numbers, hz, 1e-3 * hz, np.arange(5), shapes, np.full((5, 3), 0.01))
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    prior = Gaussian(np.ones(1), np.array([0.05**2]))
    parameters = (Parameter("factor", 0.05, 1.0),)
    deck = Problem("chain", Structure(K, np.eye(5)), listed, K[row, col][:, None], parameters, prior, test)
    return reduced(deck, prior.mean)


def with_oscillator(model: Reduced, hz: float, kg: float):
    """The model with an oscillator on its second mass, nothing fitted."""
    recipe = Study(model).recipes("oscillator")[1]
    return fit(Model(model, (recipe,)), recipe.coordinates(np.array([kg, hz])), most=0)


def test_an_oscillator_below_all_measured_modes_would_have_been_seen():
    """One of 1 kg at half the first frequency moves the chain with it; r from the modes of the six masses, solved here."""
    model = chain(1)
    hz = 0.5 * model.data.test.frequency_hz[0]
    arm = np.array([0, 1, 0, 0, 0, -1.0])
    _, X = eigh(np.pad(K, (0, 1)) + (2 * np.pi * hz) ** 2 * np.outer(arm, arm), np.eye(6))
    size = np.abs(X[:5]).max(axis=0)
    expected = np.log1p((size[0] / np.median(size[1:4]) / 0.03) ** 2)
    assert expected > 3
    assert unseen(with_oscillator(model, hz, 1.0)) == pytest.approx(expected, rel=1e-6)


def test_a_mode_that_the_test_counts_is_no_evidence():
    model = chain(2)
    assert unseen(with_oscillator(model, 0.5 * model.data.test.frequency_hz[0], 1.0)) == 0.0


def test_an_oscillator_above_the_measured_modes_is_not_expected_to_be_seen():
    model = chain(1)
    assert unseen(with_oscillator(model, 1.4 * model.data.test.frequency_hz[2], 0.05)) == 0.0


def test_a_cause_keeps_its_place_where_places_are_counted_otherwise():
    """A candidate that lists its places by how much they matter, which depends on the parameters."""
    candidate, model = registry()["ground-spring"], chain(1)

    def reversed_elsewhere(here: Reduced, own):
        found = candidate.recipes(here, own)
        return found if here.theta[0] == 1.0 else found[::-1]

    study = Study(model, {"ground-spring": replace(candidate, recipes=reversed_elsewhere)})
    recipe = study.recipes("ground-spring")[1]
    one = fit(Model(model, (recipe,)), recipe.coordinates(np.array([1e3])), np.array([2.0]), most=0)
    (same,) = study.at(one).own((recipe,))
    assert same.site(np.array([1e3])).text == recipe.site(np.array([1e3])).text
    assert same.number == 3


class Curve:
    """A model of one place c, counted in units of 1/`per`, whose whitened residual is f(c) (q,)."""

    k, t, recipes = 0, 1, ()

    def __init__(self, f, per: float = 1.0):
        self.f, self.per = f, per
        self.width, self.bounds = np.array([8.0 * per]), np.array([[-4.0, 4.0]]) * per
        data = SimpleNamespace(slack=0.0, dof=1000)
        self.base = SimpleNamespace(z=np.zeros(0), data=data)

    def point(self, x):
        residual = self.f(x[0] / self.per)
        return SimpleNamespace(x=x, residual=residual, chi2=float(residual @ residual), nats=0.0, free=0.0)

    def jacobian(self, at):
        h = 1e-6
        c = at.x[0] / self.per
        return ((self.f(c - h) - self.f(c + h)) / (2 * h * self.per))[:, None]

    def curvature(self, at):
        return 0.0

    def loosened(self, at, share):
        return None


T = np.linspace(-4, 4, 60)


def bump(c: float) -> np.ndarray:
    """A pulse at 0 less one at c, of large amplitude: pulses that hardly overlap promise little."""
    return 40 * (np.exp(-0.5 * (T / 0.5) ** 2) - np.exp(-0.5 * ((T - c) / 0.5) ** 2))


def test_a_search_that_gains_is_not_given_up():
    """A full step promises a tenth of what is to be gained, which goes down to nothing."""
    start = np.array([1.1])
    first = fit(Curve(bump), start, most=0)
    one = fit(Curve(bump), start, reach=first.misfit / 50)
    assert one.misfit < 1e-3


def test_a_search_without_hope_is_given_up():
    """Where the misfit stays far above reach at every step, few are taken."""
    asked = []

    def flat(c: float) -> np.ndarray:
        asked.append(c)
        return np.array([100.0, 0.1 * np.arctan(c - 3)])

    fit(Curve(flat), np.array([-3.0]), reach=50.0)
    assert len(asked) < 30


@pytest.mark.parametrize("per", [1.0, 1e3, 1e-3])
@pytest.mark.parametrize(
    ("f", "count"), [(lambda c: np.array([3 * c**2]), 1), (lambda c: np.array([6 * (c**2 - 1)]), 2)]
)
def test_an_optimum_counts_once_in_any_units(f, count, per):
    """A flat valley from either side, and two valleys: descents that end early at 0.6 in the first, at +-1 in the second."""
    ends = [fit(Curve(f, per), np.array([side * c * per]), most=0) for side, c in ((1, 0.6), (-1, 0.6))]
    if count == 2:
        ends = [fit(Curve(f, per), np.array([side * 0.8 * per])) for side in (1, -1)]
    assert len(distinct(ends)) == count


def pair_of_oscillators(lower: float, upper: float) -> Reduced:
    """Two masses on springs of nearly one stiffness, weakly coupled, as measured with the factors `lower` and `upper` on those."""
    k, coupling = 1e4 * np.array([1.0, 0.98]), 30.0 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    lam, X = eigh(np.diag(k * [lower, upper]) + coupling)
    hz = np.sqrt(lam) / (2 * np.pi)
    test = ModalTest(np.arange(1, 3), hz, 2e-3 * hz, np.arange(2), X, np.full((2, 2), 0.02))
    listed = ListedElements(np.zeros(2, bool), np.arange(2), np.arange(2))
    prior = Gaussian(np.ones(2), np.full(2, 0.05**2))
    parameters = (Parameter("first", 0.05, 1.0), Parameter("second", 0.05, 1.0))
    deck = Problem("pair", Structure(np.diag(k) + coupling, np.eye(2)), listed, np.diag(k), parameters, prior, test)
    return reduced(deck, prior.mean)


@pytest.mark.parametrize("factors", [(1.0, 1.0), (1.02, 0.98), (0.98, 1.02)])
def test_close_modes_that_must_pass_one_another_do(factors):
    """Paired by shape, frequencies pull them against each other: a descent stopped at a misfit of 355 before they passed."""
    model = pair_of_oscillators(*factors)
    one = settled(fit(Model(model), np.zeros(0)), Study(model))
    assert one.misfit < 1
    np.testing.assert_allclose(model.parameters(one.point.x), factors, atol=5e-3)


def long_chain(place: int, kg: float) -> Reduced:
    """Sixty masses between two walls as measured with one more on them; the stiffness of all is known to 3 %."""
    n = 60
    K = 1e5 * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    lam, X = eigh(1.02 * K, np.eye(n) + kg * np.diag(np.arange(n) == place))
    hz, at = np.sqrt(lam[:4]) / (2 * np.pi), np.arange(4, n, 5)
    shapes = X[at, :4] / np.abs(X[at, :4]).max(axis=0)
    test = ModalTest(np.arange(1, 5), hz, 1e-3 * hz, at, shapes, np.full(shapes.shape, 0.01))
    row, col = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(row), bool), row, col)
    prior = Gaussian(np.ones(1), np.array([0.03**2]))
    parameters = (Parameter("factor", 0.03, 1.0),)
    return reduced(
        Problem("long", Structure(K, np.eye(n)), listed, K[row, col][:, None], parameters, prior, test), prior.mean
    )


def test_the_true_place_gets_on_from_behind(monkeypatch):
    """Few coordinates may see it behind others: here it is the last of six."""
    study = Study(long_chain(17, 3.0))
    few = study.coarse
    assert few is not study
    found = few.approached("mass", np.zeros(1), ())[:6]
    behind = [(1e3 * n, i, x) for n, (_, i, x) in enumerate(found[::-1])]
    monkeypatch.setattr(few, "approached", lambda *given: behind)
    (best, *_) = sorted(tried(study, "mass", (), np.zeros(study.k), 2)[0], key=lambda one: one.misfit)
    assert "18" in best.recipes[0].site(best.recipes[0].values(best.c)).text
    assert best.misfit < 5


def net(rows: int, cols: int, at: int | None) -> Reduced:
    """Unit masses on a net of springs that is held at one edge, and six modes of it with an oscillator at mass `at`, or none."""
    line = lambda n, ends: np.diag(np.r_[ends[0], 2 * np.ones(n - 2), ends[1]]) - np.eye(n, k=1) - np.eye(n, k=-1)
    K = 1e4 * (np.kron(line(rows, (2, 1)), np.eye(cols)) + 0.7 * np.kron(np.eye(rows), line(cols, (1, 1))))
    n, kg = len(K), 8.0 if at is not None else 1e-9
    own = kg * eigh(K, eigvals_only=True)[0] if at is not None else 1.0
    whole, mass = np.zeros((n + 1, n + 1)), np.diag(np.r_[np.ones(n), kg])
    whole[:n, :n] = K
    whole[np.ix_([at or 0, n], [at or 0, n])] += own * np.array([[1, -1], [-1, 1]])
    lam, X = eigh(whole, mass, subset_by_index=[0, 5])
    hz, seen = np.sqrt(lam) / (2 * np.pi), np.arange(4, n, n // 8)
    shapes = X[seen]
    sd = 0.01 * np.abs(shapes).max(axis=0) * np.ones_like(shapes)
    test = ModalTest(np.arange(1, 7), hz, 2e-3 * hz, seen, shapes, sd)
    row, col = np.divmod(np.arange(n), cols)
    places = np.stack([row, col, np.zeros(n)], axis=1)
    geometry = Geometry(np.arange(1, n + 1), places, np.arange(n), np.full(n, 2), np.zeros((0, 2)))
    i, j = np.nonzero(np.triu(K))
    listed = ListedElements(np.zeros(len(i), bool), i, j)
    prior, parameters = Gaussian(np.ones(1), np.array([0.05**2])), (Parameter("factor", 0.05, 1.0),)
    structure = Structure(K, np.eye(n), geometry=geometry, labels=geometry.labels())
    return reduced(Problem("net", structure, listed, K[i, j][:, None], parameters, prior, test), prior.mean)


def test_places_around_the_best_are_tried_whatever_a_first_look_makes_of_them(monkeypatch):
    """The true place and those beside it are kept from every start: each is the next one of a place that is tried."""
    at = 60
    few = Study(net(11, 9, at)).coarse
    recipes = few.recipes("oscillator")
    place = [int(one.site(one.grid[0]).ids[0].removesuffix("TZ")) - 1 for one in recipes]
    hidden = {i for i, one in enumerate(place) if abs(one - at) in (0, 1, 9)}
    assert len(hidden) == 5 and len(recipes) == 99
    known, led = study.spread, few.looks("oscillator", np.zeros(1), ())
    seen = lambda starts: starts if len(starts) < len(led) else [each for each in starts if each[0] not in hidden]
    monkeypatch.setattr(study, "spread", lambda starts, trials, most: known(seen(starts), trials, most))
    left, best, _ = few.approached("oscillator", np.zeros(1), ())[0]
    assert place[best] == at and left < 30


def test_a_cause_that_the_data_do_not_ask_for_is_followed_from_few_places():
    """Three of 99, where 40 would be; its evidence is that of all of them fitted."""
    study = Study(net(11, 9, None))
    (found, more), none = tried(study, "mass", (), np.zeros(study.k), 3), fit(Model(study.model), np.zeros(0))
    assert len(found) == 3 and more > 3 and none.misfit - min(one.misfit for one in found) < 6
    starts = enumerate(study.recipes("mass"))
    every = [fit(study.with_cause((), "mass", i), one.coordinates(one.grid[0])) for i, one in starts]
    total = np.logaddexp.reduce([one.log_evidence for one in every])
    assert likeliest(study, "mass").log_evidence == pytest.approx(total, abs=0.7)


def test_places_around_are_those_with_the_same_sizes():
    """A stretch may end at an end of its line, or have both ends free: with one unknown more."""
    study = Study(net(11, 9, 60))
    k, trials = study.k, {i: study.with_cause((), "oscillator", i) for i in range(4)}
    end = descended(trials[0], trials[0].recipes[0].coordinates(trials[0].recipes[0].grid[0]), np.zeros(k), most=0)
    more = replace(trials[2].recipes[0], unknowns=(*trials[2].recipes[0].unknowns, trials[2].recipes[0].unknowns[0]))
    trials[2] = Model(study.model, (more,))
    near = surrounding([(0, end.point.x, end)], trials, {0}, 3, np.inf)
    assert {i for i, _ in near} == {1, 3} and all(len(x) == len(end.point.x) for _, x in near)


def test_what_is_looked_at_beside_a_cause_is_looked_at_once(monkeypatch):
    """The best look tells which partner is tried, and where its descents begin."""
    study = Study(long_chain(17, 3.0))
    first, seen = tried(study, "mass", (), np.zeros(study.k), 1)[0][0], []
    monkeypatch.setattr(Model, "point", lambda self, x, own=Model.point: seen.append(x) or own(self, x))
    looks = study.looks("ground-spring", first.point.x, first.recipes)
    count = len(seen)
    assert count >= len(looks) > 0
    assert study.looks("ground-spring", first.point.x, first.recipes) is looks and len(seen) == count


def test_what_was_tried_beside_the_same_causes_is_not_tried_again():
    """Beside them at another size, or at other parameters, it is."""
    study, found = Study(long_chain(17, 3.0)), Found()
    first = tried(study, "mass", (), np.zeros(study.k), 1)[0][0]
    assert found.untried(first, ["mass", "oscillator"]) == ["mass", "oscillator"]
    assert found.untried(first, ["ground-spring", "mass"]) == ["ground-spring"]
    for step in np.diag(0.02 * np.append(np.ones(study.k), first.model.width)):
        moved = replace(first, point=replace(first.point, x=first.point.x + step))
        assert found.untried(moved, ["mass"]) == ["mass"] and found.untried(moved, ["mass"]) == []
    longer = replace(first, point=replace(first.point, x=np.append(first.point.x, 0.0)))  # a size more by the same name
    assert found.untried(longer, ["mass"]) == ["mass"]


def test_a_brief_descent_ends_where_a_fit_of_as_many_steps_does():
    """It is not weighed, which takes the derivatives at its end, but is the same search."""
    model = chain(1)
    recipe = Study(model).recipes("oscillator")[1]
    trial, c = Model(model, (recipe,)), recipe.coordinates(recipe.grid[0])
    end, one = descended(trial, c, most=4), fit(trial, c, most=4)
    assert end.misfit == one.misfit and np.array_equal(end.point.x, one.point.x)
    assert not hasattr(end, "log_evidence")


def test_what_promises_nothing_grows_no_further():
    """Of 1000 nats, 900 with a second: if each of two more, and an exchange of each, gained as much, 900 * 0.9^6 = 478 are left.

    That is 239 nats of evidence, and 20 that the unknowns cost: a rival of what is 6 nats better and explains the data, and of what
    does not wherever its misfit is not 200 times what noise would leave below it.
    """
    of = lambda misfit, count, dof=50: SimpleNamespace(
        misfit=misfit, recipes=(None,) * count, log_evidence=-0.5 * misfit - 20.0, dof=dof
    )
    one, two = of(1000.0, 1), of(900.0, 2)
    left = 900 * 0.9**6
    assert _may_rival(one, two, 4, of(left - 11.0, 1, 480)) and not _may_rival(one, two, 4, of(left - 13.0, 1, 480))
    assert not _may_rival(one, of(1100.0, 2), 4, of(900.0, 1, 900))
    refuted = of(100.0, 1, 50)
    assert _may_rival(one, two, 4, refuted) and not _may_rival(one, of(990.0, 2), 4, refuted)


def test_sets_with_fewer_sizes_grow_too():
    """The two best, and the best of those with fewer unknowns: what a mass on an arm does a mass and a third mechanism may do."""
    of = lambda nats, size: SimpleNamespace(log_evidence=nats, c=np.zeros(size))
    sets = [of(-62.0, 4), of(-48.0, 6), of(-49.0, 5), of(-56.0, 6), of(-74.0, 3)]
    assert [(one.log_evidence, one.c.size) for one in _begun(sets)] == [(-48.0, 6), (-49.0, 5), (-62.0, 4)]
    assert _begun(sets[1:4]) == sets[1:3]


def test_a_refused_step_is_followed_by_one_of_half_its_length_at_most():
    """Down the bent valley of Rosenbrock (1960) to its minimum at (1, 1), in the metric of the slopes where the steps begin."""
    r = lambda x: np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]])
    tried: list[list[float]] = []
    begun: dict[str, np.ndarray] = {}

    def slopes(at: SimpleNamespace) -> np.ndarray:
        tried.append([])
        begun.update(x=at.x, T=(T := np.array([[20 * at.x[0], -10.0], [1.0, 0.0]])))
        return T

    def point(x: np.ndarray) -> SimpleNamespace:
        if tried:
            tried[-1].append(float(np.linalg.norm((x - begun["x"]) * np.linalg.norm(begun["T"], axis=0))))
        return SimpleNamespace(x=x, residual=r(x), chi2=float(r(x) @ r(x)))

    box = {"bounds": np.array([[-50.0, 50.0]] * 2), "width": np.full(2, 100.0)}
    of = {"point": point, "jacobian": slopes, "curvature": lambda at: 0.0}
    valley = SimpleNamespace(k=0, base=SimpleNamespace(z=np.zeros(0)), **of, **box)
    end = descended(valley, np.array([-3.0, -4.0]))
    assert end.point.x == pytest.approx([1, 1], abs=1e-2) and any(len(each) > 1 for each in tried)
    assert all(after <= before / 2 + 1e-12 for each in tried for before, after in pairwise(each))
