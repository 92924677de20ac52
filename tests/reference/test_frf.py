"""Frequency response functions and their derivatives against closed forms, mpmath and direct solutions line by line."""

import mpmath
import numpy as np
import pytest
from element_meshes import beam_line
from scipy import sparse

from mouse_cli.dynamics.frf import Dynamics, FrfModel
from mouse_cli.dynamics.frf_basis import WHOLE, frf_model
from mouse_cli.dynamics.frf_slopes import Change, slopes
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.mesh import Binding
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import built

PLACE = np.array([0])


def spread(model: FrfModel, s: np.ndarray, change: Change) -> tuple[np.ndarray, np.ndarray]:
    """alpha (f, o, i) and d alpha (f, o, i, p)."""
    fields = model.at(s)
    alpha = fields.receptance()
    out = np.zeros((*alpha.shape, change.p), complex)
    for part, values in slopes(fields, change):
        out[..., part] = values
    return alpha, out


def test_one_degree_of_freedom_in_closed_form():
    k, m, c, eta, w = 3.0e4, 2.0, 15.0, 0.03, np.linspace(20, 200, 7)
    model = frf_model(Dynamics(*(np.array([[v]]) for v in (k, m, c, eta * k))), (PLACE, PLACE), 1j * w[-1:])
    exact = 1 / (k * (1 + 1j * eta) - w**2 * m + 1j * w * c)
    assert np.allclose(model.at(1j * w).receptance()[:, 0, 0], exact, rtol=1e-13)


def test_two_degrees_of_freedom_and_their_derivatives_by_mpmath():
    """Every kind of parameter: stiffness, mass, dashpot and loss factor of the spring between the two; off the axis i omega too."""
    from mouse_cli.model.term import Slopes

    def dynamic(s, k=2e4, m=1.5, c=6.0, eta=0.02):
        a, b = k * (1 + 1j * eta) + s * c, 1e4 + s**2 * 1.0
        return mpmath.matrix([[a + b, -a], [-a, a + s**2 * m]])

    K, M = np.array([[3e4, -2e4], [-2e4, 2e4]]), np.diag([1.0, 1.5])
    one = np.array([[1.0, -1.0], [-1.0, 1.0]])
    row, col = (index.ravel() for index in np.indices((2, 2)))
    slopes = {
        "K": Slopes(np.zeros(4, int), row, col, one.ravel()),
        "M": Slopes(np.array([1]), np.array([1]), np.array([1]), np.ones(1)),
        "C": Slopes(np.full(4, 2), row, col, one.ravel()),
        "D": Slopes(np.concatenate([np.zeros(4, int), np.full(4, 3)]), np.tile(row, 2), np.tile(col, 2),
                    np.concatenate([0.02 * one.ravel(), 2e4 * one.ravel()])),
    }  # fmt: skip
    s = np.array([1j * 50.0, 1j * 119.0, 3.0 + 1j * 200.0])
    model = frf_model(Dynamics(K, M, 6.0 * one, 0.02 * 2e4 * one), (np.arange(2), np.array([1])), s[-1:])
    alpha, found = spread(model, s, Change(2, 4, slopes))
    with mpmath.workdps(40):
        for q, at in enumerate(s):
            at = mpmath.mpc(at)
            for o in range(2):
                exact = mpmath.inverse(dynamic(at))[o, 1]
                assert abs(alpha[q, o, 0] - complex(exact)) < 1e-13 * abs(alpha[q, o, 0])
                for j, (name, value) in enumerate({"k": 2e4, "m": 1.5, "c": 6.0, "eta": 0.02}.items()):

                    def of(x, name=name, at=at, o=o):
                        return mpmath.inverse(dynamic(at, **{name: x}))[o, 1]

                    slope = complex(mpmath.diff(of, value))
                    assert abs(found[q, o, 0, j] - slope) < 1e-10 * abs(slope)


