"""How well each sensor fits over all pairs of modes."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import Correlation
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def sensors(found: Correlation, options: Options) -> Iterator[Block]:
    """COMAC and ECOMAC, one line a sensor."""
    if not np.isfinite(found.comac).any():
        return
    columns = (Column("sensor", align=LEFT, literal=True), Column("COMAC"), Column("ECOMAC"))
    rows = zip(found.sensors, np.round(found.comac, 4), np.round(found.ecomac, 4), strict=True)
    yield Table(columns, tuple((name, float(one), float(other)) for name, one, other in rows))
    yield Text(
        "COMAC is 1, ECOMAC 0 where a sensor agrees with the model in all paired modes. COMAC is blind to signs, ECOMAC sees "
        "them. An error of the model is spread over many sensors; the fault of one stands alone and is named under the remarks."
    )


SECTION = Section("correlation-sensors", 40, "Sensors", sensors, (Correlation,))
