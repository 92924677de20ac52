"""Checks of an import: parts sum to the whole, and with its supports the model has the solver's own frequencies."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.importing.calculix import Exported, Solver
from mouse_cli.importing.jobs import frequencies
from mouse_cli.importing.model import InputModel
from mouse_cli.importing.separate import Parts
from mouse_cli.model.arrays import Matrix

SUM, FREQUENCY = 1e-10, 1e-6  # largest relative differences
_DIGITS, _SD = 3e-14, 4.0  # sd of a number with 14 digits, relative; how many of what they leave open are no error
_COUNT, _PER_MODE = 8, 5  # elastic modes that are compared; degrees of freedom that ARPACK takes for each
_LARGE = 50_000  # degrees of freedom above which a factorisation costs more than another export
_OF_A_BODY = 6  # motions that it has where nothing holds it
_RIGID = 1e-6  # eigenvalues below this share of the highest compared are motions of a rigid body


@dataclass(frozen=True)
class Checked:
    """Relative differences; hz, own (m,): frequencies by the solver, and by the matrices that were imported.

    digits (m,): relative sd of the latter, as the solver writes 14 digits of K; only very thin shells lose as much as shows.
    matrices: of K and M with supports, of a large model, which then needs no frequencies.
    """

    sum_K: float
    sum_M: float
    hz: np.ndarray
    own: np.ndarray
    digits: np.ndarray
    matrices: float | None = None

    def text(self) -> str:
        """With what of the solver the imported model agrees, and how well."""
        if self.matrices is not None:
            return f"K and M with supports as the solver's, to {self.matrices:.1g}"
        return f"{len(self.hz)} frequencies with supports as the solver's, to {self.frequency:.1g}"

    @property
    def frequency(self) -> float:
        """The largest relative difference of a frequency."""
        return float(np.abs(self.own / self.hz - 1).max(initial=0.0))

    @property
    def open(self) -> float:
        """What the digits of the solver's file leave open of the frequency that differs most."""
        return float(self.digits[np.argmax(np.abs(self.own / self.hz - 1))]) if len(self.hz) else 0.0


def held_rows(model: InputModel, whole: Exported) -> list[tuple[str, list[int]]]:
    """For each support its rows (from 0). Raises DeckError (MD273) where a held node is no row of the export."""
    found, faults = [], []
    for support in model.supports:
        absent = [dof for dof in support.dofs if dof not in whole.rows.held]
        if absent:
            node, d = absent[0]
            message = f"support {support.name} holds node {node} in direction {d}, which a constraint or no element determines"
            help = "hold the reference node of the constraint, or, for rotations of a rigid body, give it a ROT NODE and hold that"
            faults.append(Diagnostic("MD273", ERROR, message, support.card.head.span, help=help))
        found.append((support.name, [i for dof in support.dofs for i in whole.rows.held.get(dof, ())]))
    if faults:
        raise DeckError(faults)
    return found


def begin(model: InputModel, whole: Exported, solver: Solver) -> None:
    """Lets the solver begin what `check` will ask for."""
    solver.begin([_supported(model) if _by_matrices(whole) else _asked(model, _kept(model, whole), whole)])


def _by_matrices(whole: Exported) -> bool:
    """Whether K and M with supports are compared, from which frequencies follow: a large model, of which nothing is expanded."""
    return whole.rows.T is None and whole.K.shape[0] > _LARGE


def _supported(model: InputModel) -> tuple[str, str]:
    """The job for K and M of the model as it was written, with its supports, and its title."""
    return frequencies(model, None), "K and M with supports"


def _same_matrices(model: InputModel, parts: Parts, solver: Solver) -> Checked:
    """With K and M of the solver, supports in place: relative differences of these stand for those of frequencies."""
    kept, theirs = _kept(model, parts.whole), solver.matrices(*_supported(model), *model.known)
    error = np.inf
    if theirs.K.shape[0] == len(kept):
        pairs = ((each[kept][:, kept], other) for each, other in ((parts.whole.K, theirs.K), (parts.whole.M, theirs.M)))
        error = max(float(abs(own - other).max() / abs(other).max()) for own, other in pairs)
    _refuse(model, max(parts.error), SUM, "the matrices of the groups miss the whole by")
    _refuse(model, error, SUM, "K and M with supports miss the solver's by")
    return Checked(*parts.error, *np.zeros((3, 0)), error)


