"""Random damped systems, and what they are when assembled: by numpy, independent of the engine."""

import numpy as np
from scipy.sparse import csr_array

from mouse_cli.model.coupling import Connection, Coupling, Lines, Point, Substructure
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


def drawn(rng: np.random.Generator, name: str, n: int) -> Substructure:
    """Positive definite K, M, and C, D that are small beside them."""

    def definite(size: float) -> np.ndarray:
        root = rng.standard_normal((n, n))
        return size * (root @ root.T / n + np.eye(n))

    return model(name, definite(4.0), definite(1.0), definite(0.1), definite(0.2))


def coupling(parts, pairs=(), connections=(), responses=(), hz=None) -> Coupling:
    """The deck; pairs and responses by (part, place) from 0; forces where responses are."""
    points = tuple(Point(*one) for one in responses)
    joined = tuple((Point(*a), Point(*b)) for a, b in pairs)
    return Coupling(
        "test", "<test>", tuple(parts), joined, tuple(connections), points, points, Lines(hz), "receptance", 0.0, None
    )


def stiffness(part: Substructure, hz: np.ndarray) -> np.ndarray:
    """Z (f, n, n) = K + iD + s C + s^2 M."""
    own, s = part.problem.structure, 2j * np.pi * hz[:, None, None]
    return own.K + 1j * own.D + s * own.C + s**2 * own.M


def receptance(part: Substructure, hz: np.ndarray) -> np.ndarray:
    """Z^-1 (f, n, n)."""
    return np.linalg.inv(stiffness(part, hz))


def assembled(parts, pairs, connections: list[Connection], hz: np.ndarray, asked) -> np.ndarray:
    """(L' diag(Z) L)^-1 between the places asked for; a hung mass is a degree of freedom more, added to the matrix as it is."""
    first = np.cumsum([0] + [part.weights.shape[0] for part in parts])
    hung = [one for one in connections if one.hung]
    n, size = int(first[-1]), int(first[-1]) + len(hung)
    Z, s = np.zeros((len(hz), size, size), complex), 2j * np.pi * hz
    for k, part in enumerate(parts):
        at = slice(first[k], first[k + 1])
        Z[:, at, at] = stiffness(part, hz)
    for one in connections:
        spring = one.stiffness * (1 + 1j * one.loss_factor) + s * one.damping
        stretch, moving = np.zeros(size), np.zeros(size)
        stretch[first[one.at.substructure] + one.at.place] = 1.0
        moving[:] = stretch
        if one.to is not None:
            stretch[first[one.to.substructure] + one.to.place] -= 1.0
        if one.hung:
            moving[:] = 0.0
            moving[n + hung.index(one)] = 1.0
            stretch -= moving
        Z += spring[:, None, None] * np.outer(stretch, stretch) + (s**2 * one.mass)[:, None, None] * np.outer(
            moving, moving
        )
    B = np.zeros((len(pairs), size))
    for row, ((k, a), (j, b)) in enumerate(pairs):
        B[row, first[k] + a], B[row, first[j] + b] = 1.0, -1.0
    L = np.eye(size) if not len(B) else np.linalg.svd(B)[2][np.linalg.matrix_rank(B) :].T
    H = L @ np.linalg.inv(L.T @ Z @ L) @ L.T
    at = [first[k] + place for k, place in asked]
    return H[:, at][:, :, at]
