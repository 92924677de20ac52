"""The law that one force at a place must have, read off each measured frequency without assuming its form.

An extra force g = -d(lambda) B'phi at B makes lambda an eigenvalue when 1 + d B'R(lambda)B = 0, R = (K - lambda M)^-1 of the model
without it: d = -1/H with H = B'RB. To first order sd(d) = |H'/H^2| 2 lambda sd(f)/f, with H' = B'R M R B. B is the motion of the
place in the direction in which it moves in each mode.
"""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.diagnosis import Law

_PLACES = ("node", "element", "dof")  # kinds of sites that are one place


def implied_law(one: Fit) -> Law | None:
    """The law at the place of a single cause; None where it acts through no translation of one place, and without frequencies."""
    if len(one.recipes) != 1 or not one.c.size:
        return None
    recipe, base = one.recipes[0], one.model.base
    values = recipe.values(one.c)
    site, change = recipe.site(values), recipe.change(values)
    G = _gram(change, base.r, float(values[0]), recipe.unknowns[0].unit) if site.kind in _PLACES else None
    have = base.data.has_frequency
    if G is None or not have.any():
        return None
    K, M = base.matrices(one.point.x[: one.model.k])
    test, X = base.data.test, one.point.X[: base.r, one.point.modes[have]]
    hz, sd_hz = test.frequency_hz[have], test.frequency_sd_hz[have]
    found = []
    for own_hz, lam, relative, x in zip(hz, eigenvalue(hz), sd_hz / hz, X.T, strict=True):
        B = _along(G, x)
        u = np.linalg.solve(K - lam * M, B)
        H, slope = B @ u, u @ M @ u
        if H:  # a place that the mode leaves still tells nothing
            found.append((own_hz, -1 / H, abs(slope / H**2) * 2 * lam * relative, _dynamic(change, lam, x, G)))
    return Law(site, base.problem.units.of("N/m"), *np.array(found).T) if found else None


def _gram(change: Change, r: int, size: float, unit: str) -> np.ndarray | None:
    """B'B (r, r) of the translations B of the place: size B'B is what a spring adds to K, a mass to M; None for others."""
    if change.sensing is not None:
        return None
    if change.K is not None and len(change.K) == r + 1:  # a mass on a spring k [B, -1]'[B, -1], and perhaps on one of its own
        row, k_squares = change.K[r, :r], change.K[:r, :r].trace()
        B = -row * k_squares / max(row @ row, 1e-300)
        return np.outer(B, B)
    added = {"N/m": change.K, "kg": change.M}.get(unit)
    other = change.M if unit == "N/m" else change.K
    return None if added is None or len(added) > r or (other is not None and other.any()) else added / size


def _along(G: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The motion of the place in the direction in which it moves in the shape x: B'e, e = B x / |B x|."""
    return G @ x / np.sqrt(max(x @ G @ x, 1e-300))


def _dynamic(change: Change, lam: float, x: np.ndarray, G: np.ndarray) -> float:
    """d(lambda) of the cause, its own degree of freedom condensed: x'(dK - lambda dM)x over x'Gx, the squared motion."""
    r = len(x)
    Z = np.zeros_like(change.K if change.K is not None else change.M)
    for matrix, factor in ((change.K, 1.0), (change.M, -lam)):
        if matrix is not None:
            Z = Z + factor * matrix
    inner = Z[:r, :r]
    if len(Z) > r:
        inner = inner - Z[:r, r:] @ np.linalg.solve(Z[r:, r:], Z[r:, :r])
    return float(x @ inner @ x / max(x @ G @ x, 1e-300))
