"""The model at given values of its parameters, and what follows from that: eigensolution, predictions, partials."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli._errors import NumericalError
from mouse_cli.dynamics.correlation import align, mac, pair
from mouse_cli.dynamics.eigen import RIGID, EigenSolution, IndefiniteError, clusters
from mouse_cli.dynamics.forces import Forces, forces
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.dynamics.frf_slopes import Change
from mouse_cli.dynamics.sensitivity import EXACT, FINAL, modal_partials
from mouse_cli.dynamics.solver import EXACT as EXACT_SHAPES
from mouse_cli.dynamics.solver import TOLERANCE, EigenSolver
from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.observables.modal import ModalObservable
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.matrix_entries import MatrixEntries
from mouse_cli.updating.coordinates import Coordinates
from mouse_cli.updating.frf_state import FrfSetting, FrfState

_ROUNDING = 1e-15  # error of an eigenvalue for each degree of freedom, as a share of the largest of all
_UNSEEN = 1e-10  # the same where only the lowest eigenvalues are known, as a share of the largest of those
_DIGITS = 3e-14  # error of an element of K that comes from a file of 14 digits, relative
_CANCELLED = 1e5  # by what elements of K may have lost digits
_APART, _BELOW = (1e-5, 1e-4), 0.1  # share of the next eigenvalue of those that are zero; and where one is below by a share of them


@dataclass(frozen=True)
class Setting:
    """What stays the same during a run: problem, assembly, coordinates, data at the scale of the theory, and the eigensolver.

    y, sd (q,): the data of `observable`, then those of `frf` where frequency response functions are fitted.
    """

    problem: Problem
    assembly: Assembly
    coordinates: Coordinates
    observable: ModalObservable
    y: np.ndarray
    sd: np.ndarray
    solver: EigenSolver
    frf: FrfSetting | None = None

    def labels(self) -> list[str]:
        """Names (q,) of the data."""
        more = () if self.frf is None else self.frf.observables
        return [*self.observable.labels(), *(label for o in more for label in o.labels())]

    @cached_property
    def _constant_forces(self) -> Forces:
        return self._forces(np.zeros(self.assembly.p))

    def forces(self, theta: np.ndarray) -> Forces:
        """Derivatives of K and M at theta (p,), as forces on a mode."""
        return self._constant_forces if self.assembly.linear else self._forces(theta)

    def _forces(self, theta: np.ndarray) -> Forces:
        return forces(self.assembly.n, self.assembly.p, self.assembly.slopes(theta))

    @cached_property
    def _constant_change(self) -> Change:
        return self._change(np.zeros(self.assembly.p))

    def change(self, theta: np.ndarray) -> Change:
        """Derivatives of K, M, C and D at theta (p,), for FRFs."""
        return self._constant_change if self.assembly.linear else self._change(theta)

    def _change(self, theta: np.ndarray) -> Change:
        return Change(self.assembly.n, self.assembly.p, self.assembly.slopes(theta))

    def solve(self, K: Matrix, M: Matrix, verify: bool = False) -> EigenSolution:
        """Eigensolution with the modes that the data need. Raises IndefiniteError."""
        count = None if self.frf is None else self.frf.count
        return solve(self.problem, K, M, count, self.solver, verify)

    def state(self, u: np.ndarray) -> "State":
        """The model at the coordinates u (p,). Raises IndefiniteError when K or M is not physical there."""
        return State(self, u)


class State:
    """The model at coordinates u (p,): everything else is computed when first asked for, and once.

    solution: of the model at u, where it is known already. error: estimated relative error of T, None where it is not estimated.
    """

    def __init__(self, setting: Setting, u: np.ndarray, solution: EigenSolution | None = None):
        self.setting, self.u = setting, u
        problem = setting.problem
        self.theta, self.error = setting.coordinates.value(u), None
        self.K, self.M = setting.assembly.matrices(self.theta)
        self.solution = setting.solve(self.K, self.M) if solution is None else solution
        self.modes = paired(problem, self.solution)
        self.solution = aligned(self.solution, self.modes, setting.observable)
        self.shapes, self.factor = setting.observable.theory(self.solution, self.modes)
        self.frf = self._frf() if setting.frf is not None else None

    def _frf(self, final: bool = False) -> FrfState:
        setting = self.setting
        return FrfState(setting.frf, setting.assembly, self.theta, self.K, self.M, self.solution, final)

    @cached_property
    def predicted(self) -> np.ndarray:
        """h(theta) (q,): the data as this model predicts them."""
        modal = self.setting.observable.stacked(self.solution.eigenvalues[self.modes], self.shapes.T)
        return modal if self.frf is None else np.concatenate([modal, self.frf.predicted])

    @cached_property
    def residual(self) -> np.ndarray:
        """Delta (q,): measured minus predicted, Eq. O-2."""
        return self.setting.y - self.predicted

    @cached_property
    def chi2(self) -> float:
        """r'R^-1 r."""
        return float(np.sum((self.residual / self.setting.sd) ** 2))

    @cached_property
    def B(self) -> np.ndarray:
        """d(data)/d(listed elements) (q, e), Eq. O-4; only for those who want to read it."""
        problem = self.setting.problem
        listed = MatrixEntries(problem.elements, problem.A, problem.prior.mean)
        n, e, slopes = self.setting.assembly.n, len(problem.elements), listed.by_element()
        modal = self._modal_partials(forces(n, e, slopes), FINAL)
        return modal if self.frf is None else np.concatenate([modal, self.frf.partials(Change(n, e, slopes))])

    @cached_property
    def T(self) -> np.ndarray:
        """d(data)/du (q, p), Eqs. O-4 and O-5."""
        return self._T(EXACT if self.setting.problem.run.exact else None)

    def settle(self) -> None:
        """For the end of a run: T to the accuracy that is reported, and the modes counted. Small models have both as it is."""
        if self.solution.space is None:
            self.error = 0.0
            return
        self._solve_again(verify=True)
        if self.frf is not None:
            self.frf = self._frf(final=True)
        self.T = self._T(EXACT if self.setting.problem.run.exact else FINAL)

    def _T(self, accuracy: float | None) -> np.ndarray:
        T, coordinates = self._modal_partials(self.setting.forces(self.theta), accuracy), self.setting.coordinates
        if self.frf is not None:
            T = np.concatenate([T, self.frf.partials(self.setting.change(self.theta))])
        return T * coordinates.slope(self.u) if coordinates.logarithmic.any() else T

    def _modal_partials(self, pattern: Forces, accuracy: float | None) -> np.ndarray:
        """d(eigenvalues and shapes)/d(what `pattern` moves)."""
        observable = self.setting.observable
        if not len(self.modes):
            return np.zeros((0, pattern.properties))
        at = observable.test.measured_at
        if self.solution.space is not None and not self.solution.space.current:
            self._solve_again()
        partials = modal_partials(self.solution, self.K, self.M, self.modes, at, pattern, accuracy)
        self.error = partials.error
        return observable.partials(partials, self.shapes, self.factor)

    def _solve_again(self, verify: bool = False) -> None:
        """Bring back the space of a solution after which another one was computed; shapes stay, with their signs."""
        again = self.setting.solve(self.K, self.M, verify)
        self.solution = replace(self.solution, space=again.space, shift=again.shift, verified=again.verified)

    @cached_property
    def mac(self) -> np.ndarray:
        """MAC (m,) of each measured shape with its model mode; NaN where no shape was measured."""
        test = self.setting.observable.test
        values = mac(test.shapes, test.read(self.solution.shapes[:, self.modes])).diagonal()
        return np.where(np.isfinite(test.shapes).any(axis=0), values, np.nan)


