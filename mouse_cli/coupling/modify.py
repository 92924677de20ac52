"""The answer to a deck of changes: modes and functions before and after, with the uncertainty of the properties carried through.

To first order cov(f) = J S J' with J = df/dtheta before and after; the shift of a mode has (J_after - J_before) S (...)': what
both have in common cancels, so that a shift is known better than either frequency. Of functions var = |dH/dtheta L|^2, S = L L'.
"""

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic, NumericalError
from mouse_cli.coupling.changed import changed, motion, resolved
from mouse_cli.coupling.parts import model_of
from mouse_cli.coupling.peaks import peaks
from mouse_cli.coupling.sweep import swept
from mouse_cli.coupling.target import needs
from mouse_cli.dynamics.correlation import distance, mac, match
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.dynamics.frf import Dynamics, FrfModel
from mouse_cli.dynamics.frf_slopes import Change, slopes
from mouse_cli.dynamics.solver import Notice
from mouse_cli.estimators.linear import in_prior_units
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.coupling import Connection, Modification
from mouse_cli.model.frf_test import KINDS, FrfTest
from mouse_cli.model.modified import Modified, ModifiedFunctions, Shifts
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast
from mouse_cli.terms.assembly import assembly as assemble
from mouse_cli.terms.modal_damping import with_modal_damping
from mouse_cli.updating.coordinates import coordinates
from mouse_cli.updating.forward import forecast

COUNT = 10  # modes of the answer unless a deck says otherwise
_UNLIKE = 1.0  # distance of two modes beyond which one is not the other


def modify(modification: Modification, notice: Notice = lambda text: None) -> Modified:
    """What the deck asks for. Raises DeckError (MD719) and NumericalError (MD501, MD720)."""
    problem = with_modal_damping(modification.problem)
    asked = [t.mode for t in modification.targets] + [s.mode for s in modification.sweeps]
    asked += [one.tuned_to for one in modification.changes if one.tuned_to is not None]
    hung = sum(one.hung for one in modification.changes)
    count = min(max([modification.count or COUNT, *(mode + 1 for mode in asked)]), problem.structure.n)
    before = forecast(problem, count, notice)
    for mode in asked:
        _known(mode, before, modification)
    b = motion(modification.changes, modification.part.weights)
    acting = resolved(modification.changes, eigenvalue(before.frequencies_hz), before.shapes, b)
    new = changed(problem, acting, b)
    after = _after(new, min(count + hung, new.structure.n), notice, modification)
    sought = needs(modification, new, after)
    tried = tuple(swept(modification, each, new, after) for each in modification.sweeps)
    functions = modified_functions(modification, problem, new, notice) if modification.responses else None
    return Modified(
        modification, acting, before, after, shifts(before, after), sought, tried, functions, modification.warnings
    )


def shifts(before: Forecast, after: Forecast) -> Shifts:
    """Each mode after the changes beside the one before that it came from: by MAC over the old degrees of freedom, and
    frequency."""
    n, hz = before.shapes.shape[0], after.frequencies_hz
    likeness = mac(after.shapes[:n], before.shapes)
    partner = match(distance(likeness, np.maximum(hz, 1e-9), before.frequencies_hz), _UNLIKE)
    have = partner >= 0
    at = np.maximum(partner, 0)
    root = after.root_hz - before.root_hz[at]
    shift = np.where(have, hz - before.frequencies_hz[at], np.nan)
    likeness = np.where(have, likeness[np.arange(len(hz)), at], np.nan)
    return Shifts(partner, likeness, shift, np.where(have, np.linalg.norm(root, axis=1), np.nan))


def _after(problem: Problem, count: int, notice: Notice, modification: Modification) -> Forecast:
    """The modes of the modified model. Raises NumericalError (MD720) where it is not physical."""
    try:
        return forecast(problem, count, notice)
    except NumericalError as error:
        reason = error.diagnostics[0]
        if reason.code != "MD501":
            raise
        where = _worst(modification.changes)
        message = f"the modified model is not physical: {reason.message.rpartition('physical: ')[2]}"
        raise NumericalError(
            Diagnostic("MD720", ERROR, message, where, help="take away less mass or stiffness")
        ) from None


