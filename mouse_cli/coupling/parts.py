"""The receptances of one substructure between its places, line by line: of its model, or as they were measured."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, NumericalError
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.frf import Dynamics, FrfModel, Loads
from mouse_cli.dynamics.frf_basis import BEYOND, WHOLE, frf_model
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.model.arrays import dense, is_sparse
from mouse_cli.model.coupling import Substructure
from mouse_cli.model.frf_test import KINDS
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.terms.modal_damping import with_modal_damping
from mouse_cli.updating import refusals

EXACT = 1e-10  # relative error of functions in a basis: an interface amplifies it by its condition number
_DIRECT = 2e10  # lines times (degrees of freedom)^3 up to which a model is solved line by line as it is
_MODES = 20  # that the search for those of a band begins with


@dataclass(frozen=True)
class Receptances:
    """Y (f, l, r) between places left and right; variance (f, l, r), E|Y - mean|^2, NaN where unknown; None where exact. tied
    (l, r): the number of the function that each was taken from by reciprocity, itself in most cases; None where there are none."""

    Y: np.ndarray
    variance: np.ndarray | None = None
    tied: np.ndarray | None = None


class Modelled:
    """A substructure by its model. error: relative, of functions in a basis; 0 where it is solved as it is."""

    def __init__(self, part: Substructure, s: np.ndarray, places: np.ndarray, notice: Notice = lambda text: None):
        problem = with_modal_damping(part.problem)
        assembly = assemble(problem)
        self.places = places
        try:
            self.model = model_of(
                Dynamics(*_matrices(assembly, problem.prior.mean)), (part.weights[places],), s, notice
            )
        except (IndefiniteError, np.linalg.LinAlgError) as reason:
            raise refusals.unphysical(part.problem, str(reason)) from None
        self.d, self.error = self.model.d, self.model.error

    def at(self, s: np.ndarray, lines: slice, left: np.ndarray, right: np.ndarray) -> Receptances:
        """Receptances at s (f,) from places `right` to places `left`; `lines` are their numbers, which do not matter here."""
        alpha = self.model.at(s).receptance(0, 0)
        rows, columns = np.searchsorted(self.places, left), np.searchsorted(self.places, right)
        return Receptances(alpha[:, rows][:, :, columns])


class Measured:
    """A substructure by measured functions at the lines (f,) of `s`; rows: numbers of these lines among those measured."""

    d, error = 1, 0.0

    def __init__(self, part: Substructure, s: np.ndarray, rows: np.ndarray):
        self.part, frf = part, part.frf
        factor = s ** KINDS[frf.kind]
        self.H = frf.H[rows] / factor[:, None, None]
        self.variance = frf.variance[rows] / np.abs(factor[:, None, None]) ** 2

    def at(self, s: np.ndarray, lines: slice, left: np.ndarray, right: np.ndarray) -> Receptances:
        """Receptances at `lines`; raises NumericalError (MD710) where a function is missing."""
        o, i = self.part.responses[left], self.part.forces[right]
        signs = self.part.signs[left][:, None] * self.part.signs[right][None, :]
        known = (o >= 0)[:, None] & (i >= 0)[None, :]
        row, col = np.broadcast_to(o[:, None], signs.shape), np.broadcast_to(i[None, :], signs.shape)
        known = known & np.isfinite(self.H).any(axis=0)[np.maximum(row, 0), np.maximum(col, 0)]
        if self.part.reciprocal:
            back_row, back_col = self.part.responses[right][None, :], self.part.forces[left][:, None]
            row, col = np.where(known, row, back_row), np.where(known, col, back_col)
            known = known | ((row >= 0) & (col >= 0))
        if not known.all():
            self._missing(*np.argwhere(~known)[0], left, right)
        Y, variance = self.H[lines][:, row, col] * signs, self.variance[lines][:, row, col]
        number = row * self.H.shape[2] + col
        return Receptances(Y, variance, number if len(np.unique(number)) < number.size else None)

    def _missing(self, a: int, b: int, left: np.ndarray, right: np.ndarray) -> None:
        names = self.part.places
        message = (
            f"the function of {names[left[a]]} by a force at {names[right[b]]} was not measured on {self.part.name}"
        )
        note = "nor was the one with response and force exchanged" if self.part.reciprocal else "reciprocal is false"
        help = "measure it, or leave the place out"
        raise NumericalError(Diagnostic("MD710", ERROR, message, note=note, help=help))


def model_of(dynamics: Dynamics, sensings: tuple, s: np.ndarray, notice: Notice = lambda text: None) -> FrfModel:
    """The model at lines s (f,), rad/s, for sets of places: as it is while that is cheap, else in a basis as exact as EXACT.

    Raises IndefiniteError, numpy.linalg.LinAlgError.
    """
    n = dynamics.n
    if n <= WHOLE or len(s) * float(n) ** 3 <= _DIRECT:
        whole = Dynamics(*(None if m is None else dense(m) for m in (dynamics.K, dynamics.M, dynamics.C, dynamics.D)))
        loads = Loads(sensings)
        return FrfModel(whole, loads.full(n), loads.columns)
    checked = s[np.unique(np.linspace(0, len(s) - 1, 3).astype(int))][::-1]
    return frf_model(dynamics, sensings, checked, _modes(dynamics, float(np.abs(s).max()), notice), EXACT)


def _modes(dynamics: Dynamics, top: float, notice: Notice):
    """The modes up to BEYOND times the highest line, of a sparse model with the space that they were found in."""
    solver, count = EigenSolver(notice), _MODES
    while True:
        solution = solver.solve(dynamics.K, dynamics.M, count)
        enough = not is_sparse(dynamics.K) or solution.complete or len(solution.eigenvalues) < count
        if enough or solution.eigenvalues[-1] > (BEYOND * top) ** 2 or 3 * count + 10 > dynamics.n:
            return solution
        count *= 2


def _matrices(assembly: Assembly, theta: np.ndarray) -> tuple:
    return *assembly.matrices(theta), *assembly.damping(theta)