def reference_eigenvalue(problem: Problem, eigenvalues: np.ndarray) -> float:
    """The eigenvalue by which zero is judged: that of the first measured mode, else what rounding makes of zero."""
    measured = _lowest_measured(problem)
    if measured is not None:
        return measured
    whole = len(eigenvalues) == problem.structure.n
    zero = _ROUNDING * len(eigenvalues) if whole else _UNSEEN
    return float(np.abs(eigenvalues).max()) * zero / RIGID


def zero_eigenvalue(problem: Problem, solution: EigenSolution, K: Matrix) -> float:
    """The same of a solution of K. Without a measured one, those far below the next that digits of K leave open are zero too."""
    found = reference_eigenvalue(problem, solution.eigenvalues)
    if _lowest_measured(problem) is not None:
        return found
    squares, X = (K.multiply(K) if is_sparse(K) else K**2), solution.shapes**2
    sd = _DIGITS * np.sqrt(np.einsum("im,im->m", X, squares @ X))
    near = np.abs(solution.eigenvalues) <= _CANCELLED * sd
    first = 0 if near.all() else int(np.argmin(near))
    own, following = solution.eigenvalues[:first], float(solution.eigenvalues[first])
    largest = float(np.abs(own).max(initial=0.0))
    apart = _APART[bool((own < -_BELOW * largest).any())]
    return found if largest > apart * following else max(found, largest * (1 + _UNSEEN) / RIGID)


