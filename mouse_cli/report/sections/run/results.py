"""The revised properties, and the test beside the model before and after."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.correlation import mac, pair
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.hold_out import HoldOut
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.result import Result, Snapshot
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text, heads
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._functions import covered, functions
from mouse_cli.report.sections._wording import LEFT, counted


def properties(result: Result, options: Options) -> Iterator[Block]:
    """One line a property; of a short report those that moved most, by their standard deviations, where not all have room."""
    if not result.status.answered:
        yield Text("The run gave no answer; the properties stand unrevised.")
        return
    confidence = result.problem.run.confidence
    columns = heads(
        "<property | <unit",
        Column("before" if options.short else "prior"),
        Column("after" if options.short else "revised"),
        *(() if options.short else (Column("change"),)),
        "change [per cent]",
        Column("sd before", digits=3),
        Column("sd after", digits=3),
        Column(f"{confidence} % from" if options.short else "interval from"),
        Column("to" if options.short else "interval to"),
        "<limit",
    )
    order = np.arange(len(result.problem.parameters))
    if options.short and len(order) > options.rows:
        order = np.argsort(-np.abs(_moved(result)), kind="stable")
    rows = tuple(_row(result, int(i), options.short) for i in order)
    yield Table(columns, rows, rest="that moved less").without_empty_columns()
    if not options.short:
        yield Text(f"The interval holds the property with {confidence} per cent confidence.")
    if result.at_limit.any():
        yield Text("A property at its limit has no standard deviation: the limit, and not the test, decides it.")


def _moved(result: Result) -> np.ndarray:
    """Changes (p,) in prior standard deviations, 0 of properties that are held."""
    sd = result.problem.prior.sd
    change = result.revised.theta - result.prior.theta
    return np.divide(change, sd, out=np.zeros_like(sd), where=sd > 0)


def _row(result: Result, i: int, short: bool) -> tuple[Cell, ...]:
    """Line of property i."""
    parameter, before, after = result.problem.parameters[i], result.prior.theta[i], result.revised.theta[i]
    free = not result.at_limit[i]
    low, high = result.interval(i) if free else (None, None)
    return (
        parameter.name,
        parameter.unit,
        before,
        after,
        *(() if short else (after - before,)),
        100 * (after - before) / abs(before) if before else None,
        result.problem.prior.sd[i],
        result.sd_theta[i] if free else None,
        low,
        high,
        None if free else "at limit",
    )


def alternatives(result: Result, options: Options) -> Iterator[Block]:
    """A column for each mode of the posterior, the answer first."""
    found = result.alternatives
    if found is None:
        return
    count = 1 + len(found.others)
    yield Text(
        f"The posterior has {count} modes: {count} sets of values that fit these data, each with its own standard deviations. "
        "What holds a property with some confidence is the union of the intervals about them."
    )
    titles = ["answer", *(f"other {i}" for i in range(1, count))]
    columns = [Column("property", align=LEFT), Column("unit", align=LEFT)]
    columns += [Column(each, part) for each in titles for part in ("value", "sd")]
    values = [(result.revised.theta, result.sd_theta), *((each.theta, each.sd) for each in found.others)]
    rows: list[tuple[Cell, ...]] = [
        (parameter.name, parameter.unit, *(part[i] for pair in values for part in pair))
        for i, parameter in enumerate(result.problem.parameters)
    ]
    own = [found.share, *(each.share for each in found.others)]
    rows.append(("share of the posterior", "", *(cell for share in own for cell in (share, None))))
    yield Table(tuple(columns), rows)
    yield Text(_deciding(result))


def _deciding(result: Result) -> str:
    """The measurement at which the answer and the other that leads differ most."""
    telling = result.alternatives.deciding
    if telling is None:
        return "No shape of the measured modes separates them: measure further modes, or with a known mass added to one side."
    mode, dof, here, there = telling
    label = result.problem.structure.labels[dof]
    return (
        f"To decide, measure the shape of mode {mode} at degree of freedom {label}: the answer predicts {here:.3f} there, the "
        f"other {there:.3f}, of its largest component."
    )


_BEFORE_AFTER_COLUMNS = heads(
    "mode | test frequency [Hz] | prior frequency [Hz] | difference [per cent] | "
    "revised frequency [Hz] | difference [per cent]",
    Column("prior MAC", digits=4),
    Column("revised MAC", digits=4),
)
_SHORT = heads(
    "mode | measured [Hz] | before [Hz] | error [per cent] | after [Hz] | error [per cent]",
    Column("MAC before", digits=4),
    Column("MAC after", digits=4),
)


def before_after(result: Result, options: Options) -> Iterator[Block]:
    """Frequencies and MAC of both models beside the test, and the root mean square of the differences."""
    test = result.problem.test.frequency_hz
    if not len(test):
        return
    before, after = _hz(result.prior), _hz(result.revised)
    off_before, off_after = 100 * (before / test - 1), 100 * (after / test - 1)
    columns = (test, before, off_before, after, off_after, result.prior.mac, result.revised.mac)
    rows = tuple((number, *(column[i] for column in columns)) for i, number in enumerate(result.problem.test.number))
    yield Table(_SHORT if options.short else _BEFORE_AFTER_COLUMNS, rows).without_empty_columns()
    if np.isfinite(test).any() and options.short:
        rms = [f"{_root_mean_square(off):.3g} %" for off in (off_before, off_after)]
        yield Text(f"Errors are model minus test; rms {rms[0]} before, {rms[1]} after.")
    elif np.isfinite(test).any():
        yield Text(
            "Differences are model minus test; their root mean square is {} per cent before and {} per cent after.",
            (_root_mean_square(off_before), _root_mean_square(off_after)),
        )


def _hz(model: Snapshot) -> np.ndarray:
    """Natural frequencies (m,) of the modes that were paired with the measured ones."""
    return frequency_hz(model.eigenvalues[model.modes])


def _root_mean_square(values: np.ndarray) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


def frf_before_after(result: Result, options: Options) -> Iterator[Block]:
    """Frequency response functions against the model, before and after: one line a function. Those that were fitted."""
    yield from functions(result.frf)


_HELD_OUT_COLUMNS = heads("held-out mode | test frequency [Hz] | revised model [Hz] | difference [per cent] | MAC")


def held_out(result: Result, options: Options) -> Iterator[Block]:
    """What it is, and the modes beside those of the revised model; nothing where all data were used."""
    held = result.problem.hold_out
    if held is None:
        return
    yield Text(f"Held out, and used by no fit: {held_out_words(held)}. `mouse diagnose` reports the predictive error.")
    if held.test is not None and result.status.answered:
        rows = _predicted(result, held.test)
        if rows:
            yield Table(_HELD_OUT_COLUMNS, rows).without_empty_columns()


def held_out_words(held: HoldOut) -> str:
    """What is held out, in words."""
    parts = []
    if len(held.modes):
        numbers = ", ".join(str(number) for number in held.whole.number[held.modes])
        parts.append(f"{'mode' if len(held.modes) == 1 else 'modes'} {numbers}")
    if len(held.sensors):
        parts.append(f"{counted(len(held.sensors), 'sensor')} of {held.whole.s}")
    parts += [
        f"{counted(len(one.number), 'frequency', 'frequencies')} of the configuration '{one.title}'"
        for one in held.altered
    ]
    return "; ".join(parts)


def _predicted(result: Result, test: ModalTest) -> tuple[tuple[int | float, ...], ...]:
    """One line for each held-out mode that is among the modes computed, none of which is a fitted one."""
    model = result.revised
    free = np.setdiff1d(np.arange(len(model.eigenvalues)), model.modes)
    hz, seen = frequency_hz(np.maximum(model.eigenvalues, 0.0)), test.read(model.shapes)
    if result.problem.run.pairing == "mac" and test.s and len(free) >= test.m:
        modes = free[pair(test.shapes, test.frequency_hz, seen[:, free], hz[free])]
    else:
        modes = test.number - 1
    rows = []
    for i, j in enumerate(modes.tolist()):
        if j < len(hz):
            alike = float(mac(test.shapes[:, [i]], seen[:, [j]])[0, 0]) if test.s else float("nan")
            off = 100 * (hz[j] / test.frequency_hz[i] - 1)
            rows.append((test.number[i], test.frequency_hz[i], hz[j], off, alike))
    return tuple(rows)


def frf_held_out(result: Result, options: Options) -> Iterator[Block]:
    """The same tables as of those that were fitted, and how much lies within the intervals of the models."""
    yield from functions(result.held_frf)
    yield from covered(result.held_frf)


SECTIONS = (
    Section("properties", 100, "Revised properties", properties, place=RESULT),
    Section("alternatives", 105, "Other values that fit as well", alternatives, place=RESULT),
    Section("before-after", 115, "Test against model, before and after", before_after, place=RESULT),
    Section("frf-before-after", 116, "Frequency response functions, before and after", frf_before_after, place=RESULT),
    Section("held-out", 117, "Data held out", held_out, place=RESULT),
    Section("frf-held-out", 118, "Frequency response functions held out", frf_held_out, place=RESULT),
)
