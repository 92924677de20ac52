"""The answer to a deck of coupled structures: functions by Lagrange multipliers, natural frequencies by matrices and by modes."""

import numpy as np

from mouse_cli._errors import WARNING, DeckError, Diagnostic
from mouse_cli.coupling.functions import functions
from mouse_cli.coupling.lines import common_lines
from mouse_cli.coupling.peaks import peaks
from mouse_cli.coupling.synthesis import coupled_modes
from mouse_cli.dynamics.solver import Notice
from mouse_cli.model.coupled import Coupled, InterfaceState
from mouse_cli.model.coupling import Coupling

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
    if modes is not None and _damped(coupling):
        message = "natural frequencies and modal coupling leave dashpots and loss factors of connections out"
        warnings.append(Diagnostic("MD721", WARNING, message, help="functions have all of them"))
    told = () if found is None else peaks(found)
    return Coupled(coupling, found, interface, modes, told, (*coupling.warnings, *warnings))


def _doubts(interface: InterfaceState) -> list[Diagnostic]:
    """The warning (MD713) where noise decides the forces at the interface at more than a few lines."""
    with np.errstate(invalid="ignore"):
        lost = interface.condition * interface.noise > 1
    if lost.mean() <= _WORST:
        return []
    told = f"{int(lost.sum())} of {len(lost)} lines"
    message = f"noise decides the interface at {told}: its condition number times its noise is above 1"
    return [Diagnostic("MD713", WARNING, message, help="give truncate: 0.01, or join fewer degrees of freedom")]


def _damped(coupling: Coupling) -> bool:
    return any(one.damping or one.loss_factor for one in coupling.connections)
