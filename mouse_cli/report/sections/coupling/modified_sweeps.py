"""Best locations for a mass, a spring or an absorber."""

from collections.abc import Iterator

from mouse_cli.model.coupling import ABSORBER, MASS
from mouse_cli.model.modified import Modified, Swept
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT

_SHOWN = 12  # places of a sweep


def sweeps(found: Modified, options: Options) -> Iterator[Block]:
    """One table a sweep, best places first."""
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
    columns = (Column("place", align=LEFT, literal=True), Column("mode then at", "Hz"), Column("shift", "Hz"))
    return Table(columns, tuple((p.name, p.hz, p.hz - each.before_hz) for p in each.places[:_SHOWN]))


def _absorbers(each: Swept) -> Table:
    columns = (
        Column("place", align=LEFT, literal=True), Column("mass by modal mass"), Column("tuned to", "Hz"), Column("damping ratio"),
        Column("peak by static"),
    )  # fmt: skip
    return Table(
        columns, tuple((p.name, p.mass_ratio, p.tuned_hz, p.damping_ratio, p.peak) for p in each.places[:_SHOWN])
    )


SECTION = Section("modified-sweeps", 40, "Best locations", sweeps, (Modified,), place=RESULT)
