"""The cycles: how the properties and the misfit moved."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Cycle, Result
from mouse_cli.report.blocks import Block, Cell, Column, Table, Text
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import LEFT


def cycles(result: Result, options: Options) -> Iterator[Block]:
    """One line a cycle; cost and damping where the recursion has them."""
    parameters = result.problem.parameters
    short = len(parameters) > options.cycle_properties
    shown = parameters[: options.cycle_properties]
    columns = (
        Column("cycle"),
        *(Column(p.name, p.unit, literal=True) for p in shown),
        *((Column("largest change", "prior sd"), Column("of property", align=LEFT)) if short else ()),
        Column("chi-square of data"),
        Column("exceedances"),
        Column("allowed"),
        Column("cost"),
        Column("damping"),
    )
    searched = result.problem.run.recursion == "anchored"
    rows = []
    for before, cycle in zip((None, *result.cycles), result.cycles, strict=False):
        rows.append(
            (
                cycle.index,
                *(float(v) for v in cycle.theta[: len(shown)]),
                *(_largest_change(result, before, cycle) if short else ()),
                cycle.chi2,
                cycle.exceedances,
                cycle.allowed,
                cycle.cost if searched else None,
                cycle.damping if searched else None,
            )
        )
    yield Table(columns, tuple(rows)).without_empty_columns()
    yield Text(_explained(len(result.y), searched, short, len(shown)))


def _explained(data: int, searched: bool, short: bool, shown: int) -> str:
    """What the columns are."""
    text = f"Cycle 0 is the prior model. Chi-square is the sum over {data} data of ((test - model) / standard deviation) squared."
    if searched:
        text += (
            " The cost, which each cycle lowers, adds the squared distance of the properties from their prior values."
        )
    if short:
        text += f" Of the properties the first {shown} are shown."
    return text


def _largest_change(result: Result, before: Cycle | None, cycle: Cycle) -> tuple[Cell, Cell]:
    """The largest change of a property since the cycle before, in prior standard deviations, and whose it is."""
    if before is None:
        return None, None
    sd = result.problem.prior.sd
    moved = np.divide(cycle.theta - before.theta, sd, out=np.zeros_like(sd), where=sd > 0)
    largest = int(np.argmax(np.abs(moved)))
    return float(moved[largest]), result.problem.parameters[largest].name


SECTION = Section("cycles", 50, "Cycles", cycles, place=APPENDIX)
