"""Rules for what is kept from every fit: it is there, it can be told apart, and something stays to be fitted."""

import numpy as np

from mouse_cli.formats.draft import AlteredDraft, Draft, HoldOutDraft
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.hold_out import Altered, HoldOut
from mouse_cli.model.modal_test import ModalTest


def hold_out(draft: Draft, test: ModalTest | None, geometry: Geometry | None) -> HoldOut | None:
    """The division of `test`; None where nothing is held out, or when a rule is broken."""
    given = draft.hold_out
    if given is None or not (given.modes or given.sensors or given.altered):
        return None
    if draft.test is None:
        message = "test.hold_out names modes or sensors of modes, but the deck has no test.modes"
        draft.error("MD430", message, given.where, help="give modes, or hold out recordings, segments, frf or lines")
    if test is None:
        return None
    before = len(draft.diagnostics)
    modes, sensors = _modes(draft, given, test), _sensors(draft, given)
    altered = tuple(_altered(draft, one, geometry) for one in given.altered)
    found = HoldOut(test, modes, sensors, altered)
    stays = found.fitted
    if not (np.isfinite(stays.frequency_hz).any() or np.isfinite(stays.shapes).any()):
        message = "test.hold_out takes all modes out of the test; nothing is left to fit"
        draft.error("MD432", message, given.where, help="leave at least one mode to the fit")
    some = len(modes) or len(sensors) or altered
    return found if some and len(draft.diagnostics) == before else None


def _modes(draft: Draft, given: HoldOutDraft, test: ModalTest) -> np.ndarray:
    """Columns of the test."""
    column, found = {int(number): i for i, number in enumerate(test.number)}, []
    for number, where in given.modes:
        if number not in column:
            message = f"test.hold_out names mode {number}, which the test did not measure"
            note = f"measured modes are {', '.join(map(str, column))}"
            draft.error("MD430", message, where, note, "give numbers as in test.modes.number")
        else:
            found.append(column[number])
    return np.unique(np.array(found, dtype=int))


def _sensors(draft: Draft, given: HoldOutDraft) -> np.ndarray:
    """Rows of the test, by the names that its `dofs` have."""
    row, found = {sensor.name: i for i, sensor in enumerate(draft.test.sensors)}, []
    for name, where in given.sensors:
        if name not in row:
            message = f"test.hold_out names sensor '{name[:40]}', which the test does not have"
            note = f"its sensors are {', '.join(list(row)[:12])}" if row else "the test has no shapes"
            draft.error("MD430", message, where, note, "write it as in test.modes.dofs")
        else:
            found.append(row[name])
    return np.unique(np.array(found, dtype=int))


def _altered(draft: Draft, given: AlteredDraft, geometry: Geometry | None) -> Altered:
    masses = _added(draft, given, given.masses, geometry, nodes=True)
    springs = _added(draft, given, given.springs, geometry, nodes=False)
    hz, sd = given.frequency_hz, given.frequency_sd_hz
    sound = np.isfinite(hz).all() and (hz > 0).all() and np.isfinite(sd).all() and (sd > 0).all()
    numbered = (given.number > 0).all() and (np.diff(given.number) > 0).all() and given.number.max() <= draft.order
    if not (sound and numbered):
        message = f"the frequencies of '{given.title}' need ascending mode numbers from 1 to {draft.order}, positive values and sd"
        draft.error("MD431", message, given.where, help="correct number, frequency and frequency_sd")
    return Altered(given.title, masses, springs, given.number, hz, sd)


def _added(
    draft: Draft, given: AlteredDraft, additions: dict[int | str, float], geometry: Geometry | None, nodes: bool
) -> dict[int, float]:
    """What is added at each degree of freedom, from 0."""
    found: dict[int, float] = {}
    for name, value in additions.items():
        places = _dofs(draft, name, geometry, nodes)
        if not places or not np.isfinite(value):
            what = "node or degree of freedom" if nodes and geometry is not None else "degree of freedom"
            message = f"'{given.title}' adds {value:g} at '{name}', which is no free {what} of the model"
            help = (
                "name node and direction as 12TY" if geometry is not None else f"give a number from 1 to {draft.order}"
            )
            draft.error("MD431", message, given.where, help=help)
        for dof in places:
            found[dof] = found.get(dof, 0.0) + value
    return found


def _dofs(draft: Draft, name: int | str, geometry: Geometry | None, nodes: bool) -> list[int]:
    """Degrees of freedom that a label or a number means: of a model with nodes, a number is a node and all its translations."""
    if isinstance(name, int):
        if geometry is None:
            return [name - 1] if 1 <= name <= draft.order else []
        owner = np.where(geometry.node >= 0, geometry.node_ids[geometry.node], -1)
        return np.flatnonzero((owner == name) & (geometry.direction < 3)).tolist() if nodes else []
    labels = draft.labels if geometry is None else geometry.labels()
    return [labels.index(name)] if name in labels else []
