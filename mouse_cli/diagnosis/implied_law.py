"""The law that one force at a place must have, read off each measured frequency without assuming its form.

An extra force g = -d(lambda) B'phi at B makes lambda an eigenvalue when 1 + d B'R(lambda)B = 0, R = (K - lambda M)^-1 of the model
without it: d = -1/H with H = B'RB. To first order sd(d) = |H'/H^2| 2 lambda sd(f)/f, with H' = B'R M R B.
"""

import numpy as np

from mouse_cli.diagnosis.change import Change
from mouse_cli.diagnosis.fit import Fit
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.diagnosis import Law

_SINGLE = 1e-6  # second singular value over the first, up to which a change acts on one motion


def implied_law(one: Fit) -> Law | None:
    """The law at the place of a single cause that acts on one motion; None for others, and without frequencies."""
    if len(one.recipes) != 1:
        return None
    recipe, base = one.recipes[0], one.model.base
    values = recipe.values(one.c)
    change = Change(*one.model.added(one.c))
    B = _motion(change, base.r, float(values[0]), recipe.unknowns[0].unit)
    have = base.data.has_frequency
    if B is None or not have.any():
        return None
    K, M = base.matrices(one.point.x[: one.model.k])
    test = base.data.test
    hz, sd_hz = test.frequency_hz[have], test.frequency_sd_hz[have]
    found = []
    for lam, relative in zip(eigenvalue(hz), sd_hz / hz, strict=True):
        x = np.linalg.solve(K - lam * M, B)
        H, slope = B @ x, x @ M @ x
        found.append((-1 / H, abs(slope / H**2) * 2 * lam * relative, _dynamic(change, lam, B)))
    stiffness, sd, fitted = np.array(found).T
    return Law(recipe.site(values), "N/m", hz, stiffness, sd, fitted)


def _motion(change: Change, r: int, size: float, unit: str) -> np.ndarray | None:
    """The one motion B (r,) that a change acts on: size B B' is what a spring adds to K, or a mass to M; None for other changes."""
    if change.sensing is not None:
        return None
    if change.K is not None and len(change.K) == r + 1:  # an oscillator: its spring is [B, -1]'[B, -1]
        return -change.K[r, :r] / change.K[r, r]
    added = {"N/m": change.K, "kg": change.M}.get(unit)
    other = change.M if unit == "N/m" else change.K
    if added is None or len(added) > r or (other is not None and other.any()):
        return None
    sizes, V = np.linalg.eigh(added)
    if r > 1 and abs(sizes[-2]) > _SINGLE * sizes[-1]:
        return None
    return V[:, -1] * np.sqrt(sizes[-1] / size)


def _dynamic(change: Change, lam: float, B: np.ndarray) -> float:
    """d(lambda) of the cause itself, its own degree of freedom condensed: what stands before B B'."""
    r = len(B)
    Z = np.zeros_like(change.K if change.K is not None else change.M)
    for matrix, factor in ((change.K, 1.0), (change.M, -lam)):
        if matrix is not None:
            Z = Z + factor * matrix
    inner = Z[:r, :r]
    if len(Z) > r:
        inner = inner - Z[:r, r:] @ np.linalg.solve(Z[r:, r:], Z[r:, :r])
    return float(B @ inner @ B / (B @ B) ** 2)
