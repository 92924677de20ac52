"""What the report says of a modified structure."""

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mouse_cli import __version__
from mouse_cli._texts import capital
from mouse_cli.formats.frf_values import response_unit
from mouse_cli.model.coupling import ABSORBER, MASS, Target
from mouse_cli.model.modified import Modified, Need, Swept
from mouse_cli.report.blocks import Block, Column, Heading, Matrix, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted
from mouse_cli.report.sections.coupling.coupled import SHARP, connections, peak_table
from mouse_cli.report.sections.run.forecast import damping, shapes


def verdict(found: Modified, options: Options) -> Iterator[Block]:
    """Changes in brief: whether the targets can be met, which mode moves most, and best locations."""
    for target, needs in groupby(found.needs, key=lambda need: need.target):
        met = [need.place for need in needs if np.isfinite(need.value)]
        where = (
            f"can be met: {len(met)} places for it" if len(met) > 1 else f"can be met at {met[0]} alone" if met else ""
        )
        yield Text(
            f"Mode {target.mode} {target.side} {target.hz:g} Hz by a {target.means} {where or 'cannot be met at any place'}."
        )
    shift = found.shifts.shift_hz
    if found.connections and np.isfinite(shift).any():
        i = int(np.nanargmax(np.abs(shift)))
        yield Text(
            f"The changes move mode {i + 1} most, by {{}} Hz (sd {{}}) to {{}} Hz.",
            (shift[i], found.shifts.sd_hz[i], found.after.frequencies_hz[i]),
        )
    for each in found.swept:
        if each.places:
            yield Text(f"A {each.sweep.means} does most for mode {each.sweep.mode} at {each.places[0].name}.")
    if not (found.connections or found.needs or found.swept):
        yield Text("Nothing is changed.")


_CORRELATED = 10  # modes whose correlations are shown


def frequencies(found: Modified, options: Options) -> Iterator[Block]:
    """One line a mode after the changes, beside the one that it came from."""
    before, after, shifts = found.before, found.after, found.shifts
    columns = heads(
        "mode | frequency [Hz] | standard deviation [Hz] | was mode | at [Hz] | with sd [Hz]",
        Column("shift", "Hz", digits=4),
        Column("sd of the shift", "Hz", digits=3),
        Column("MAC", digits=4),
    )
    rows = []
    for i, hz in enumerate(after.frequencies_hz):
        j = int(shifts.partner[i])
        own = (i + 1, hz if i >= after.rigid_modes else 0.0, after.sd_hz[i])
        if j < 0:
            rows.append((*own, None, None, None, None, None, None))
            continue
        was = float(before.frequencies_hz[j]) if j >= before.rigid_modes else 0.0
        rows.append((*own, j + 1, was, before.sd_hz[j], shifts.shift_hz[i], shifts.sd_hz[i], shifts.mac[i]))
    yield Table(columns, rows)
    if (shifts.partner < 0).any():
        yield Text(
            "A mode without a number before is new, such as that of an absorber, or unlike all that were looked at."
        )
    if found.modification.problem.parameters and not options.short:
        yield from _correlations(found)


def _correlations(found: Modified) -> Iterator[Block]:
    """Of the frequencies after the changes."""
    root = found.after.root_hz[found.after.rigid_modes :][:_CORRELATED]
    size = np.linalg.norm(root, axis=1)
    if len(root) < 2 or not (size > 0).all():
        return
    unit = root / size[:, None]
    labels = tuple(str(i) for i in range(found.after.rigid_modes + 1, found.after.rigid_modes + 1 + len(root)))
    yield Matrix(
        "Correlations of the frequencies after the changes", unit @ unit.T, labels, labels, corner=("mode", "mode")
    )


def targets(found: Modified, options: Options) -> Iterator[Block]:
    """One table a target; modes are those after the changes."""
    units, confidence = found.modification.problem.units, found.modification.problem.run.confidence
    for target, needs in groupby(found.needs, key=lambda need: need.target):
        yield Heading(f"mode {target.mode} {target.side} {target.hz:g} Hz by a {target.means}", 2)
        yield from _answer(target, list(needs), units.of("kg" if target.means == MASS else "N/m"), confidence)


def _answer(target: Target, needs: list[Need], unit: str, confidence: int) -> Iterator[Block]:
    if len(needs) == 1 and not needs[0].place:
        yield Text(f"{capital(needs[0].reason)}.")
        return
    columns = heads(
        Column("place", align=LEFT, literal=True),
        f"{target.means} needed [{unit}] | standard deviation [{unit}] | "
        f"for a chance of {confidence} per cent [{unit}] | mode then at [Hz] | limit of the mode there [Hz] | "
        "MAC",
    )
    rows = tuple(
        (n.place, n.value, *((n.sd, n.sure) if n.sd > 0 else (None, None)), n.reached_hz, n.limit_hz, n.likeness)
        for n in needs
    )
    yield Table(columns, rows).without_empty_columns()
    for need in needs:
        if need.reason:
            yield Text(f"MD718: at {need.place} it is impossible: {need.reason}.")
    if any(np.isfinite(need.value) and need.value < 0 for need in needs):
        yield Text("Negative values are to be taken away.")


