"""Complex modes against the quadratic eigenproblem solved whole by numpy, and a closed form."""

import numpy as np
import pytest
from scipy import sparse

from mouse_cli.dynamics.complex_modes import complex_modes
from mouse_cli.dynamics.frf import Dynamics
from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.term import Slopes


def chain(n: int, viscous: float, eta: float) -> Dynamics:
    """Springs of 1e6 N/m between masses of 1 kg, a dashpot at a third of it, a loss factor in its first half."""
    K = sparse.diags_array([2e6 * np.ones(n), -1e6 * np.ones(n - 1), -1e6 * np.ones(n - 1)], offsets=[0, 1, -1]).tocsr()
    C = sparse.csr_array(([viscous], ([n // 3], [n // 3])), shape=(n, n))
    half = sparse.diags_array((np.arange(n) < n // 2).astype(float))
    D = (eta / 2 * (half @ K + K @ half)).tocsr()
    return Dynamics(K, sparse.eye_array(n).tocsr(), C if viscous else None, D if eta else None)


def whole(dynamics: Dynamics) -> np.ndarray:
    """All poles of the upper half plane by |s|, from the companion matrix."""
    K, M, C, D = (0.0 if m is None else m.toarray() for m in (dynamics.K, dynamics.M, dynamics.C, dynamics.D))
    n = len(K)
    A = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K + 1j * D), -np.linalg.solve(M, C + np.zeros((n, n)))]]
    )
    s = np.linalg.eigvals(A)
    s = s[s.imag > 0]
    return s[np.argsort(np.abs(s))]


@pytest.mark.parametrize("n", [30, 300])
@pytest.mark.parametrize(("viscous", "eta"), [(200.0, 0.0), (0.0, 0.05), (200.0, 0.05)])
def test_poles_and_shapes(n, viscous, eta):
    dynamics = chain(n, viscous, eta)
    found = complex_modes(dynamics, EigenSolver().solve(dynamics.K, dynamics.M, 12), 6)
    exact = whole(dynamics)[:6]
    np.testing.assert_allclose(found.poles, exact, rtol=1e-7)
    assert found.error.max() < 1e-7
    for s, psi in zip(found.poles, found.shapes.T, strict=True):
        rest = dynamics.at(s) @ psi
        assert np.linalg.norm(rest) < 1e-5 * np.linalg.norm(dynamics.K @ psi)
    assert (found.complexity > 1e-6).any() and (found.complexity < 1).all()


def test_one_degree_of_freedom():
    k, m, c, eta = 100.0, 1.0, 0.4, 0.0
    dynamics = Dynamics(*(np.array([[v]]) for v in (k, m, c)), None)
    found = complex_modes(dynamics, EigenSolver().solve(dynamics.K, dynamics.M, 1), 1)
    assert np.isclose(found.damping[0], c / (2 * np.sqrt(k * m)), rtol=1e-12)
    assert np.isclose(found.frequencies_hz[0], np.sqrt(k / m) / (2 * np.pi), rtol=1e-12)
    eta = 0.03
    dynamics = Dynamics(np.array([[k]]), np.array([[m]]), None, np.array([[eta * k]]))
    found = complex_modes(dynamics, EigenSolver().solve(dynamics.K, dynamics.M, 1), 1)
    assert np.isclose(found.damping[0], np.sin(np.arctan(eta) / 2), rtol=1e-12)


def test_derivatives_of_damping_ratios():
    n, h = 12, 1e-4
    entry = {name: Slopes(np.array([j]), np.array([4]), np.array([4]), np.ones(1)) for j, name in enumerate("KMCD")}

    def at(steps):
        given = chain(n, 80.0, 0.04)
        parts = [m.toarray().copy() for m in (given.K, given.M, given.C, given.D)]
        for part, step in zip(parts, steps, strict=True):
            part[4, 4] += step
        return Dynamics(*parts)

    dynamics = at(np.zeros(4))
    found = complex_modes(dynamics, EigenSolver().solve(dynamics.K, dynamics.M, n), 5)
    slopes = found.damping_slopes(dynamics, Change(n, 4, entry))
    for j, size in enumerate((1e6, 1.0, 80.0, 4e4)):
        step = h * size * np.eye(4)[j]
        above, below = (whole(_sparse(at(sign * step)))[:5] for sign in (1, -1))
        by_difference = (-above.real / np.abs(above) + below.real / np.abs(below)) / (2 * h * size)
        np.testing.assert_allclose(slopes[:, j], by_difference, rtol=1e-5, atol=1e-6 * np.abs(by_difference).max())


def _sparse(dynamics: Dynamics) -> Dynamics:
    return Dynamics(*(sparse.csr_array(m) for m in (dynamics.K, dynamics.M, dynamics.C, dynamics.D)))
