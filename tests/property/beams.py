"""A free-free stepped beam in bending, with or without shear, by the textbook two-node element (Przemieniecki 1968, ch. 5)."""

import numpy as np
from scipy.linalg import eigh

from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.structure import ListedElements, Structure

LENGTH, ELEMENTS, GROUPS = 60.0, 16, 4  # m; elements; groups of equal EI, one parameter each
EI, MASS = 2.0e9, 800.0  # N m2, kg/m


def element(ei: float, length: float, phi: float) -> np.ndarray:
    """Stiffness of (w1, r1, w2, r2); phi = 12 EI / (GA_s L^2), 0 in a slender beam."""
    L = length
    k = np.array(
        [
            [12, 6 * L, -12, 6 * L],
            [6 * L, (4 + phi) * L**2, -6 * L, (2 - phi) * L**2],
            [-12, -6 * L, 12, -6 * L],
            [6 * L, (2 - phi) * L**2, -6 * L, (4 + phi) * L**2],
        ]
    )
    return ei / (L**3 * (1 + phi)) * k


def stiffness(ei_by_group, shear: float = 0.0) -> np.ndarray:
    """K (34, 34); shear: flexibility 12 EI / (GA_s L^2) of one element."""
    return sum(ei * part for ei, part in zip(ei_by_group, group_parts(shear), strict=True))


def group_parts(shear: float = 0.0) -> list[np.ndarray]:
    """K of each group for EI = 1."""
    n, step = 2 * (ELEMENTS + 1), ELEMENTS // GROUPS
    parts = [np.zeros((n, n)) for _ in range(GROUPS)]
    for e in range(ELEMENTS):
        where = slice(2 * e, 2 * e + 4)
        parts[e // step][where, where] += element(1.0, LENGTH / ELEMENTS, shear)
    return parts


def mass() -> np.ndarray:
    """Diagonal mass matrix: masses, and rotary inertias of an element rotating about its end."""
    L = LENGTH / ELEMENTS
    ends = np.ones(ELEMENTS + 1)
    ends[[0, -1]] = 0.5
    return np.diag(np.column_stack([ends * MASS * L, ends * MASS * L**3 / 12]).ravel())


def bending_problem(test, sd: float, **options: object) -> Problem:
    """The bending-only model; EI of the four groups known to a share `sd`."""
    parts = group_parts()
    row, col = np.nonzero(np.triu(sum(abs(p) for p in parts)))
    A = np.array([p[row, col] for p in parts]).T
    nominal = np.full(GROUPS, EI)
    parameters = tuple(Parameter(f"EI {i + 1}", sd * EI, EI) for i in range(GROUPS))
    return Problem(
        title="bending only",
        structure=Structure(stiffness(nominal), mass()),
        elements=ListedElements([False] * len(row), row, col),
        A=A,
        parameters=parameters,
        prior=Gaussian(nominal, (sd * nominal) ** 2),
        test=test,
        run=RunOptions(**options),
    )


def vehicle_test(modes: int, shear: float, seed: int = 0) -> ModalTest:
    """The first elastic modes of a beam with `shear`: frequencies to 1 %, deflections to 5 % of the largest."""
    rng = np.random.default_rng(seed)
    lam, X = eigh(stiffness(np.full(GROUPS, EI), shear), mass())
    keep, points = np.arange(2, 2 + modes), np.arange(0, 2 * ELEMENTS + 2, 2)
    hz, shapes = np.sqrt(lam[keep]) / (2 * np.pi), X[np.ix_(points, keep)]
    sd = 0.05 * np.abs(shapes).max(axis=0) * np.ones_like(shapes)
    return ModalTest(
        keep + 1,
        hz * (1 + 0.01 * rng.standard_normal(modes)),
        0.01 * hz,
        points,
        shapes + sd * rng.standard_normal(shapes.shape),
        sd,
    )
