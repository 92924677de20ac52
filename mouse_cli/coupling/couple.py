"""The answer to a deck of coupled structures: functions by Lagrange multipliers, natural frequencies by matrices and by modes.

Modal coupling of reduced parts (lecture 22), p = (p_A, p_B):  I p'' + (diag(Lambda_A, Lambda_B) + Phi' K_CC Phi) p = 0  for parts
between springs, and the same on the kernel of B Phi where they are joined rigidly.
"""

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic, NumericalError
from mouse_cli.coupling.functions import functions
from mouse_cli.coupling.lines import common_lines
from mouse_cli.coupling.peaks import peaks
from mouse_cli.coupling.reductions import Part, Reduced, reduction, registry
from mouse_cli.coupling.whole import added, assembled, boundary, kernel
from mouse_cli.dynamics.eigen import IndefiniteError, dense_solution
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.dynamics.solver import EigenSolver, Notice
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.coupled import Coupled, CoupledModes, InterfaceState, ReducedModes
from mouse_cli.model.coupling import Coupling, Synthesis
from mouse_cli.terms.assembly import assembly

_WORST = 0.05  # share of lines that may have an interface decided by noise before it is said


def couple(coupling: Coupling, notice: Notice = lambda text: None) -> Coupled:
    """What the deck asks for. Raises DeckError and NumericalError."""
    only_models = not any(part.measured or part.removed for part in coupling.substructures)
    if coupling.synthesis is not None and not only_models:
        named = ", ".join(part.name for part in coupling.substructures if part.measured or part.removed)
        message = f"natural frequencies are requested, but {named} has no matrices to add"
        raise DeckError.of("MD715", message, help="leave modes out, or give models")
    found, interface, warnings = None, None, []
    if coupling.responses:
        found, interface = functions(coupling, common_lines(coupling), notice)
        warnings += _doubts(interface)
    modes = coupled_modes(coupling, notice) if only_models else None
    if modes is not None and any(one.damping or one.loss_factor for one in coupling.connections):
        message = "natural frequencies and modal coupling leave dashpots and loss factors of connections out"
        warnings.append(Diagnostic("MD721", WARNING, message, help="functions have all of them"))
    maxima = () if found is None else peaks(found)
    return Coupled(coupling, found, interface, modes, maxima, (*coupling.warnings, *warnings))


def _doubts(interface: InterfaceState) -> list[Diagnostic]:
    """The warning (MD713) where noise decides the forces at the interface at more than a few lines."""
    with np.errstate(invalid="ignore"):
        lost = interface.condition * interface.noise > 1
    if lost.mean() <= _WORST:
        return []
    share = f"{int(lost.sum())} of {len(lost)} lines"
    message = f"noise decides the interface at {share}: its condition number times its noise is above 1"
    return [Diagnostic("MD713", WARNING, message, help="give truncate: 0.01, or join fewer degrees of freedom")]


_RIGID = 1e-8  # of the first elastic eigenvalue that is asked for
_COUNT = 10


def coupled_modes(coupling: Coupling, notice: Notice = lambda text: None) -> CoupledModes:
    """Lowest natural frequencies of the whole, and those of every reduction asked for. Raises DeckError, NumericalError."""
    asked = coupling.synthesis or Synthesis((), (), _COUNT)
    matrices = [assembly(part.problem).matrices(part.problem.prior.mean) for part in coupling.substructures]
    K, M = assembled(coupling, matrices)
    try:
        solution = EigenSolver(notice).solve(K, M, min(asked.count, K.shape[0]))
    except (IndefiniteError, np.linalg.LinAlgError) as reason:
        raise _unphysical(coupling, str(reason)) from None
    lam = solution.eigenvalues[: asked.count]
    rigid = int(np.count_nonzero(np.abs(lam) <= _RIGID * lam[-1])) if len(lam) else 0
    hz = np.where(np.arange(len(lam)) < rigid, 0.0, frequency_hz(lam))
    reduced = _reduced(coupling, asked, matrices, hz) if asked.keep else ()
    return CoupledModes(hz, rigid, K.shape[0], reduced)


def _reduced(
    coupling: Coupling, asked: Synthesis, matrices: list[tuple[Matrix, Matrix]], hz: np.ndarray
) -> tuple[ReducedModes, ...]:
    """Every method with every number of modes."""
    try:
        methods = [reduction(key) for key in asked.methods or registry()]
    except ValueError as error:
        raise DeckError.of("MD716", str(error), help="see `mouse list reductions`") from None
    places = [boundary(coupling, k) for k in range(len(matrices))]
    parts = [
        Part(*each, part.weights[at]) for each, part, at in zip(matrices, coupling.substructures, places, strict=True)
    ]
    found = []
    for method in methods:
        for keep in asked.keep:
            reduced = [method.reduce(part, keep) for part in parts]
            size, own = synthesised(coupling, reduced, places, len(hz))
            with np.errstate(divide="ignore", invalid="ignore"):
                error = np.where(hz > 0, own / hz - 1, np.nan)
            found.append(ReducedModes(method.key, keep, size, own, error))
    return tuple(found)


def synthesised(
    coupling: Coupling, reduced: list[Reduced], places: list[np.ndarray], count: int
) -> tuple[int, np.ndarray]:
    """Coordinates of the whole, and its lowest `count` frequencies (count,), NaN beyond those that it has."""
    from scipy.linalg import block_diag
    from scipy.sparse import csr_array

    K, M, S = (block_diag(*(getattr(each, name) for each in reduced)) for name in ("K", "M", "boundary"))
    first = np.cumsum([0, *(len(at) for at in places)])
    motion = lambda point: S[first[point.substructure] + np.searchsorted(places[point.substructure], point.place)]
    q = K.shape[0]
    B = np.array([motion(a) - motion(b) for a, b in coupling.interfaces]).reshape(len(coupling.interfaces), q)
    own = np.array([motion(one.at) - (motion(one.to) if one.to else 0.0) for one in coupling.connections])
    own = own.reshape(len(coupling.connections), q)
    dK, dM, _, _ = (each.toarray() for each in added(coupling.connections, csr_array(own), q))
    more = dK.shape[0] - q
    L = kernel(csr_array(np.pad(B, ((0, 0), (0, more))))).toarray()
    whole = [L.T @ (np.pad(each, (0, more)) + change) @ L for each, change in ((K, dK), (M, dM))]
    found = np.full(count, np.nan)
    try:
        lam = dense_solution(*((each + each.T) / 2 for each in whole)).eigenvalues if L.shape[1] else np.zeros(0)
    except (IndefiniteError, np.linalg.LinAlgError):
        lam = np.zeros(0)
    found[: len(lam)] = frequency_hz(lam[:count])
    return L.shape[1], found


def _unphysical(coupling: Coupling, reason: str) -> NumericalError:
    message = f"the whole of '{coupling.title.strip()}' is not physical: {reason}"
    return NumericalError(Diagnostic("MD720", ERROR, message, help="take away less mass and stiffness"))
