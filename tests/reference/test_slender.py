"""Slender structures, whose lowest eigenvalues are 1e10 to 1e16 times below the largest: modes and sensitivities keep their digits.

Truth: closed-form frequencies of a cantilever; eigenvectors and Nelson's derivatives (1976) of the very matrices in 40-digit
arithmetic, by elimination within the band.
"""

import numpy as np
import pytest
from mpmath import mp, mpf
from scipy.sparse import coo_array, csr_array

from mouse_cli.dynamics.forces import forces
from mouse_cli.dynamics.sensitivity import EXACT, FINAL, modal_partials
from mouse_cli.dynamics.solver import EXACT as EXACT_SHAPES
from mouse_cli.dynamics.solver import TOLERANCE, EigenSolver, eigensolution
from mouse_cli.model.term import Slopes

BAND, GROUPS = 3, 4
LENGTH, STIFFNESS, MASS = 2.0, 210e9 * 0.02**4 / 12, 7850.0 * 0.02**2  # m, N m2, kg/m


class Cantilever:
    """A steel cantilever in `elements` Euler-Bernoulli beams, deflection and rotation at each node, in GROUPS."""

    def __init__(self, elements: int):
        l = LENGTH / elements
        k = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) * STIFFNESS / l**3
        m = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * MASS * l / 420
        scale = np.outer([1, l, 1, l], [1, l, 1, l])
        self.n, self.group = 2 * elements, np.arange(elements) * GROUPS // elements
        dofs = 2 * np.arange(-1, elements - 1)[:, None] + np.arange(4)
        row, col = np.repeat(dofs, 4, axis=1).ravel(), np.tile(dofs, (1, 4)).ravel()
        own = (row >= 0) & (col >= 0)
        self.row, self.col, self.parameter = row[own], col[own], np.repeat(self.group, 16)[own]
        self.k, self.m = (np.tile((matrix * scale).ravel(), elements)[own] for matrix in (k, m))
        self.K, self.M = self.summed(self.k), self.summed(self.m)

    def summed(self, values: np.ndarray) -> csr_array:
        return csr_array(coo_array((values, (self.row, self.col)), shape=(self.n, self.n)).tocsr())

    def pattern(self):
        """The stiffnesses of the groups are properties, and their masses."""
        K = Slopes(self.parameter, self.row, self.col, self.k)
        return forces(self.n, 2 * GROUPS, {"K": K, "M": Slopes(GROUPS + self.parameter, self.row, self.col, self.m)})

    def derivatives(self, j: int) -> tuple[csr_array, csr_array]:
        """dK and dM by property j."""
        none = csr_array((self.n, self.n))
        part = self.parameter == j % GROUPS
        return (self.summed(self.k * part), none) if j < GROUPS else (none, self.summed(self.m * part))


def banded(matrix: csr_array) -> list[list]:
    """The entries (n, 2 BAND + 1) around the diagonal, in extended precision, exactly."""
    rows = [[mpf(0)] * (2 * BAND + 1) for _ in range(matrix.shape[0])]
    entries = matrix.tocoo()
    for i, j, value in zip(entries.row, entries.col, entries.data, strict=True):
        rows[i][j - i + BAND] = mpf(float(value))
    return rows


def product(rows: list[list], x: list) -> list:
    n = len(x)
    return [
        mp.fsum(row[d] * x[i + d - BAND] for d in range(2 * BAND + 1) if 0 <= i + d - BAND < n and row[d])
        for i, row in enumerate(rows)
    ]


def solved(rows: list[list], right: list) -> list:
    """Gauss elimination within the band, without pivoting, which so many digits can afford."""
    n, rows, x = len(right), [row[:] for row in rows], right[:]
    for i in range(n):
        for k in range(i + 1, min(i + BAND + 1, n)):
            if factor := rows[k][i - k + BAND] / rows[i][BAND]:
                for j in range(i, min(i + BAND + 1, n)):
                    rows[k][j - k + BAND] -= factor * rows[i][j - i + BAND]
                x[k] -= factor * x[i]
    for i in reversed(range(n)):
        x[i] = (
            x[i] - mp.fsum(rows[i][d] * x[i + d - BAND] for d in range(BAND + 1, 2 * BAND + 1) if i + d - BAND < n)
        ) / rows[i][BAND]
    return x


def dot(x: list, y: list):
    return mp.fsum(a * b for a, b in zip(x, y, strict=True))


