"""Coupled structures from plain matrices, and textbook matrices of plane frames to make them from."""

from itertools import pairwise

import numpy as np
from scipy.sparse import csr_array

from mouse_cli.formats.yaml_deck import coupled
from mouse_cli.model.coupling import Coupling, Lines, Point, Substructure, Synthesis
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.parameter import Gaussian
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure


def model(name: str, K, M, C=None, D=None, removed: bool = False) -> Substructure:
    """A substructure whose places are all its degrees of freedom."""
    n = len(K)
    problem = Problem(
        name, Structure(K, M, C=C, D=D), ListedElements.none(), np.zeros((0, 0)), (), Gaussian(np.zeros(0), np.zeros(0)), None
    )  # fmt: skip
    places = tuple(str(i + 1) for i in range(n))
    return Substructure(name, problem, removed=removed, places=places, weights=csr_array(np.eye(n)))


def measured(name: str, hz, H, variance=None, kind: str = "receptance", **how) -> Substructure:
    """A substructure by functions H (f, o, i), all of whose responses and first i places are forces."""
    o, i = H.shape[1:]
    names = tuple(str(k + 1) for k in range(o))
    variance = np.full(H.shape, np.nan) if variance is None else variance
    frf = FrfTest(hz, H, kind, np.arange(o), np.arange(i), variance, names, names[:i])
    forces = np.where(np.arange(o) < i, np.arange(o), -1)
    return Substructure(name, None, frf, places=names, responses=np.arange(o), forces=forces, signs=np.ones(o), **how)


def coupling(
    parts, pairs=(), connections=(), responses=(), forces=None, hz=None, truncate=0.0, synthesis=None
) -> Coupling:
    """The deck; pairs, responses, forces by (part, place) from 0; synthesis (methods, keep, count)."""

    def points(each):
        return tuple(Point(*one) for one in each)

    return Coupling(
        "test", "<test>", tuple(parts), tuple((Point(*a), Point(*b)) for a, b in pairs), tuple(connections), points(responses),
        points(responses if forces is None else forces), Lines(hz), "receptance", truncate,
        None if synthesis is None else Synthesis(*synthesis),
    )  # fmt: skip


def receptance(K, M, C, D, hz) -> np.ndarray:
    """(K + iD + i w C - w^2 M)^-1 (f, n, n), by numpy."""
    s = 2j * np.pi * np.asarray(hz)[:, None, None]
    zero = np.zeros_like(K)
    return np.linalg.inv(K + 1j * (zero if D is None else D) + s * (zero if C is None else C) + s**2 * M)


def read(folder, text: str) -> Coupling:
    """The deck `text` beside the decks of its parts."""
    (folder / "coupled.yaml").write_text(text)
    return coupled.read(text, str(folder / "coupled.yaml"))


def frame_element(
    E: float, A: float, inertia: float, rho: float, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """K and consistent M (6, 6) of an Euler-Bernoulli bar in the plane (Przemieniecki 1968, eqs. 5.116 and 11.29), in global
    axes."""
    L = float(np.hypot(*(b - a)))
    c, s = (b - a) / L
    k, m = np.zeros((6, 6)), np.zeros((6, 6))
    axial, bending = [0, 3], [1, 2, 4, 5]
    k[np.ix_(axial, axial)] = E * A / L * np.array([[1, -1], [-1, 1]])
    k[np.ix_(bending, bending)] = E * inertia / L**3 * np.array(
        [[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2],
         [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L**2, -6 * L, 4 * L**2]]
    )  # fmt: skip
    m[np.ix_(axial, axial)] = rho * A * L / 6 * np.array([[2, 1], [1, 2]])
    m[np.ix_(bending, bending)] = rho * A * L / 420 * np.array(
        [[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2], [54, 13 * L, 156, -22 * L],
         [-13 * L, -3 * L**2, -22 * L, 4 * L**2]]
    )  # fmt: skip
    turn = np.kron(np.eye(2), np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
    return turn.T @ k @ turn, turn.T @ m @ turn


def frame(points: np.ndarray, E: float, A: float, inertia: float, rho: float) -> tuple[np.ndarray, np.ndarray]:
    """K, M of a chain of bars through `points` (k, 2); degrees of freedom TX, TY, RZ point by point."""
    n = 3 * len(points)
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for e, (a, b) in enumerate(pairwise(points)):
        at = slice(3 * e, 3 * e + 6)
        k, m = frame_element(E, A, inertia, rho, a, b)
        K[at, at] += k
        M[at, at] += m
    return K, M
