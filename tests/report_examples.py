"""Results of every kind that a report must be able to tell, built from figures with their source."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem, RunOptions, Source
from mouse_cli.model.result import Forecast, Result
from mouse_cli.model.spectra import MeasuredFrf, Quality, SpectraOptions, SpectraResult
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.updating import forecast, run

# Table 5-1: natural frequencies, Hz, and modal matrix of the true system.
TRUE_HZ = (18.0676, 54.6289, 94.3734, 113.959)
TRUE_SHAPES = (
    (0.293227, -0.670209, 0.646597, -0.216220),
    (0.444265, -0.513114, -0.584744, 0.444316),
    (0.578353, 0.203809, -0.295936, -0.732388),
    (0.618186, 0.495980, 0.390396, 0.468445),
)
# Table 5-3: test frequencies, test modal matrix, variances of the eigenvalues (6), sd of the shapes sqrt(2.5e-3).
TEST_HZ = (17.9415, 54.6245, 95.5183, 115.250)
TEST_SHAPES = (
    (0.320877, -0.597509, 0.655247, -0.298320),
    (0.483715, -0.560864, -0.570894, 0.466466),
    (0.558403, 0.192409, -0.298186, -0.756338),
    (0.652936, 0.500780, 0.383446, 0.355445),
)
VARIANCES = (6.6564e4, 5.5507e6, 4.9421e7, 1.0510e8)
SHAPE_SD = 0.05


def chain(hz=TEST_HZ, shapes=TEST_SHAPES, scale: str = "none", **options) -> Problem:
    """The four-mass chain of Tables 5-2 and 5-3 with k1 = 100000 and k2 = 150000 before the test."""
    K = np.array([[2.5, -1.5, 0, 0], [-1.5, 2.65, -1.15, 0], [0, -1.15, 3.15, -2], [0, 0, -2, 2]]) * 1e5
    sd_hz = np.sqrt(VARIANCES) / (8 * np.pi**2 * np.array(TEST_HZ))
    shapes = np.array(shapes)
    test = ModalTest([1, 2, 3, 4], hz, sd_hz, [0, 1, 2, 3], shapes, np.full((4, 4), SHAPE_SD), scale)
    return Problem(
        title="Four-mass chain",
        structure=Structure(K, np.eye(4)),
        elements=ListedElements([0, 0, 0], [0, 0, 1], [0, 1, 1]),
        A=np.array([[1, 1], [0, -1], [0, 1.0]]),
        parameters=(Parameter("k1", 8485.2814, 1e5, "N/m"), Parameter("k2", 1e4, 1.5e5, "N/m")),
        prior=Gaussian([1e5, 1.5e5], [7.2e7, 1e8]),
        test=test,
        run=replace(RunOptions(pairing="number"), **options),
    )


def long_chain(n: int, properties: int, sparse: bool = False, **options) -> Problem:
    """A chain of n unit masses, fixed at one end, whose first springs may vary; its springs are truly 10 % softer."""
    K = np.diag(np.full(n, 2.0)) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1)
    K[-1, -1] = 1.0
    K *= 1e6
    row, col, A = _springs(properties)
    hz, shapes = _modes(0.9 * K)
    dofs = np.arange(0, n, max(1, n // 10))
    test = ModalTest(
        np.arange(1, 4),
        hz[:3],
        0.01 * hz[:3],
        dofs,
        shapes[dofs, :3],
        np.full((len(dofs), 3), 0.01),
        "least-squares",
    )
    if sparse:
        from scipy.sparse import csr_array

        structure = Structure(csr_array(K), csr_array(np.eye(n)))
    else:
        structure = Structure(K, np.eye(n))
    names = tuple(Parameter(f"spring {i + 1}", 2e5, 1e6) for i in range(properties))
    return Problem(
        title="Long chain",
        structure=structure,
        elements=ListedElements(np.zeros(len(row)), row, col),
        A=A,
        parameters=names,
        prior=Gaussian(np.full(properties, 1e6), np.full(properties, 4e10)),
        test=test,
        run=replace(RunOptions(), **options),
    )


def _springs(p: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Listed elements k(1,1), k(1,2), k(2,2), ... that the first p springs move, and A (2p - 1, p)."""
    places = [(i, j) for i in range(p) for j in (i, i + 1) if j < p]
    A = np.zeros((len(places), p))
    for e, (i, j) in enumerate(places):
        A[e, j] = 1.0 if i == j else -1.0
        if i == j and i + 1 < p:
            A[e, i + 1] = 1.0
    return np.array([i for i, _ in places]), np.array([j for _, j in places]), A