def _worst(changes: tuple[Connection, ...]):
    """Where the change stands that takes something away."""
    return next((one.where for one in changes if one.mass < 0 or one.stiffness < 0), None)


def _known(mode: int, before: Forecast, modification: Modification) -> None:
    if before.rigid_modes < mode <= len(before.frequencies_hz):
        return
    what = "is a rigid-body mode" if mode <= before.rigid_modes else "is beyond those of the model"
    message = f"mode {mode} {what}; elastic modes are {before.rigid_modes + 1} to {before.problem.structure.n}"
    where = next((t.where for t in modification.targets if t.mode == mode), None)
    raise DeckError.of("MD719", message, where, help="name one of the modes that `mouse modes` lists")


_ROOM = 2_000_000  # complex numbers of derivatives held at once


def modified_functions(
    modification: Modification, before: Problem, after: Problem, notice: Notice = lambda text: None
) -> ModifiedFunctions:
    """The functions that the deck asks for, of both models."""
    hz = modification.lines.frequency_hz
    power = KINDS[modification.kind]
    hz = hz[hz > 0] if power else hz
    old, _ = _functions(modification, before, hz, notice)
    new, sd_log = _functions(modification, after, hz, notice)
    return ModifiedFunctions(old, new, sd_log, peaks(old), peaks(new))


def _functions(
    modification: Modification, problem: Problem, hz: np.ndarray, notice: Notice
) -> tuple[FrfTest, np.ndarray]:
    """Functions with their variance, and standard deviations (f, o, i) of the logarithm of their magnitudes."""
    assembly, theta, s = assemble(problem), problem.prior.mean, 2j * np.pi * hz
    places = [list(modification.responses), list(modification.forces)]
    weights = _wide(modification.part.weights, problem.structure.n)
    dynamics = Dynamics(*assembly.matrices(theta), *assembly.damping(theta))
    model = model_of(dynamics, tuple(weights[at] for at in places), s, notice)
    change = Change(assembly.n, assembly.p, assembly.slopes(theta))
    H, variance, sd_log = _solved(model, s, change, coordinates(problem, assembly))
    factor = (s ** KINDS[modification.kind])[:, None, None]
    names = [tuple(modification.part.places[i] for i in at) for at in places]
    test = FrfTest(
        hz, H * factor, modification.kind, np.arange(len(names[0])), np.arange(len(names[1])), variance * np.abs(factor) ** 2,
        *names, title=modification.title, path=modification.path,
    )  # fmt: skip
    return test, sd_log


def _solved(model: FrfModel, s: np.ndarray, change: Change, prior) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Receptance, variance, and sd of ln|H|, some lines at a time."""
    slope, parts = prior.slope(prior.mean), []
    each = max(1, _ROOM // (model.d * model.loads.shape[1] + model.loads.shape[1] ** 2 * max(change.p, 1)))
    for first in range(0, len(s), each):
        fields = model.at(s[first : first + each])
        H = fields.receptance()
        J = np.zeros((*H.shape, max(change.p, 1)), complex)
        if change.p:
            for part, values in slopes(fields, change):
                J[..., part] = values
            J = in_prior_units((J * slope).reshape(-1, change.p), prior.L).reshape(*H.shape, -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = (J / H[..., None]).real
        parts.append((H, (np.abs(J) ** 2).sum(axis=-1), np.sqrt((relative**2).sum(axis=-1))))
    return tuple(np.concatenate(column) for column in zip(*parts, strict=True))


def _wide(weights: Matrix, n: int) -> Matrix:
    """Rows of the places over the degrees of freedom of the modified model, absorbers among them."""
    found = weights.copy()
    found.resize((weights.shape[0], n))
    return found
