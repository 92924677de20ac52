"""Damping of the structure itself, of which a diagnosis knows little beforehand: amounts that are estimated beside every cause."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.model.arrays import Matrix

_LOSS, _SPREAD = 0.01, 1.0  # loss factor of a structure whose deck states none, and sd of its logarithm
_TRACE, _WIDE = 1e-4, 3.0  # viscous damping ratio in mid-band that may come beside it, and sd of its logarithm
_KINDS = 4  # of damping that all modes share
ALIKE = (0, 1, 3), (0, 1, 0, 2)  # kinds that differ from mode to mode, and as which of them each kind does
_UNEVEN = 0.5  # sd of ln of the damping of each mode over what the kinds make of it, where modes are damped unevenly
_FAR = 8.0  # standard deviations beyond which damping does not change
# Of the eigenvalue of the lowest measured mode, below which a mode has no strain that would lose anything
_RIGID = 1e-6
_ROUNDED = 1e-12  # of a matrix, what is rounding
_SAME = 1e-6  # share of the damping below which what a deck states is like the rest


@dataclass(frozen=True)
class Damping:
    """Unknowns ln eta, ln alpha, ln beta, ln zeta: loss factor, viscous damping by mass (1/s), by stiffness (s), and as the same
    ratio of all modes; then ln of what the damping of each of the lowest modes is multiplied by: N(mean, sd) each.

    stated: loss factor that the deck gives most of the structure. rows (c, r), own (c,), viscous (c,): what it states besides,
    D + i omega C = rows' diag(own + i omega viscous) rows.
    """

    mean: np.ndarray
    sd: np.ndarray
    rows: np.ndarray
    own: np.ndarray
    viscous: np.ndarray
    stated: float = 0.0

    def values(self, u: np.ndarray) -> np.ndarray:
        """eta, alpha, beta, zeta and the factors (c,) of modes at u (4 + c,), prior standard deviations from the mean."""
        return np.exp(self.mean + self.sd * np.clip(u, -_FAR, _FAR))

    def of_modes(self, s: np.ndarray, eigenvalues: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """What damping adds to Z of each mode, by kinds: factors (4, n) of modes, and (4, f) of lines, at s (f,); products are
        added.
        """
        eta, alpha, beta, zeta, *factors = self.values(u)
        of_mode = np.ones(len(eigenvalues))
        of_mode[: len(factors)] = factors
        root = np.sqrt(np.maximum(eigenvalues, 0.0))
        of_modes = of_mode * np.stack([eigenvalues, np.ones(len(root)), eigenvalues, root])
        return of_modes, np.stack([np.full_like(s, 1j * eta), s * alpha, s * beta, 2 * s * zeta])

    def unevenly(self) -> "Damping":
        """The same where each mode has damping of its own beside it."""
        sd = self.sd.copy()
        sd[_KINDS:] = _UNEVEN
        return replace(self, sd=sd)


def damping(model: Reduced, count: int = 0) -> Damping:
    """The damping of the deck at the prior mean of its parameters: what is spread evenly by amount, and what is local.

    count: of the lowest modes, which may have damping of their own, see `unevenly`.
    """
    C, D = (_projected(matrix, model) for matrix in model.assembly.damping(model.problem.prior.mean))
    measured = model.data.test.frequency_hz
    middle = 2 * np.pi * float(np.sqrt(np.nanmin(measured) * np.nanmax(measured)))
    seen = min(model.r, int(model.data.test.number.max()))
    stiff = model.eigenvalues[:seen]
    elastic = stiff > _RIGID * lowest(model)
    stated = 0.0 if D is None else float(np.median(np.diag(D)[:seen][elastic] / stiff[elastic]))
    rows, own, viscous = [np.zeros((0, model.r))], [np.zeros(0)], [np.zeros(0)]
    if D is not None:
        size, U = of_low_rank(D - stated * np.diag(model.eigenvalues), np.abs(D).max())
        rows.append(U.T), own.append(size), viscous.append(np.zeros(len(size)))
    if C is not None:
        size, U = of_low_rank(C, np.abs(C).max())
        rows.append(U.T), own.append(np.zeros(len(size))), viscous.append(size)
    mean = np.log([stated or _LOSS, 2 * _TRACE * middle, 2 * _TRACE / middle, _TRACE, *np.ones(count)])
    sd = np.array([_SPREAD, _WIDE, _WIDE, _WIDE, *np.zeros(count)])
    parts = (np.concatenate(part) for part in (rows, own, viscous))
    return Damping(mean, sd, *parts, stated)


def _projected(matrix: Matrix | None, model: Reduced) -> np.ndarray | None:
    return None if matrix is None else model.project(matrix)


def of_low_rank(matrix: np.ndarray, scale: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues (c,) and vectors (size, c) of a symmetric matrix, but for those that are nothing beside `scale`."""
    Q = _range(matrix)
    size, W = np.linalg.eigh(Q.T @ matrix @ Q)
    U = Q @ W
    kept = np.abs(size) > _SAME * (np.abs(size).max(initial=0.0) if scale is None else scale)
    return size[kept], U[:, kept]


def _range(matrix: np.ndarray) -> np.ndarray:
    """Orthonormal columns (size, c) that span those of a symmetric matrix."""
    from scipy.linalg import qr

    Q, R, _ = qr(matrix, pivoting=True)
    size = np.abs(R.diagonal())
    return Q[:, size > _ROUNDED * size.max(initial=0.0)]