@pytest.mark.parametrize("count", [10, 40, 300])
def test_cantilever_of_complex_modulus_in_closed_form(count):
    """Receptances of the tip and of the middle, Bishop and Johnson (1960), table 7.1 (c), with E (1 + i eta).

    10 elements are solved as they are, 40 (dense) and 300 (sparse) in a basis.
    """
    length, E, eta, density, A, I = 0.8, 7e10, 0.02, 2700.0, 5e-4, 4e-9
    given = beam_line(count, length, [(0, (0, 1, 5))], {"theory": "euler-bernoulli"}, E=E, density=density, A=A,
                      Iy=I, Iz=I, loss_factor=eta)  # fmt: skip
    model = built(given)
    assembly = Assembly(model.structure, model.terms, 0)
    K, M = assembly.matrices(np.zeros(0))
    C, D = assembly.damping(np.zeros(0))
    tip, middle = (model.structure.labels.index(f"{node}TY") for node in (count + 1, count // 2 + 1))
    s = 2j * np.pi * np.array([5.0, 31.7, 90.0, 240.0, 400.0])
    solution = EigenSolver().solve(K, M, 10)
    found = frf_model(Dynamics(K, M, C, D), (np.array([tip, middle]), np.array([tip])), s[[1, -1]], solution)
    assert (found.V is None) == (3 * count <= WHOLE)
    assert found.error < 1e-6
    alpha = found.at(s).receptance()[:, :, 0]
    EI = E * (1 + 1j * eta) * I
    lam = (-(s**2) * density * A / EI) ** 0.25
    x, y = lam * length, lam * length / 2
    bottom = 1 + np.cos(x) * np.cosh(x)
    at_tip = (np.cosh(x) * np.sin(x) - np.sinh(x) * np.cos(x)) / (EI * lam**3 * bottom)
    a = np.sin(x) + np.sinh(x), np.cos(x) + np.cosh(x)  # w = c ((cosh - cos) a1 - (sinh - sin) a0'), clamped at 0
    shape = (np.cosh(y) - np.cos(y)) * a[0] - (np.sinh(y) - np.sin(y)) * a[1]
    at_middle = shape / (2 * EI * lam**3 * bottom)
    seen, accuracy = (slice(3), 1e-3) if count == 10 else (slice(None), 1e-4 if count == 40 else 1e-5)
    assert np.allclose(alpha[seen, 0], at_tip[seen], rtol=accuracy)
    assert np.allclose(alpha[seen, 1], at_middle[seen], rtol=accuracy)


@pytest.mark.parametrize("sparse_matrices", [False, True])
def test_basis_against_direct_solutions_with_all_kinds_of_damping(sparse_matrices):
    """FRFs and their derivatives by E and loss factor of halves of a beam with a dashpot, from full complex solutions."""
    from element_meshes import elements

    import mouse_cli.model.mesh as of

    count = 180 if sparse_matrices else 60
    base = beam_line(count, 1.0, [(0, (0, 1, 5))], loss_factor=0.01, stiffness_damping=1e-6)
    dashpot = elements("dashpot", np.array([[count // 3]]), count + 1, TY=20.0)
    given = of.Mesh(
        base.node_ids, base.coordinates, (*base.elements, dashpot), base.supports, directions=base.directions
    )
    half = np.arange(count // 2)
    bindings = (
        Binding(0, 0, half, "E"), Binding(1, 0, half, "loss_factor"),
        Binding(2, 0, half + count // 2, "density"), Binding(3, 1, np.array([0]), "TY"),
    )  # fmt: skip
    theta = np.array([2.0e11, 0.05, 7000.0, 15.0])
    model = built(given, bindings)
    assembly = Assembly(model.structure, model.terms, 4)

    def dynamics(at):
        return Dynamics(*assembly.matrices(at), *assembly.damping(at))

    now = dynamics(theta)
    assert sparse.issparse(now.K) == sparse_matrices
    solution = EigenSolver().solve(now.K, now.M, 12)
    s = 2j * np.pi * np.linspace(20.0, 900.0, 9)
    out = np.array([model.structure.labels.index(f"{n}TY") for n in (count // 4, count // 2, count + 1)])
    found = frf_model(now, (out, out[-1:]), s[[0, 4, -1]], solution, tolerance=1e-9)
    alpha, slope = spread(found, s, Change(assembly.n, 4, assembly.slopes(theta)))

    def whole(at):
        full = dynamics(at)
        return Dynamics(*(m.toarray() if sparse.issparse(m) else m for m in (full.K, full.M, full.C, full.D)))

    inverse = [np.linalg.inv(whole(theta).at(x)) for x in s]
    exact = np.array([Z[np.ix_(out, out[-1:])] for Z in inverse])
    assert (
        np.abs(alpha - exact).max() < 1e-6 * np.abs(exact).max()
    )  # as far as rounding lets the direct solutions be trusted
    for j in range(4):
        h = 0.1 * theta[j] * np.eye(4)[j]  # matrices are bilinear in E and loss factor: central differences are exact
        above, below = whole(theta + h), whole(theta - h)
        direct = [
            (Z @ (below.at(x) - above.at(x)) @ Z / (2 * h[j]))[np.ix_(out, out[-1:])]
            for Z, x in zip(inverse, s, strict=True)
        ]
        assert np.abs(slope[..., j] - direct).max() < 2e-5 * np.abs(direct).max()
