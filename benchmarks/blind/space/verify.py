"""OpenSees on closed forms: a cantilever in space, and a rigid building on a foundation that rocks."""

import numpy as np

from benchmarks.blind.space import opensees, rocked

E, NU, DENSITY, L, WIDTH = 2.1e11, 0.3, 7850.0, 3.0, 0.05
_ROOTS = (1.8751040687, 4.6940911329)


def verify() -> str:
    """A line for each check: largest relative difference of the frequencies."""
    lines = ["OpenSees beside closed forms: largest difference, %"]
    for title, check in CHECKS.items():
        found, exact = check()
        lines.append(f"  {title:44} {100 * np.abs(np.asarray(found) / exact - 1).max():8.4f}")
    return "\n".join(lines)


def cantilever() -> tuple[np.ndarray, np.ndarray]:
    """Bending in both planes: omega = beta^2 sqrt(EI / m) / L^2, each twice; of half the section alone."""
    I, A = WIDTH**4 / 12, WIDTH**2
    points = [[0.0, 0.0, z] for z in np.linspace(0, L, 7)]
    inputs = {
        "points": points, "members": [[i, i + 1] for i in range(6)], "section": [0] * 6, "sections": [[2 * A, 2 * I, 0.3 * A**2]],
        "E": E, "nu": NU, "density": DENSITY, "kg": [0.0] * 7, "factors": {str(i): [0.5, 0.5] for i in range(6)}, "feet": [0],
        "springs": [], "struts": [], "masses": [],
    }  # fmt: skip
    exact = np.array([b**2 for b in _ROOTS for _ in range(2)]) * np.sqrt(E * I / (DENSITY * A)) / L**2 / (2 * np.pi)
    return opensees.modes(inputs, 4)[0], exact


def pendulum() -> tuple[np.ndarray, np.ndarray]:
    """Stiff storeys on a soft foundation: omega^2 = k / sum m (h^2 + b^2 / 12)."""
    heights, m, width, k = [3.0, 3.0, 4.0], [1e4, 2e4, 1e4], 8.0, 1e7
    inputs = {"heights": heights, "k": [1e12] * 3, "m": m, "width": width, "turning": k}
    J = float(np.array(m) @ (np.cumsum(heights) ** 2 + width**2 / 12))
    return rocked.modes(inputs)[0][:1], np.array([np.sqrt(k / J) / (2 * np.pi)])


CHECKS = {"cantilever in space, Euler-Bernoulli": cantilever, "rigid building on a foundation that rocks": pendulum}
