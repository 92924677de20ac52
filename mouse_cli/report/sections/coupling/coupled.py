"""What the report says of coupled structures."""

from collections.abc import Iterator

import numpy as np

from mouse_cli import __version__
from mouse_cli.formats.frf_values import response_unit
from mouse_cli.model.coupled import Coupled, CoupledModes, InterfaceState, Peak
from mouse_cli.model.coupling import Connection, Coupling
from mouse_cli.model.modified import Modified
from mouse_cli.report.blocks import Block, Column, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, worded


def verdict(found: Coupled, options: Options) -> Iterator[Block]:
    """Coupled structures in brief: what was found, and whether the interface can be trusted."""
    if any(each.code == "MD713" for each in found.warnings):
        yield Text("Do not trust the coupled functions: noise decides the interface at more than a few lines.")
    else:
        yield Text(_trusted(found.interface))
    whole = found.modes
    if whole is not None and len(whole.frequencies_hz) > whole.rigid:
        elastic = whole.frequencies_hz[whole.rigid :]
        yield Text(f"{counted(len(elastic), 'elastic mode')} from {{}} to {{}} Hz.", (elastic[0], elastic[-1]))


def _trusted(interface: InterfaceState | None) -> str:
    """What is known of the interface where nothing forbids to trust it."""
    if interface is None or not interface.conditions:
        return "The parts are coupled as models."
    if np.isnan(interface.noise).all():
        return "The interface is not judged: the accuracy of the measured FRFs is unknown."
    return "The interface can be trusted: noise decides it at few lines or none."


SHARP = (
    "A standard deviation above the magnitude means that the frequency of the peak is uncertain by more than its width; "
    "the first order is not valid there."
)


def functions(found: Coupled, options: Options) -> Iterator[Block]:
    """One line a peak, with its standard deviation where the parts' accuracy is known."""
    frf = found.functions
    if frf is None:
        return
    yield Text(
        f"{frf.kind.capitalize()} at {len(frf.frequency_hz)} lines from {{}} to {{}} Hz; `--json` and `--functions` give them all.",
        (frf.frequency_hz[0], frf.frequency_hz[-1]),
    )
    units = found.coupling.units
    yield peak_table(found.peaks, response_unit(frf.kind, units) if units.declared else "")
    if any(peak.sd > 0 for peak in found.peaks) and not options.short:
        yield Text(
            "Standard deviations are those that measured functions and the properties of models carry to the whole, to first "
            "order; parts "
            "err independently."
        )
    if any(peak.sd > peak.magnitude for peak in found.peaks):
        yield Text(SHARP)


def peak_table(peaks: tuple[Peak, ...], unit: str) -> Table:
    """Response, force, frequency, height with its sd, phase."""
    columns = heads(
        Column("response", align=LEFT, literal=True),
        Column("force", align=LEFT, literal=True),
        f"peak at [Hz] | magnitude [{unit}] | standard deviation [{unit}] | phase [degrees]",
    )
    rows = tuple((p.response, p.force, p.hz, p.magnitude, p.sd if p.sd > 0 else None, p.phase) for p in peaks)
    return Table(columns, rows, 2).without_empty_columns()


def modes(found: Coupled, options: Options) -> Iterator[Block]:
    """Frequencies of the whole as assembled; then errors of reductions, one line a method and number of modes kept."""
    whole = found.modes
    if whole is None:
        return
    size = counted(whole.size, "degree of freedom", "degrees of freedom")
    rigid = counted(whole.rigid, "rigid-body mode") if whole.rigid else "no rigid-body mode"
    yield Text(f"The whole, assembled, has {size} and {rigid}.")
    yield Table(heads("mode | frequency [Hz]"), tuple((i, hz) for i, hz in enumerate(whole.frequencies_hz, 1)))
    if whole.reduced:
        yield Text(
            "What truncation makes of them: error of each frequency, in per cent, with the stated number of modes kept of "
            "every part."
        )
        yield _errors(whole, options.short)


def _errors(whole: CoupledModes, short: bool) -> Table:
    """One line a reduction; short: with the worst mode alone."""
    elastic = [i for i in range(len(whole.frequencies_hz)) if i >= whole.rigid]
    columns = heads(Column("reduction", align=LEFT, literal=True), "kept | coordinates | worst [per cent]")
    columns += tuple(Column(f"mode {i + 1}", "per cent") for i in elastic)
    rows = []
    for each in whole.reduced:
        error = [float(100 * each.error[i]) for i in elastic]
        worst = float(np.abs(error).max()) if elastic else np.nan
        rows.append((each.method, each.keep, each.coordinates, worst, *error))
    shown = 4 if short else len(columns)
    return Table(columns[:shown], tuple(row[:shown] for row in rows), 3)


def remarks(found: Coupled | Modified, options: Options) -> Iterator[Block]:
    """What is to be kept in mind about coupled or modified structures. One paragraph a warning."""
    yield from worded(found.warnings, options)


