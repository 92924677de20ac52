"""Frames with a flexible support, tested by functions: OpenSees beside mouse's own elements, and decks that tell nothing."""

import importlib.util

import numpy as np
import pytest
from scipy.linalg import eigh

from benchmarks.blind.case import generator
from benchmarks.blind_frf import portals
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.formats import read_deck
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly

pytestmark = pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed")


def test_a_foot_on_a_spring_is_softer_than_one_that_is_held():
    """A spring that is all but rigid changes nothing."""
    portal = portals.drawn(generator("portals", 1))
    stiff = np.full(2, portals.E)
    lowest = lambda springs: eigh(*portals.matrices(portal, stiff, portals.DENSITY, springs)[:2], eigvals_only=True)[:4]
    sound = lowest([])
    for direction in portals.CAUSES.values():
        rigid, soft = (lowest([(portal.feet[0], direction, k)]) for k in (1e15, 1e6))
        assert rigid == pytest.approx(sound, rel=1e-4)
        assert (soft < sound * (1 + 1e-9)).all() and soft[0] < sound[0] * 0.999


def test_decks_are_the_truth_but_for_the_cause(tmp_path):
    for number in range(3):
        path, known = portals.write(tmp_path, 5, number)
        assert not any(word in path.read_text() for word in ("spring", "turns", "slides", "settles"))
        problem = read_deck(path)
        K, M = (dense(part) for part in assembly(problem).matrices(problem.prior.mean))
        hz = np.sqrt(dense_solution(K, M).eigenvalues[:4]) / (2 * np.pi)
        given = np.load(path.with_suffix(".npz"))
        assert given["frequency_hz"][0] < hz[0] < hz[3] < given["frequency_hz"][-1]
        assert known["place"][1] == 0.0
