"""Channels of a file: found by name or number, told from one another, and brought to the units of the deck."""

import re
from collections.abc import Sequence
from difflib import get_close_matches

import numpy as np

from mouse_cli.formats.record_drafts import Findings, Pick
from mouse_cli.formats.recording_files import Column, Contents
from mouse_cli.model.channel_units import ratio, target, unit
from mouse_cli.model.recording import INPUT, Channel
from mouse_cli.model.units import Units

_SENSITIVITY = re.compile(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(\S.*)")
_SAME = 0.01  # relative difference of two units that are one


def bearing(names: Sequence[str], name: str) -> list[int]:
    """Which of `names` are `name`: as it is spelled; else whatever its case; else after the group or struct before the last dot.

    >>> bearing(["meas.H4", "meas.a1", "A1"], "h4"), bearing(["meas.H4", "meas.a1", "A1"], "a1")
    ([0], [2])
    """
    own = lambda a: a.rpartition(".")[2].lower() == name.lower()
    for same in (lambda a: a == name, lambda a: a.lower() == name.lower(), own):
        found = [i for i, each in enumerate(names) if same(each)]
        if found:
            return found
    return []


def called(contents: Contents, name: str) -> list[int]:
    """Which columns of a file bear a name (`bearing`); else, and before a name after a dot, the one of that number, from 1."""
    names = [each.name for each in contents.columns]
    found = bearing(names, name)
    if name.isdecimal() and 1 <= int(name) <= len(names) and not any(names[i] == name for i in found):
        return [int(name) - 1]
    return found


def column(contents: Contents, name: str, say: Findings, where) -> Column | None:
    """The one channel that is called so; None after an error."""
    found = called(contents, name)
    if len(found) == 1:
        return contents.columns[found[0]]
    if found:
        message = f"{len(found)} channels of the file are called '{name[:40]}'"
        return say.error("MD600", where, message, "name it by its number, from 1")
    return say.error(
        "MD600",
        where,
        f"the file has no channel '{name[:40]}'",
        "name one of them, or give its number, from 1",
        listed(contents, name),
    )


def listed(contents: Contents, name: str = "") -> str:
    """What channels a file has, in words: those whose names are near to `name`, or its first."""
    names = [each.name for each in contents.columns]
    near = get_close_matches(name, names, 3)
    some = ", ".join(near or names[:12]) + (", ..." if not near and len(names) > 12 else "")
    return f"its {len(names)} channels include {some}" if names else "it holds no channels of samples"


def channel(pick: Pick, found: Column, units: Units, say: Findings) -> tuple[Channel, float] | None:
    """The channel in the units of the deck, and the factor that brings its samples to them; None after an error."""
    spelled = _unit(pick, found, say)
    if spelled is None:
        return None
    if pick.sensitivity:
        return _calibrated(pick, found, spelled, units, say)
    known = unit(spelled)
    if known is None or known.quantity == "voltage":
        return _uncalibrated(pick, found, spelled, units, say)
    quantity = pick.quantity or known.quantity
    if quantity != known.quantity:
        message = (
            f"channel '{found.name}' is declared as {quantity}, but its unit, {spelled}, is one of {known.quantity}"
        )
        return say.error("MD610", pick.where, message, "correct quantity or unit")
    name, factor = target(quantity, units)
    return _named(pick, found, quantity, name), known.factor / factor


def _unit(pick: Pick, found: Column, say: Findings) -> str | None:
    """The unit that deck and file agree on; None after they do not."""
    said, stated = unit(pick.unit), unit(found.unit)
    if not pick.unit or said is None or stated is None:
        return pick.unit or found.unit
    if said.quantity == stated.quantity and abs(said.factor / stated.factor - 1) < _SAME:
        return pick.unit
    message = f"the deck states that channel '{found.name}' is in {pick.unit}; its file states {found.unit}"
    note = (
        f"1 {found.unit} is {stated.factor / said.factor:.6g} {pick.unit}" if said.quantity == stated.quantity else ""
    )
    return say.error("MD610", pick.where, message, "delete unit, if the file is right; else correct the file", note)


def _calibrated(pick: Pick, found: Column, spelled: str, units: Units, say: Findings) -> tuple[Channel, float] | None:
    """A channel in volts of a transducer whose sensitivity is known."""
    match = _SENSITIVITY.fullmatch(pick.sensitivity)
    parts, volts = ratio(match[2]) if match else None, unit(spelled or "V")
    if parts is None or parts[0].quantity != "voltage" or not float(match[1]) > 0:
        message = (
            f"sensitivity of channel '{found.name}' is '{pick.sensitivity[:40]}'; expected volts per unit measured"
        )
        return say.error("MD611", pick.where, message, "write it as 100 mV/g or 2.2 mV/N")
    if volts is None or volts.quantity != "voltage":
        message = f"channel '{found.name}' has a sensitivity in volts, but its unit is {spelled}"
        return say.error("MD610", pick.where, message, "delete sensitivity, or give unit: V")
    measured = parts[1]
    if pick.quantity and pick.quantity != measured.quantity:
        message = (
            f"channel '{found.name}' is declared as {pick.quantity}; its sensitivity is that of {measured.quantity}"
        )
        return say.error("MD610", pick.where, message, "correct quantity or sensitivity")
    name, factor = target(measured.quantity, units)
    volts_per_unit = float(match[1]) * parts[0].factor / measured.factor
    return _named(pick, found, measured.quantity, name), volts.factor / volts_per_unit / factor


def _uncalibrated(pick: Pick, found: Column, spelled: str, units: Units, say: Findings) -> tuple[Channel, float] | None:
    """A channel whose unit is none that can be converted: kept as it is."""
    forced = pick.role == INPUT and pick.sensor.ground is None
    quantity = pick.quantity or ("force" if forced else "acceleration")
    if not spelled:
        return _named(pick, found, quantity, target(quantity, units)[0]), 1.0
    if not pick.quantity:
        message = f"channel '{found.name}' is in {spelled}, which does not determine what it measures"
        return say.error(
            "MD611", pick.where, message, "give sensitivity, as 100 mV/g; or quantity, and its numbers stay as they are"
        )
    return _named(pick, found, quantity, spelled), 1.0


def _named(pick: Pick, found: Column, quantity: str, spelled: str) -> Channel:
    ground = pick.sensor.ground is not None
    return Channel(
        found.name, pick.role, quantity, spelled, pick.sensor.name, ground=ground, frame=pick.frame,
        gain_sd=pick.gain_sd, delay_sd=pick.delay_sd, noise_sd=pick.noise_sd,
    )  # fmt: skip


def unstated(picks: list[Pick], columns: list[Column], say: Findings, where) -> None:
    """Say of which channels neither deck nor file states the unit, so that one was taken for granted."""
    silent = [f.name for p, f in zip(picks, columns, strict=True) if not (p.unit or f.unit or p.sensitivity)]
    if silent:
        listed = ", ".join(silent[:6]) + (", ..." if len(silent) > 6 else "")
        message = f"no unit is given for {'channel' if len(silent) == 1 else 'channels'} {listed}; units of the deck are taken"
        say.warn("MD612", where, message, "give unit: N, m/s2, g, ...")


def scaled(each: Column, factor: float, first: int, last: int) -> np.ndarray:
    """Samples first to last, the last one not included, times the factor (t,)."""
    return np.multiply(each.values[first:last].real, factor, dtype=float)