_SHOWN = 12  # places of a sweep


def sweeps(found: Modified, options: Options) -> Iterator[Block]:
    """Best locations for a mass, a spring or an absorber. One table a sweep, best places first."""
    units = found.modification.problem.units
    for each in found.swept:
        sweep = each.sweep
        unit = units.of("N/m" if sweep.means not in (MASS, ABSORBER) else "kg")
        article = "an" if sweep.means == ABSORBER else "a"
        yield Heading(f"{article} {sweep.means} of {sweep.size:g} {unit}, for mode {sweep.mode}", 2)
        if not options.short:
            yield Text(f"Mode {sweep.mode} lies at {{}} Hz without it.", (each.before_hz,))
        yield _absorbers(each) if sweep.means == ABSORBER else _moved(each)
        if sweep.means == ABSORBER:
            yield Text(
                "Tuning and damping by Den Hartog's rule; the peak is that of the mode with the absorber, by its static response, "
                "with other modes left out."
            )


def _moved(each: Swept) -> Table:
    columns = heads(Column("place", align=LEFT, literal=True), "mode then at [Hz] | shift [Hz]")
    return Table(columns, tuple((p.name, p.hz, p.hz - each.before_hz) for p in each.places[:_SHOWN]))


def _absorbers(each: Swept) -> Table:
    columns = heads(
        Column("place", align=LEFT, literal=True), "mass by modal mass | tuned to [Hz] | damping ratio | peak by static"
    )
    return Table(
        columns, tuple((p.name, p.mass_ratio, p.tuned_hz, p.damping_ratio, p.peak) for p in each.places[:_SHOWN])
    )


def heading(found: Modified, options: Options) -> Iterator[Block]:
    """Heading of a modified structure: program, title, source, and the changes. What is changed."""
    asked, problem = found.modification, found.modification.problem
    rows = [("program", f"mouse {__version__}"), ("title", asked.title.strip()), ("source", asked.path)]
    if asked.path != problem.source.path:
        rows.append(("model", problem.source.path))
    yield Table(heads("< | <"), rows)
    properties = counted(len(problem.parameters), "uncertain property", "uncertain properties")
    yield Text(
        f"The model has {counted(problem.structure.n, 'degree', 'degrees')} of freedom and {properties}, whose uncertainty "
        f"all standard "
        "deviations below follow from, to first order."
    )
    if found.connections:
        places = asked.part.places
        names = [(places[one.at.place], places[one.to.place] if one.to else "") for one in found.connections]
        yield connections(found.connections, names)


def functions(found: Modified, options: Options) -> Iterator[Block]:
    """Peaks of functions before and after changes. One table before, one after."""
    if found.functions is None:
        return
    units = found.modification.problem.units
    unit = response_unit(found.functions.after.kind, units) if units.declared else ""
    for word, peaks in (("before", found.functions.peaks_before), ("after", found.functions.peaks)):
        yield Heading(word, 2)
        yield peak_table(peaks, unit)
    if any(p.sd > p.magnitude for p in (*found.functions.peaks_before, *found.functions.peaks)):
        yield Text(SHARP)


def modified_damping(found: Modified, options: Options) -> Iterator[Block]:
    """Damping of the modified model. One line a complex mode after the changes."""
    yield from damping(found.after, options)


def modified_shapes(found: Modified, options: Options) -> Iterator[Block]:
    """Mode shapes of the modified model. Shapes after the changes and their standard deviations."""
    yield from shapes(found.after, options)


SECTIONS = (
    Section("modified-verdict", 10, "Modified structure", verdict, (Modified,), place=VERDICT),
    Section("modified-frequencies", 20, "Natural frequencies", frequencies, (Modified,), place=RESULT),
    Section("modified-targets", 30, "What it takes", targets, (Modified,), place=RESULT),
    Section("modified-sweeps", 40, "Best locations", sweeps, (Modified,), place=RESULT),
    Section("modified-heading", 10, "Changes", heading, (Modified,)),
    Section("modified-functions", 50, "Peaks of functions", functions, (Modified,)),
    Section("modified-damping", 60, "Damping after the changes", modified_damping, (Modified,)),
    Section("modified-shapes", 70, "Mode shapes after the changes", modified_shapes, (Modified,)),
)