def _kept(model: InputModel, whole: Exported) -> np.ndarray:
    """Rows that no support holds."""
    held = [i for _, rows in held_rows(model, whole) for i in rows]
    return np.setdiff1d(np.arange(whole.K.shape[0]), held)


def _asked(model: InputModel, kept: np.ndarray, whole: Exported) -> tuple[str, str]:
    """The job for frequencies with supports, and its title."""
    from scipy.sparse.csgraph import connected_components

    bodies = connected_components(whole.K[kept][:, kept], directed=False, return_labels=False)
    count = max(1, min(_COUNT + _OF_A_BODY * bodies, len(kept) // _PER_MODE))
    return frequencies(model, count), "frequencies with supports"


def check(model: InputModel, parts: Parts, solver: Solver) -> Checked:
    """Raises DeckError (MD275) where parts do not sum to the whole, or frequencies differ."""
    from mouse_cli.dynamics.eigen import IndefiniteError

    if _by_matrices(parts.whole):
        return _same_matrices(model, parts, solver)
    from mouse_cli.dynamics.solver import eigensolution

    kept = _kept(model, parts.whole)
    K, M = (each[kept][:, kept] for each in (parts.whole.K, parts.whole.M))
    theirs = np.sort(solver.eigenvalues(*_asked(model, kept, parts.whole)))
    try:
        solution = eigensolution(K, M, len(theirs))
        if len(solution.eigenvalues) < len(theirs):
            raise np.linalg.LinAlgError(f"only {len(solution.eigenvalues)} of {len(theirs)}")
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        help = "look for nodes and elements that are out of place, and for densities and moduli in other units"
        raise DeckError.of(
            "MD275", f"the matrices have no frequencies like the solver's: {reason}", Span(model.path, 1), help=help
        ) from reason
    own, X = solution.eigenvalues[: len(theirs)], solution.shapes[:, : len(theirs)]
    found = _compared(parts, K, theirs, own, X)
    if (
        found.frequency - _SD * found.open > FREQUENCY
    ):  # thin shells: what its iteration leaves is more than what its matrices do
        supported = solver.matrices(*_supported(model), *model.known)
        again = eigensolution(supported.K, supported.M, len(theirs)).eigenvalues[: len(theirs)]
        found = _compared(parts, K, again, own, X)
    _refuse(model, max(parts.error), SUM, "the matrices of the groups miss the whole by")
    _refuse(model, found.frequency - _SD * found.open, FREQUENCY, "frequencies with supports miss the solver's by")
    return found


def _compared(parts: Parts, K: Matrix, theirs: np.ndarray, own: np.ndarray, X: np.ndarray) -> Checked:
    """Of the elastic modes of both."""
    elastic = (theirs > _RIGID * theirs[-1]) & (own > _RIGID * theirs[-1])
    hz = [np.sqrt(each[elastic]) / (2 * np.pi) for each in (theirs, own)]
    digits = _left_open(K, X)[elastic] / (2 * own[elastic])
    return Checked(*parts.error, *hz, digits)


def _left_open(K, X: np.ndarray) -> np.ndarray:
    """sd (m,) of eigenvalues by the digits that the solver's file does not hold: of sum of dK_ij x_i x_j, all dK independent."""
    squares = K.multiply(K)
    return _DIGITS * np.sqrt(np.einsum("im,im->m", X**2, squares @ X**2))


def _refuse(model: InputModel, size: float, most: float, what: str) -> None:
    if not size <= most:
        message = f"{what} {size:.2g}; at most {most:.0e} is rounding"
        help = "a keyword of the input acts otherwise than it is read: import a part of the model to find which, and report it"
        raise DeckError.of("MD275", message, Span(model.path, 1), help=help)
