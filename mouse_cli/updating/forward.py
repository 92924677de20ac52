"""The forward problem (VIDAP, 1970): from uncertain properties to uncertain natural frequencies and mode shapes."""

import numpy as np

from mouse_cli.dynamics.complex_modes import complex_modes
from mouse_cli.dynamics.eigen import EigenSolution, IndefiniteError
from mouse_cli.dynamics.forces import forces
from mouse_cli.dynamics.frequency import sd_frequency_hz
from mouse_cli.dynamics.frf import Dynamics
from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.dynamics.sensitivity import modal_partials
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.estimators.linear import in_prior_units
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import DampedModes, Forecast
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.terms.modal_damping import with_modal_damping
from mouse_cli.updating import refusals
from mouse_cli.updating.coordinates import Coordinates, coordinates
from mouse_cli.updating.state import solve, zero_eigenvalue

_MOST = 2000  # degrees of freedom up to which all of every shape get standard deviations; beyond, the measured ones do


def forecast(problem: Problem, count: int | None = None, notice: Notice = lambda text: None) -> Forecast:
    """The lowest `count` modes with first-order standard deviations: cov(y) = T S T'.

    notice is called with a sentence as each phase of a large model begins. Raises NumericalError.

    >>> import mouse_cli
    >>> found = mouse_cli.modes(mouse_cli.read_deck("decks/cantilever.yaml"), 3)
    >>> found.frequencies_hz.round(2).tolist(), found.sd_hz.round(2).tolist()
    ([3.78, 24.83, 71.46], [0.09, 0.6, 1.67])
    """
    problem = with_modal_damping(problem)
    assembly = assemble(problem)
    K, M = assembly.matrices(problem.prior.mean)
    try:
        solution = solve(problem, K, M, count, EigenSolver(notice))
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    k = min(count or len(solution.eigenvalues), len(solution.eigenvalues))
    modes, dofs = np.arange(k), np.arange(problem.structure.n)
    sign = np.sign(solution.shapes[np.abs(solution.shapes).argmax(axis=0), np.arange(len(solution.eigenvalues))])
    root, sd_shape = _propagated(problem, assembly, solution, K, M, modes, dofs)
    hz = solution.frequencies_hz[:k]
    rigid = solution.rigid(zero_eigenvalue(problem, solution, K))
    elastic = (hz > 0) & (modes >= rigid)
    root_hz = np.where(elastic[:, None], sd_frequency_hz(hz[:, None], root), 0.0)
    sd_hz = np.linalg.norm(root_hz, axis=1)
    damped = _damped(problem, assembly, Dynamics(K, M, *assembly.damping(problem.prior.mean)), solution, k - rigid)
    return Forecast(problem, hz, sd_hz, (solution.shapes * sign)[:, :k], sd_shape, rigid, damped, root_hz)


def _propagated(
    problem: Problem, assembly: Assembly, solution: EigenSolution, K: Matrix, M: Matrix, modes: np.ndarray, dofs: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """The prior through the partials: a root (k, q) of the covariance of the eigenvalues, and sds (n, k) of the shapes."""
    prior = coordinates(problem, assembly)
    pattern = forces(assembly.n, assembly.p, assembly.slopes(problem.prior.mean))
    sd_shape = np.zeros((len(dofs), len(modes)))
    if len(dofs) > _MOST:
        at = np.zeros(0, int) if problem.test is None else np.unique(problem.test.dofs)
        partials = modal_partials(solution, K, M, modes, at, pattern)
        root, sd_shape[:] = _root(partials.d_lambda, prior), np.nan
        sd_shape[at] = np.reshape([_sd(each, prior) for each in partials.d_shape], (len(modes), len(at))).T
    else:
        root = _root(np.zeros((len(modes), assembly.p)), prior)
        for i in modes:  # mode by mode: the partials of all shapes at once would be n times larger than the model
            partials = modal_partials(solution, K, M, modes[i : i + 1], dofs, pattern)
            root[i] = _root(partials.d_lambda, prior)[0]
            sd_shape[:, i] = _sd(partials.d_shape[0], prior)
    return root, sd_shape


def _damped(
    problem: Problem, assembly: Assembly, dynamics: Dynamics, solution: EigenSolution, count: int
) -> DampedModes | None:
    """Complex modes, as many as there are elastic ones; None without damping."""
    if count <= 0 or not any(m is not None and abs(m).max() > 0 for m in (dynamics.C, dynamics.D)):
        return None
    theta, prior = problem.prior.mean, coordinates(problem, assembly)
    try:
        found = complex_modes(dynamics, solution, count)
    except np.linalg.LinAlgError as reason:
        raise refusals.unphysical(problem, str(reason)) from None
    slopes = found.damping_slopes(dynamics, Change(assembly.n, assembly.p, assembly.slopes(theta)))
    return DampedModes(
        found.frequencies_hz,
        found.damping,
        _sd(slopes, prior),
        found.complexity,
        found.shapes,
        float(found.error.max(initial=0.0)),
    )


def _root(T: np.ndarray, prior: Coordinates) -> np.ndarray:
    """Root B (q, r) of the covariance B B' of data whose derivatives by the values of the parameters are T (q, p)."""
    return in_prior_units(T * prior.slope(prior.mean), prior.L)


def _sd(T: np.ndarray, prior: Coordinates) -> np.ndarray:
    """Standard deviations (q,) of data whose derivatives by the values of the parameters are T (q, p)."""
    return np.linalg.norm(_root(T, prior), axis=1)
