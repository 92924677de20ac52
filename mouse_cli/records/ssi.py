"""Modes of what vibrates by unknown forces: covariance-driven stochastic subspace identification, with covariance.

Correlations of the outputs, R_k = E y(t + k) y(t)', fill a block Hankel matrix H = O G; O has the poles as eigenvalues of
O_up^+ O_down (P. van Overschee, B. De Moor, Subspace Identification for Linear Systems, 1996; B. Peeters, G. De Roeck,
Mechanical Systems and Signal Processing 13 (1999) 855). The record is divided into blocks; the scatter of their H gives its
covariance, and goes through all steps to first order, one vector a block, which is the efficient form of M. Doehler, L. Mevel,
Mechanical Systems and Signal Processing 38 (2013) 346, sections 3 and 4.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mouse_cli.records.lscf import OrderPoles, unit_largest


@dataclass(frozen=True)
class Subspace:
    """Hankel matrix of the record by its singular values, and its scatter.

    left (a, k), singular (k,), right (b, k); scatter: for each block w_j (H_j - H) sqrt(n / (n - 1)), w_j its share of the whole
    length, (blocks, a, b). outputs: o.
    """

    left: np.ndarray
    singular: np.ndarray
    right: np.ndarray
    scatter: np.ndarray
    outputs: int


@dataclass(frozen=True)
class System:
    """State matrix of one order by its eigenvalues, and the shapes (o, n) of its states; A-related parts for perturbations."""

    eigenvalues: np.ndarray
    vectors: np.ndarray
    inverse: np.ndarray
    shapes: np.ndarray


def subspace(records: Sequence[np.ndarray], lags: int, blocks: int) -> Subspace:
    """Hankel matrix of records (t, o) with `lags` block columns and lags + 1 block rows, and its scatter over `blocks`.

    Blocks do not reach from one record into the next; each counts by its length.
    """
    stretches = list(_stretches([len(each) - 2 * lags for each in records], blocks))
    hankels = np.array([_hankel(records[r], first, length, lags) for r, first, length in stretches])
    share = np.array([length for _, _, length in stretches], float)
    share /= share.sum()
    mean = np.tensordot(share, hankels, 1)
    left, singular, right = np.linalg.svd(mean, full_matrices=False)
    n = len(stretches)
    scatter = np.sqrt(n / (n - 1)) * share[:, None, None] * (hankels - mean)
    return Subspace(left, singular, right.T, scatter, records[0].shape[1])


def _stretches(lengths: list[int], blocks: int) -> Iterator[tuple[int, int, int]]:
    """Record, first sample and length of about so many blocks, at least one of each record."""
    whole = sum(lengths)
    for r, length in enumerate(lengths):
        count = max(1, round(blocks * length / whole))
        yield from ((r, j * (length // count), length // count) for j in range(count))


def _hankel(samples: np.ndarray, first: int, length: int, lags: int) -> np.ndarray:
    """Correlations of one block in a block Hankel matrix ((lags + 1) o, lags o)."""
    base = samples[first : first + length]
    moments = [samples[first + k : first + k + length].T @ base / length for k in range(1, 2 * lags + 1)]
    return np.concatenate([np.concatenate(moments[a : a + lags], axis=1) for a in range(lags + 1)])


def system(found: Subspace, order: int) -> System:
    """The state matrix of `order`."""
    O = found.left[:, :order]
    A = np.linalg.lstsq(O[: -found.outputs], O[found.outputs :], rcond=None)[0]
    eigenvalues, vectors = np.linalg.eig(A)
    return System(eigenvalues, vectors, np.linalg.pinv(vectors), O[: found.outputs] @ vectors)


def poles(found: Subspace, orders: range, rate_hz: float, band_hz: tuple[float, float]) -> list[OrderPoles]:
    """Poles in the band for each of `orders`, with their shapes in the place of participations."""
    every = []
    for order in orders:
        state = system(found, order)
        keep = np.flatnonzero(state.eigenvalues.imag > 0)
        values = np.log(state.eigenvalues[keep]) * rate_hz
        inside = (np.abs(values) > 2 * np.pi * band_hz[0]) & (np.abs(values) < 2 * np.pi * band_hz[1])
        every.append(OrderPoles(order, values[inside], unit_largest(state.shapes[:, keep][:, inside])))
    return every


@dataclass(frozen=True)
class UncertainMode:
    """pole, rad/s; shape (o,); scatter (blocks, 2 + 2 o): errors of both that each block stands for, real and imaginary parts by
    turns; the covariance is scatter' scatter."""

    pole: complex
    shape: np.ndarray
    scatter: np.ndarray


def uncertain(found: Subspace, order: int, wanted: list[complex], rate_hz: float) -> list[UncertainMode]:
    """The modes of `order` nearest to the poles `wanted`, with their scatter."""
    state, changes = system(found, order), _changes(found, order)
    values = np.log(state.eigenvalues.astype(complex)) * rate_hz
    picked = [int(np.abs(values - pole).argmin()) for pole in wanted]
    O = found.left[:, :order]
    up, down = O[: -found.outputs], O[found.outputs :]
    back = np.linalg.pinv(up)
    A = back @ down
    rest, gram = down - up @ A, np.linalg.inv(up.T @ up)
    scatter = {i: [] for i in picked}
    for change in changes:
        dup, ddown = change[: -found.outputs], change[found.outputs :]
        dA = state.inverse @ (back @ (ddown - dup @ A) + gram @ (dup.T @ rest)) @ state.vectors
        for i in scatter:
            apart = state.eigenvalues[i] - state.eigenvalues
            apart[i] = 1.0
            mixture = dA[:, i] / apart
            mixture[i] = 0
            shape = change[: found.outputs] @ state.vectors[:, i] + state.shapes @ mixture
            scatter[i].append(np.concatenate([[dA[i, i] / state.eigenvalues[i] * rate_hz], shape]))
    return [UncertainMode(complex(values[i]), state.shapes[:, i], _parts(np.array(scatter[i]))) for i in picked]


def _parts(values: np.ndarray) -> np.ndarray:
    """Complex (blocks, k) as real (blocks, 2 k), real and imaginary parts by turns."""
    return np.stack([values.real, values.imag], axis=2).reshape(len(values), -1)


def _changes(found: Subspace, order: int) -> list[np.ndarray]:
    """First-order change of the first `order` left singular vectors for each block's scatter, less what only mixes them."""
    s, inner, outer = found.singular, slice(0, order), slice(order, None)
    gap = s[inner] ** 2 - s[outer, None] ** 2
    gap = np.where(np.abs(gap) > 1e-14 * s[0] ** 2, gap, np.inf)
    every = []
    for part in found.scatter:
        forward = part @ found.right[:, inner]
        ahead = found.left[:, outer].T @ forward
        across = (found.left[:, inner].T @ part @ found.right[:, outer]).T
        within = found.left[:, outer] @ ((s[inner] * ahead + s[outer, None] * across) / gap)
        beyond = (forward - found.left @ (found.left.T @ forward)) / s[inner]
        every.append(within + beyond)
    return every