def heading(found: Coupled, options: Options) -> Iterator[Block]:
    """Heading of coupled structures: program, title, source; parts, interfaces and connections."""
    coupling = found.coupling
    rows = ("program", f"mouse {__version__}"), ("title", coupling.title.strip()), ("source", coupling.path)
    yield Table(heads("< | <"), rows)
    yield _parts(coupling)
    yield Text(
        f"{_joined(len(coupling.interfaces))}Receptances Y of the parts become those of the whole by Y - Y B' (B Y B' + "
        f"1/z)^-1 B Y, with "
        "B the conditions of compatibility and z the dynamic stiffnesses of connections."
    )
    if coupling.connections:
        names = [(coupling.name(one.at), coupling.name(one.to) if one.to else "") for one in coupling.connections]
        yield connections(coupling.connections, names)
    if coupling.truncate:
        yield Text("Singular values of the interface below {} of the largest are left out.", (coupling.truncate,))


def _joined(pairs: int) -> str:
    if not pairs:
        return ""
    what = "One pair of degrees of freedom moves" if pairs == 1 else f"{pairs} pairs of degrees of freedom move"
    return f"{what} together. "


def _parts(coupling: Coupling) -> Table:
    columns = heads(
        Column("part", align=LEFT, literal=True),
        "<known by",
        Column("source", align=LEFT, literal=True),
        "degrees of freedom | degrees of freedom used | <",
    )
    rows = tuple(
        (
            part.name,
            f"measured {part.frf.kind}" if part.measured else "its model",
            part.problem.source.path if part.problem else part.frf.path,
            None if part.measured else part.problem.structure.n,
            len(part.places),
            "taken away" if part.removed else "",
        )
        for part in coupling.substructures
    )
    return Table(columns, rows).without_empty_columns()


def connections(each: tuple[Connection, ...], names: list[tuple[str, str]]) -> Table:
    """One line a connection; names: of its two ends."""
    columns = heads(
        Column("connection", align=LEFT, literal=True),
        Column("at", align=LEFT, literal=True),
        Column("to", align=LEFT, literal=True),
        "mass | stiffness | loss factor | damping | <",
    )
    sizes = [(one.mass, one.stiffness, one.loss_factor, one.damping) for one in each]
    rows = tuple(
        (one.name, *ends, *(size or None for size in own), "hung" if one.hung else "")
        for one, ends, own in zip(each, names, sizes, strict=True)
    )
    return Table(columns, rows, 2).without_empty_columns()


_SHOWN = 12  # lines in the table


def interface(found: Coupled, options: Options) -> Iterator[Block]:
    """Overall, then at some lines, the worst among them."""
    state = found.interface
    if state is None or not state.conditions:
        return
    hz, worst = found.functions.frequency_hz, np.argmax(state.condition)
    yield Text(
        f"{counted(state.conditions, 'condition')} at {counted(len(hz), 'line')}. The condition number of their flexibility, "
        f"scaled so "
        "that units do not count, has the median {} and is largest at {} Hz: {}.",
        (np.median(state.condition), hz[worst], state.condition[worst]),
    )
    yield _lines(found, state, worst)
    if (state.noise > 0).any():
        lost = np.count_nonzero(state.condition * state.noise > 1)
        yield Text(
            "Condition number times noise bounds the relative error of the forces at the interface: "
            f"it is above 1 at {counted(lost, 'line')} of {len(hz)}."
        )
    elif np.isnan(state.noise).any():
        yield Text(
            "The accuracy of measured functions is not known: give `sd`, or functions with their coherence and averages."
        )
    if state.error > 0:
        yield Text(
            "Functions of large models are computed in bases; those checked are off by at most {}, relative.",
            (state.error,),
        )


def _lines(found: Coupled, state: InterfaceState, worst: int) -> Table:
    hz = found.functions.frequency_hz
    shown = np.unique(np.append(np.linspace(0, len(hz) - 1, min(_SHOWN, len(hz))).astype(int), worst))
    columns = heads(
        "frequency [Hz] | condition number | noise [per cent] | condition number times noise | singular values kept"
    )
    truncated = (state.kept < state.conditions).any()
    rows = []
    for k in shown:
        noise = float(state.noise[k]) if state.noise[k] > 0 else np.nan
        kept = int(state.kept[k]) if truncated else None
        rows.append((hz[k], state.condition[k], 100 * noise, float(state.condition[k]) * noise, kept))
    return Table(columns, rows).without_empty_columns()


SECTIONS = (
    Section("coupling-verdict", 10, "Coupled structures", verdict, (Coupled,), place=VERDICT),
    Section("coupling-functions", 30, "Frequency response functions of the whole", functions, (Coupled,), place=RESULT),
    Section("coupling-modes", 40, "Natural frequencies of the whole", modes, (Coupled,), place=RESULT),
    Section("coupling-remarks", 90, "Remarks", remarks, (Coupled, Modified), place=RESULT),
    Section("coupling-heading", 10, "Parts and connections", heading, (Coupled,)),
    Section("coupling-interface", 20, "The interface", interface, (Coupled,)),
)
