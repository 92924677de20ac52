"""The receptances of one substructure between its places, line by line: of its model, or as they were measured."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import NumericalError
from mouse_cli.coupling.picks import block, span
from mouse_cli.dynamics.eigen import IndefiniteError
from mouse_cli.dynamics.frf import Dynamics, Fields, FrfModel, Loads
from mouse_cli.dynamics.frf_basis import BEYOND, WHOLE, frf_model
from mouse_cli.dynamics.frf_slopes import Change, slopes
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.estimators.linear import in_prior_units
from mouse_cli.model.arrays import dense, is_sparse
from mouse_cli.model.coupling import Substructure
from mouse_cli.model.frf_test import KINDS
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.terms.modal_damping import with_modal_damping
from mouse_cli.updating import refusals
from mouse_cli.updating.coordinates import coordinates

EXACT = 1e-7  # relative error of functions in a basis; solutions that it is found by are no better than that
_DIRECT = 2e10  # lines times (degrees of freedom)^3 up to which a model is solved line by line as it is
_MODES = 20  # that the search for those of a band begins with


@dataclass(frozen=True)
class Receptances:
    """Y (f, l, r) between places left and right; variance (f, l, r), E|Y - mean|^2, NaN where unknown; None where exact. tied
    (l, r): the number, from 1, of the function that each is, negative where it is read backwards; None where each stands once.
    unknown: nothing is known of the variance."""

    Y: np.ndarray
    variance: np.ndarray | None = None
    tied: np.ndarray | None = None
    unknown: bool = False


class Modelled:
    """A substructure by its model. uncertain: number of its properties. error: relative, of functions in a basis; 0 where it
    is solved as it is."""

    def __init__(self, part: Substructure, s: np.ndarray, places: np.ndarray, notice: Notice = lambda text: None):
        problem = with_modal_damping(part.problem)
        assembly, theta = assemble(problem), problem.prior.mean
        self.places, self.uncertain = places, assembly.p
        self._change, self._prior = (
            Change(assembly.n, assembly.p, assembly.slopes(theta)),
            coordinates(problem, assembly),
        )
        try:
            self.model = model_of(
                Dynamics(*assembly.matrices(theta), *assembly.damping(theta)), (part.weights[places],), s, notice
            )
        except (IndefiniteError, np.linalg.LinAlgError) as reason:
            raise refusals.unphysical(part.problem, str(reason)) from None
        self.d, self.error = self.model.d, self.model.error

    def at(self, s: np.ndarray, lines: slice, left: np.ndarray, right: np.ndarray) -> Receptances:
        """Receptances at s (f,) from places `right` to places `left`; `lines` are their numbers, which do not matter here."""
        self._fields = self.model.at(s)
        rows, columns = np.searchsorted(self.places, left), np.searchsorted(self.places, right)
        return Receptances(self._fields.receptance(0, 0)[:, rows][:, :, columns])

    def spread(self, L: np.ndarray, left: np.ndarray, R: np.ndarray, right: np.ndarray) -> np.ndarray:
        """E|L dY R|^2 (f, o, i) of the lines asked for last, by the uncertainty of the properties: dY = -Y (dZ/dtheta) Y,
        carried by the motions Y L' and Y R of the part within the whole. L (f, o, l), R (f, r, i) for places left (l,) and
        right (r,)."""
        Y, model = self._fields.Y, self.model
        rows, columns = np.searchsorted(self.places, left), np.searchsorted(self.places, right)
        motions = [np.matmul(Y[:, :, rows], np.swapaxes(L, 1, 2)), np.matmul(Y[:, :, columns], R)]
        o, i = L.shape[1], R.shape[2]
        within = FrfModel(model.matrices, np.zeros((model.d, o + i)), [slice(0, o), slice(o, o + i)], model.V)
        J = np.empty((len(Y), o, i, self._change.p), complex)
        fields = Fields(within, self._fields.s, np.concatenate(motions, axis=2))
        for part, values in slopes(fields, self._change):
            J[..., part] = values
        slope = self._prior.slope(self._prior.mean)
        found = in_prior_units((J * slope).reshape(-1, self._change.p), self._prior.L)
        return (np.abs(found) ** 2).sum(axis=1).reshape(len(Y), o, i)


class Measured:
    """A substructure by measured functions at the lines (f,) of `s`; rows: numbers of these lines among those measured."""

    d, error, uncertain = 1, 0.0, 0

    def __init__(self, part: Substructure, s: np.ndarray, rows: np.ndarray):
        self.part, self.rows, frf = part, rows, part.frf
        self.power = KINDS[frf.kind]
        whole = np.isfinite(frf.H.sum(axis=0))  # NaN wherever one is in the sum: the way of nearly all
        self.have = whole if whole.all() else np.isfinite(frf.H).any(axis=0)
        self.unknown = not np.isfinite(frf.variance.sum(axis=0)).any()

    def at(self, s: np.ndarray, lines: slice, left: np.ndarray, right: np.ndarray) -> Receptances:
        """Receptances at `lines`; raises NumericalError (MD710) where a function is missing."""
        o, i = self.part.responses[left], self.part.forces[right]
        known = (o >= 0)[:, None] & (i >= 0)[None, :]
        known &= self.have[np.maximum(o, 0)][:, np.maximum(i, 0)]
        row, col = (np.broadcast_to(each, known.shape) for each in (o[:, None], i[None, :]))
        if not known.all():
            row, col = self._exchanged(known, row, col, left, right)
        own = span(self.rows[lines])
        Y, variance = (
            block(each[own], span(o), span(i)) if known.all() else each[own][:, row, col]
            for each in (self.part.frf.H, self.part.frf.variance)
        )
        signs = self.part.signs[left][:, None] * self.part.signs[right][None, :]
        factor = (s**self.power)[:, None, None] * signs
        if self.power or (signs != 1).any():
            Y, variance = Y / factor, variance if self.unknown else variance / np.abs(factor) ** 2
        if self.unknown:
            return Receptances(Y, unknown=True)
        number = (row * len(self.part.frf.input_names) + col + 1) * signs.astype(int)
        return Receptances(
            Y, variance, None if known.all() and len(set(o)) == len(o) and len(set(i)) == len(i) else number
        )

    def _exchanged(
        self, known: np.ndarray, row: np.ndarray, col: np.ndarray, left: np.ndarray, right: np.ndarray
    ) -> tuple:
        """Numbers of the functions with those that are missing in place of their twins, response and force exchanged."""
        back = self.part.responses[right][None, :], self.part.forces[left][:, None]
        there = (back[0] >= 0) & (back[1] >= 0) & self.part.reciprocal
        there = there & self.have[np.maximum(back[0], 0), np.maximum(back[1], 0)]
        if not (known | there).all():
            self._missing(*np.argwhere(~(known | there))[0], left, right)
        return np.where(known, row, back[0]), np.where(known, col, back[1])

    def _missing(self, a: int, b: int, left: np.ndarray, right: np.ndarray) -> None:
        names = self.part.places
        message = (
            f"the function of {names[left[a]]} by a force at {names[right[b]]} was not measured on {self.part.name}"
        )
        note = "nor was the one with response and force exchanged" if self.part.reciprocal else "reciprocal is false"
        help = "measure it, or leave the degree of freedom out"
        raise NumericalError.of("MD710", message, note=note, help=help)


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
