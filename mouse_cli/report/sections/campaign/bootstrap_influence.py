"""What each mode and each sensor of a test does to the answer."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.campaign import Bootstrap
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted


def influence(found: Bootstrap, options: Options) -> Iterator[Block]:
    """One line a mode or sensor that is left out, the strongest first."""
    shown = found.parameters[: options.properties]
    table = np.array([each.influence for each in shown]).reshape(len(shown), len(found.units))
    if not table.size:
        return
    strength = np.nan_to_num(np.abs(table)).max(axis=0)
    order = np.argsort(-strength, kind="stable")
    columns = (Column("without", align=LEFT), *(Column(each.name, "sd", literal=True, digits=4) for each in shown))
    rows = tuple((found.units[i], *(round(float(v), 3) for v in table[:, i])) for i in order[: options.elements])
    yield Table(columns, rows)
    more = len(found.units) - len(rows)
    rest = f" {counted(more, 'further one', 'further ones')}: see --csv." if more else ""
    yield Text(f"By how many posterior standard deviations each property moves when that is left out.{rest}")


SECTION = Section("bootstrap-influence", 20, "Influence of what was measured", influence, (Bootstrap,), place=RESULT)
