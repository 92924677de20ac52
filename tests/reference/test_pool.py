"""Processes that share a search: the answer is that of one alone, bit for bit, and what they hand over does the same."""

import subprocess
import sys
from concurrent.futures import Future
from math import inf

import numpy as np
import pytest

import mouse_cli
from benchmarks.trials.seal import seal
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.handed import known_to_all, packed, unpacked
from mouse_cli.diagnosis.search.pool import Pool, _perform
from mouse_cli.diagnosis.search.study import Study

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
