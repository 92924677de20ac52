"""The stabilisation diagram in letters."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Lines, Text
from mouse_cli.report.section import Options, Section

_WIDTH, _ROWS = 100, 20


def diagram(found: Identification, options: Options) -> Iterator[Block]:
    """Orders upwards, frequency to the right: o a stable pole, . another one, ^ an identified mode."""
    seen, (low, high) = found.diagram, found.band_hz
    if not len(seen.order) or not high > low:
        return
    column = lambda hz: np.clip(((hz - low) / (high - low) * (_WIDTH - 1)).round().astype(int), 0, _WIDTH - 1)
    inside = (seen.frequency_hz >= low) & (seen.frequency_hz <= high)
    orders = np.unique(seen.order)
    shown = orders[:: max(1, int(np.ceil(len(orders) / _ROWS)))][::-1]
    lines = []
    for order in shown:
        row = np.full(_WIDTH, " ")
        for stable, letter in ((False, "."), (True, "o")):
            row[column(seen.frequency_hz[inside & (seen.order == order) & (seen.stable == stable)])] = letter
        lines.append(f"{order:5d} |{''.join(row)}")
    marks = np.full(_WIDTH, " ")
    marks[column(found.modes.frequency_hz)] = "^"
    lines += [
        f"      +{'-' * _WIDTH}",
        f"       {''.join(marks)}",
        f"       {f'{low:.6g}':<{_WIDTH // 2}}{f'{high:.6g} Hz':>{_WIDTH // 2}}",
    ]
    yield Lines(tuple(lines))
    yield Text(
        "Orders upwards, frequencies to the right: o is a pole that is stable, . one that is not, ^ an identified mode."
    )


SECTION = Section("identification-diagram", 40, "Stabilisation diagram", diagram, (Identification,))