def _modes(K: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Natural frequencies in Hz and shapes for unit masses."""
    values, vectors = np.linalg.eigh(K)
    return np.sqrt(values) / (2 * np.pi), vectors


def _missing() -> Problem:
    """No frequency of mode 2, no shape of mode 3, single points missing, scales fitted."""
    hz, shapes = np.array(TEST_HZ), np.array(TEST_SHAPES)
    hz[1], shapes[:, 2], shapes[0, 0] = np.nan, np.nan, np.nan
    return chain(hz, shapes, scale="fitted")


def _indefinite() -> Problem:
    """Frequencies so low that the recursion of 1972 drives a stiffness negative."""
    problem = chain(tuple(0.3 * f for f in TEST_HZ), recursion="replaced", partials=20)
    return replace(problem, prior=Gaussian([1e5, 1.5e5], [1e12, 1e12]))


def _unobservable() -> Problem:
    """Two properties and one datum, estimated without a prior."""
    problem = chain(estimator="least-squares")
    nothing = np.full((4, 1), np.nan)
    test = ModalTest([1], [17.9], [0.2], [0, 1, 2, 3], nothing, nothing, "none")
    return replace(problem, test=test)


def _cards() -> Problem:
    """Counted in changes, with an echo whose second card is longer than the page and holds what no card can."""
    lines = ("FOUR-MASS CHAIN", "\t" + "1234567890" * 15, "       4       4   \x1b[31m `` | * {0}")
    problem = chain(recursion="replaced", partials=5)
    return replace(
        problem,
        title="Four | mass {chain}\r\n*",
        parameters=(Parameter("p1", 8485.2814), Parameter("p2", 1e4, lower=-2e4)),
        prior=Gaussian([0, 0], [[7.2e7, 1e7], [1e7, 1e8]]),
        source=Source("chain.dat", "cards", lines),
    )


def _logarithmic() -> Problem:
    """Logarithmic, limited, held: every kind of property, with long names."""
    named = (
        Parameter(
            "a|stiffness_of the first spring, as bought from the maker in 1971 " * 2,
            8485.2814,
            1e5,
            transform="log",
        ),
        Parameter("k2", 1e4, 1.5e5, "N/m", lower=1.49e5),
    )
    return replace(chain(print_partials=True), parameters=named)


def _rejected() -> Problem:
    """A test that no chain of this form can give."""
    return chain(tuple(f * g for f, g in zip(TEST_HZ, (1.3, 0.8, 1.2, 0.9), strict=True)))


PROBLEMS: dict[str, Callable[[], Problem]] = {
    "noisy": lambda: chain(recursion="replaced", partials=5, print_partials=True),
    "perfect": lambda: chain(TRUE_HZ, TRUE_SHAPES, recursion="replaced", cycles=2),
    "anchored": chain,
    "missing": _missing,
    "indefinite": _indefinite,
    "unobservable": _unobservable,
    "cards": _cards,
    "logarithmic": _logarithmic,
    "rejected": _rejected,
    "thirty": lambda: long_chain(31, 30),
    "sparse": lambda: long_chain(200, 3, sparse=True),
    "exact": lambda: long_chain(31, 30, print_partials=True, fix_total_mass=True, limit_sd=0.5),
}


@cache
def result(name: str) -> Result:
    """The result of the problem called `name`."""
    return run(PROBLEMS[name]())


FORECASTS: dict[str, Callable[[], Forecast]] = {
    "chain": lambda: forecast(chain()),
    "sparse": lambda: forecast(long_chain(200, 3, sparse=True), 12),
    "free": lambda: forecast(_free()),
}


def _free() -> Problem:
    """Two masses and a spring in space: one rigid-body mode, no test."""
    problem = chain()
    K = np.array([[1.0, -1.0], [-1.0, 1.0]]) * 1e5
    listed, A = ListedElements([0, 0, 0], [0, 0, 1], [0, 1, 1]), np.array([[1.0], [-1.0], [1.0]])
    return replace(
        problem,
        structure=Structure(K, np.eye(2)),
        elements=listed,
        A=A,
        parameters=problem.parameters[:1],
        prior=Gaussian([1e5], [7.2e7]),
        test=None,
    )


def spectra() -> SpectraResult:
    """Two functions, one of a force with an exponential window, as `mouse spectra` reports them."""
    hz = np.array([10.0, 20.0, 30.0])
    H = np.array([[[0.5], [1j]], [[2.0], [3j]], [[1.0], [np.nan]]])
    frf = FrfTest(
        hz, H, "accelerance", np.array([0, 1]), np.array([0]), np.full((3, 2, 1), 0.02), ("1", "12-TY"), ("1",),
        np.full((3, 2), 0.9), "taps", decay_rate=4.60517,
    )  # fmt: skip
    quality = (Quality("1", "1", 3, 0.9, 0.1, 20.0), Quality("12-TY", "1", 2, 0.9, 0.0666667, 20.0))
    measured = MeasuredFrf(frf, 5.0, 5, 1024, 1000.0, ("taps",), quality)
    options = SpectraOptions(window="exponential", impact=True, skip=100)
    return SpectraResult("taps", "taps.csv", options, (measured,))
