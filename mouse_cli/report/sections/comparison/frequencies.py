"""Frequencies by every method beside the test: methods in columns, as in lecture 21-1."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.updated import Compared
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections.update.frequencies import cleared


def frequencies(found: Compared, options: Options) -> Iterator[Block]:
    """For each configuration a table: test, prior model, methods; the last line is the root mean square difference."""
    columns = (
        Column("mode"),
        Column("test", "Hz"),
        Column("prior", "Hz"),
        *(Column(update.about.key, "Hz") for update in found.updates),
    )
    for i, first in enumerate(found.updates[0].configurations):
        each = [update.configurations[i] for update in found.updates]
        yield Heading(
            f"{'Fitted modes' if first.fitted else first.title}, {'used' if first.fitted else 'not used'} by the methods",
            2,
        )
        rows = [
            (int(number), *(float(v[k]) for v in (first.test_hz, first.prior_hz, *(one.revised_hz for one in each))))
            for k, number in enumerate(first.number)
        ]
        before = float(100 * np.sqrt(np.mean((first.prior_hz / first.test_hz - 1) ** 2)))
        rows.append(
            ("off, %", None, *(float(f"{cleared(off):.3g}") for off in (before, *(one.rms_percent for one in each))))
        )
        yield Table(columns, tuple(rows), keys=3)
    yield Text(
        "Off: root mean square difference from the test. A blank is a mode that the model does not have. Modes are paired by shape "
        "where shapes were measured, else by number."
    )


SECTION = Section("comparison-frequencies", 30, "Frequencies", frequencies, (Compared,), place=RESULT)
