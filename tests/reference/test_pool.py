"""Processes that share a search: the answer is that of one alone, bit for bit, and what they hand over does the same."""

import subprocess
import sys
from concurrent.futures import Future
from dataclasses import replace
from math import inf

import numpy as np
import pytest

import mouse_cli
from benchmarks.trials.seal import seal
from mouse_cli.diagnosis.likelihoods.configurations.diagnose import Decks
from mouse_cli.diagnosis.likelihoods.configurations.model import Together
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.descents import best
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.handed import known_to_all, packed, unpacked
from mouse_cli.diagnosis.search.parts import in_turn, single
from mouse_cli.diagnosis.search.pool import Pool, _perform
from mouse_cli.diagnosis.search.study import Study
from tests.reference.test_arrangements import measured

KIND = "several/chain/mass + ground-spring"


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pool") / "trial"
    seal(folder, 3, 1, [KIND])
    return next((folder / "decks").glob("*.yaml"))


def answered(deck, jobs: int) -> bytes:
    """The JSON document of a diagnosis."""
    command = [sys.executable, "-m", "mouse_cli", "diagnose", deck.name, "-q", "--json", "-j", str(jobs)]
    command += ["--candidates", "mass,ground-spring,oscillator,stiffness-loss", "--causes", "2"]
    done = subprocess.run(command, cwd=deck.parent, capture_output=True, check=False)
    assert done.returncode in (0, 1), done.stderr.decode()
    assert not done.stderr
    return done.stdout


def test_answers_are_the_same_whatever_the_number_of_processes(deck):
    one, two, three = (answered(deck, jobs) for jobs in (1, 2, 3))
    assert one == two == three


def test_of_a_change_too_and_of_what_theory_errs_with_it(tmp_path):
    before, after = measured(tmp_path, "before", 1), measured(tmp_path, "after", 2, 0.3)
    command = [sys.executable, "-m", "mouse_cli", "diagnose", before, "--changed", after, "-q", "--json", "--causes", "2"]
    command += ["--candidates", "stiffness-loss,mass,ground-spring", "--common-sd", "0.3"]
    one, two = (subprocess.run([*command, "-j", jobs], capture_output=True, check=False) for jobs in "12")
    assert one.returncode == 1 and not one.stderr
    assert (one.stdout, one.stderr) == (two.stdout, two.stderr)


def changed(folder) -> Decks:
    """A chain before and after a spring has lost a third of its stiffness."""
    paths = measured(folder, "before", 1), measured(folder, "after", 2, 0.3)
    return Decks(tuple(map(mouse_cli.read_deck, paths)), (False, True), 0.003)


def test_what_is_handed_over_of_arrangements_does_the_same(tmp_path):
    decks = changed(tmp_path)
    here, there = (Study(replace(decks).model(), None, Together) for _ in range(2))
    found = best(here, "stiffness-loss")
    other = unpacked(packed(found, known_to_all(here)), known_to_all(there))
    assert (other.misfit, other.sites, other.groups) == (found.misfit, found.sites, found.groups)
    assert other.model.base.parts[0].problem is there.model.parts[0].problem
    np.testing.assert_array_equal(other.model.point(other.point.x).residual, found.point.residual)
    np.testing.assert_array_equal(other.model.jacobian(other.point), found.model.jacobian(found.point))
    assert packed(other, known_to_all(there))  # and can be handed on


def test_processes_go_on_by_other_errors_of_theory(tmp_path):
    """A worker that judges by these finds what one process does."""
    decks = changed(tmp_path)
    study = Study(decks.arranged, None, Together)
    found = single(study, "stiffness-loss", inf)
    data = study.model.erring_as(found.model.modes(found.point)).data
    with Pool(study, 2, replace(decks).model) as study.pool:
        there = study.judged_by(data)
        fits = []
        in_turn(there, single, [("stiffness-loss",), ("mass",)], lambda i, one: fits.append(one))
    alone = Study(decks.arranged, None, Together).judged_by(data)
    for one, name in zip(fits, ("stiffness-loss", "mass"), strict=True):
        same = single(alone, name, inf)
        assert (one.misfit, one.log_evidence) == (same.misfit, same.log_evidence)
        assert one.misfit != found.misfit


class Inline(Pool):
    """Two workers that do what they are handed at once, and say what it was."""

    def __init__(self):
        super().__init__(None, 2)
        self._workers, self.begun = [None, None], []

    def _handed(self, task, given):
        self.begun.append(given)
        future = Future()
        future.set_result(None)  # as of a process that could not make the model
        future.again = lambda: task(self.study, *given)
        return future


def test_parts_begun_ahead_are_begun_anew_where_the_reach_turned_out_otherwise():
    pool, best, taken = Inline(), [9.0], []

    def accept(i: int, found: tuple) -> None:
        taken.append(found)
        best[0] = min(best[0], found[0])

    pool.in_turn(
        lambda study, misfit, reach: (misfit, reach), [(5.0,), (7.0,), (2.0,), (3.0,)], accept, lambda i: best[0]
    )
    assert taken == [(5.0, 9.0), (7.0, 5.0), (2.0, 5.0), (3.0, 2.0)]  # those of one process
    assert (7.0, 9.0) in pool.begun  # begun too early
    assert _perform(lambda study: 1, ()) is None  # a process without a model finds nothing


def test_what_is_handed_over_does_the_same(deck):
    problem = mouse_cli.read_deck(deck)
    study = Study(reduced(problem, problem.prior.mean))
    recipe = study.recipes("ground-spring")[0]
    one = fit(study.with_cause((), "ground-spring", 0), recipe.coordinates(recipe.grid[0]), most=3)
    shared = known_to_all(study)
    for names in (shared, {}):  # with the model, and with models of its own
        names = names or {name: value for name, value in shared.items() if name != "model"}
        other = unpacked(packed(one, names), names)
        assert (other.misfit, other.groups) == (one.misfit, one.groups)
        change, same = one.recipes[0].at(one.c), other.recipes[0].at(other.c)
        np.testing.assert_array_equal(change.K, same.K)
        np.testing.assert_array_equal(other.model.point(other.point.x).residual, one.point.residual)
        assert other.recipes[0].site(recipe.grid[0]) == recipe.site(recipe.grid[0])
        assert packed(other, names)  # and can be handed on
    assert inf > other.log_evidence
