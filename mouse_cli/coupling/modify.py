"""The answer to a deck of changes: modes and functions before and after, with the uncertainty of the properties carried through.

To first order cov(f) = J S J' with J = df/dtheta before and after; the shift of a mode has (J_after - J_before) S (...)': what
both have in common cancels, so that a shift is known better than either frequency.
"""

import numpy as np

from mouse_cli._errors import ERROR, DeckError, Diagnostic, NumericalError
from mouse_cli.coupling.changed import changed, motion, resolved
from mouse_cli.coupling.modified_functions import modified_functions
from mouse_cli.coupling.sweep import swept
from mouse_cli.coupling.target import needs
from mouse_cli.dynamics.correlation import distance, mac, match
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.dynamics.solver import Notice
from mouse_cli.model.coupling import Connection, Modification
from mouse_cli.model.modified import Modified, Shifts
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast
from mouse_cli.terms.modal_damping import with_modal_damping
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