def _lowest_measured(problem: Problem) -> float | None:
    """Eigenvalue of the lowest measured frequency; None when there is none."""
    if problem.test is None or not np.isfinite(problem.test.frequency_hz).any():
        return None
    return float(eigenvalue(np.nanmin(problem.test.frequency_hz)))


def solve(
    problem: Problem,
    K: Matrix,
    M: Matrix,
    count: int | None = None,
    solver: EigenSolver | None = None,
    verify: bool = False,
) -> EigenSolution:
    """Eigensolution of K, M as the problem needs it.

    Raises IndefiniteError when an eigenvalue is negative beyond what rounding makes of a rigid-body mode, NumericalError where
    there is not the memory.
    """
    measured = _lowest_measured(problem)
    shift = None if measured is None else -0.3 * measured
    tolerance = EXACT_SHAPES if problem.run.exact else TOLERANCE
    try:
        solution = (EigenSolver() if solver is None else solver).solve(
            K, M, count or _modes_needed(problem), shift, tolerance, verify
        )
    except NumericalError as refused:
        raise _of_deck(problem, refused) from None
    lowest = float(solution.eigenvalues[0])
    if lowest < -RIGID * zero_eigenvalue(problem, solution, K):
        raise IndefiniteError(f"the stiffness matrix has the negative eigenvalue {lowest:.6g} (rad/s)^2")
    return solution


def _of_deck(problem: Problem, refused: NumericalError) -> NumericalError:
    """The error with the deck and its place."""
    note, at = f"the deck is '{problem.title.strip()}'", problem.place("order")
    return NumericalError([replace(each, span=each.span or at, note=each.note or note) for each in refused.diagnostics])


def _modes_needed(problem: Problem) -> int:
    """Modes that a sparse model is solved for: the highest measured one, its twin, and some more where shapes decide."""
    if problem.test is None:
        return min(16, problem.structure.n)
    more = 2 if problem.run.pairing == "number" else 6
    return min(int(problem.test.number.max(initial=0)) + more, problem.structure.n)


def paired(problem: Problem, solution: EigenSolution) -> np.ndarray:
    """Index (m,) from 0 of the model mode that each measured mode is: by number, or by MAC and frequency."""
    test = problem.test
    by_number = test.number - 1
    have = np.isfinite(test.shapes)
    if problem.run.pairing == "number" or not len(have) or have.sum(axis=0).min() < 2:
        return by_number
    reach = min(solution.shapes.shape[1], 2 * int(test.number.max(initial=0)) + 6)
    hz = solution.frequencies_hz[:reach].copy()
    hz[solution.eigenvalues[:reach] <= RIGID * reference_eigenvalue(problem, solution.eigenvalues)] = 0.0
    return pair(test.shapes, test.frequency_hz, test.read(solution.shapes[:, :reach]), hz)


def aligned(solution: EigenSolution, modes: np.ndarray, observable: ModalObservable) -> EigenSolution:
    """The solution with the shapes of equal frequencies rotated within their subspace onto the measured ones."""
    family = clusters(solution.eigenvalues, solution.zero)
    if family[-1] == len(family) - 1:  # every eigenvalue stands alone
        return solution
    crowded = [c for c in np.unique(family[modes]) if np.count_nonzero(family == c) > 1]
    if not crowded or not observable.test.s:
        return solution
    shapes = solution.shapes.copy()
    for cluster in crowded:
        members = np.flatnonzero(family == cluster)
        measured = [i for i in range(len(modes)) if modes[i] in members and observable.has_shape[:, i].all()]
        if measured:
            rotation = align(observable.test.read(shapes[:, members]), observable.shapes[:, measured])
            rotated = shapes[:, members] @ rotation
            order = [int(np.flatnonzero(members == modes[i])[0]) for i in measured]
            rest = [j for j in range(len(members)) if j not in order]
            shapes[:, members[order + rest]] = rotated
    return replace(solution, shapes=shapes)


def attempt(setting: Setting, u: np.ndarray) -> State | None:
    """The state at u, or None where the model is not physical or not finite there."""
    if not np.isfinite(u).all():
        return None
    try:
        return setting.state(u)
    except (IndefiniteError, np.linalg.LinAlgError):
        return None