class Mode:
    """A mode of K, M to all digits, by inverse iteration from an approximation; derivatives by fixing its largest component."""

    def __init__(self, beam: Cantilever, eigenvalue: float, shape: np.ndarray):
        self.K, self.M = banded(beam.K), banded(beam.M)
        x, self.value = [mpf(float(v)) for v in shape], mpf(float(eigenvalue))
        for _ in range(4):
            x = solved(self._at(self.value * (1 + mpf(10) ** -12)), product(self.M, x))
            size = mp.sqrt(dot(x, product(self.M, x)))
            x = [v / size for v in x]
            self.value = dot(x, product(self.K, x))
        sign = 1 if float(dot(x, [mpf(float(v)) for v in shape])) > 0 else -1
        self.shape, self.largest = [sign * v for v in x], int(np.argmax(np.abs(shape)))

    def _at(self, value) -> list[list]:
        return [
            [a - value * b for a, b in zip(one, other, strict=True)] for one, other in zip(self.K, self.M, strict=True)
        ]

    def derivative(self, dK: csr_array, dM: csr_array) -> tuple[float, np.ndarray]:
        x, mass = self.shape, product(self.M, self.shape)
        inertia = product(banded(dM), x)
        force = [a - self.value * b for a, b in zip(product(banded(dK), x), inertia, strict=True)]
        change = dot(x, force)
        right = [change * a - b for a, b in zip(mass, force, strict=True)]
        fixed, rows = self.largest, self._at(self.value)
        for d in range(2 * BAND + 1):
            rows[fixed][d] = mpf(d == BAND)
            if 0 <= fixed + d - BAND < len(x) and d != BAND:
                rows[fixed + d - BAND][2 * BAND - d] = mpf(0)
        right[fixed] = mpf(0)
        v = solved(rows, right)
        along = -dot(mass, v) - dot(x, inertia) / 2
        return float(change), np.array([float(a + along * b) for a, b in zip(v, x, strict=True)])


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(40):
        yield


def closed_form(count: int) -> np.ndarray:
    """Eigenvalues of a cantilever: cos(b) cosh(b) = -1."""
    roots = [
        mp.findroot(lambda b: mp.cos(b) + 1 / mp.cosh(b), (mpf(i) - mpf(1) / 2) * mp.pi + (i == 1) * 0.3)
        for i in range(1, count + 1)
    ]
    return np.array([float(b) for b in roots]) ** 4 * STIFFNESS / MASS / LENGTH**4


@pytest.mark.parametrize("elements", [300, 2000])
def test_frequencies_of_a_long_beam(elements):
    """K in double precision allows about 1e-16 (elements / length of a wave)^2 or so; the closed form is nearer than that."""
    beam = Cantilever(elements)
    solution = eigensolution(beam.K, beam.M, 12)
    np.testing.assert_allclose(solution.eigenvalues, closed_form(12), rtol=2e-6)
    np.testing.assert_allclose(solution.shapes.T @ (beam.M @ solution.shapes), np.eye(12), atol=1e-12)
    for mode in (0,):
        exact = Mode(beam, solution.eigenvalues[mode], solution.shapes[:, mode])
        assert solution.eigenvalues[mode] == pytest.approx(float(exact.value), rel=3e-6)
        assert solution.shapes[:, mode] == pytest.approx(
            np.array([float(v) for v in exact.shape]), rel=0, abs=1e-5 * np.abs(solution.shapes[:, mode]).max()
        )


@pytest.mark.parametrize("warm", [False, True], ids=["from nothing", "from the same modes"])
@pytest.mark.parametrize(("elements", "accuracy"), [(150, FINAL), (150, EXACT), (600, FINAL), (2000, FINAL)])
def test_sensitivities_of_a_long_beam(elements, accuracy, warm):
    beam, modes = Cantilever(elements), np.arange(6)
    solver, residual = EigenSolver(), EXACT_SHAPES if accuracy == EXACT else TOLERANCE
    shift = -0.3 * closed_form(1)[0]
    for _ in range(1 + warm):
        solution = solver.solve(beam.K, beam.M, 12, shift, residual)
    at = 2 * np.linspace(5, elements - 1, 20).astype(int)
    partials = modal_partials(solution, beam.K, beam.M, modes, at, beam.pattern(), accuracy)
    for mode in (5,) if elements > 150 else (0, 2, 5):
        exact = Mode(beam, solution.eigenvalues[mode], solution.shapes[:, mode])
        for j in (1, GROUPS - 1, GROUPS + 2):
            value, shape = exact.derivative(*beam.derivatives(j))
            assert partials.d_lambda[mode, j] == pytest.approx(value, rel=2e-5 if elements == 2000 else 1e-6)
            error = np.abs(partials.d_shape[mode, :, j] - shape[at]).max() / np.abs(shape[at]).max()
            assert error < 2 * partials.error
            assert error < (1e-5 if elements == 2000 else accuracy)
