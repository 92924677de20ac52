"""Signs of nonlinearity in recordings."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def linearity(found: RecordDiagnosis, options: Options) -> Iterator[Block]:
    """Coherence, distortion, levels; nothing where no sign could be read."""
    signs = found.linearity
    if np.isfinite(signs.incoherent):
        yield Text(
            f"Coherence of force and first output is below 0.95 over {100 * signs.incoherent:.2g} % of the excited band."
        )
    if np.isfinite(signs.even) or np.isfinite(signs.odd):
        yield Text(_distortion(signs))
    if signs.levels:
        columns = (
            Column("stretches", align=LEFT),
            Column("rms of the first output"),
            Column("first resonance", "Hz"),
            Column("damping ratio", "per cent"),
        )
        rows = zip(("quietest third", "loudest third"), signs.levels, strict=True)
        yield Table(
            columns,
            tuple((name, f"{s.rms:.3g}", f"{s.frequency_hz:.5g}", f"{100 * s.damping:.3g}") for name, s in rows),
        )
        yield Text(
            "The linear model fitted to either alone. A linear structure has the same frequency and damping at all levels."
        )


def _distortion(signs) -> str:
    parts = [
        f"{name} {100 * value:.2g} %"
        for name, value in (("even lines", signs.even), ("odd lines", signs.odd), ("noise", signs.noise))
        if np.isfinite(value)
    ]
    return f"Response at lines that the force leaves out, by that at the others: {', '.join(parts)}."


SECTION = Section("record-linearity", 30, "Is it linear?", linearity, (RecordDiagnosis,))
