"""Spectra as one JSON document, schema mouse.spectra/1."""

from dataclasses import asdict
from typing import Any

import numpy as np

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.spectra import SpectraResult
from mouse_cli.report.frf_document import MOST_CURVES, thinned
from mouse_cli.report.json_values import coded, fields

SCHEMA = "mouse.spectra/1"


def document(result: SpectraResult) -> dict[str, Any]:
    """`result` in plain Python values; functions themselves go to the file of -o."""
    how = result.options
    return {
        "schema": SCHEMA,
        "title": result.title,
        "source": result.source,
        "options": {**asdict(how), "overlap": how.shared},
        "measurements": [
            {
                "recordings": list(each.recordings),
                **fields(each, "sample_rate_hz", "block_samples", "blocks", "averages", "force_window"),
                "decay_rate": each.frf.decay_rate,
                "kind": each.frf.kind,
                "functions": [asdict(one) for one in each.quality],
                "curves": _curves(each.frf),
            }
            for each in result.measured
        ],
        "warnings": coded(result.warnings),
    }


def _curves(frf: FrfTest) -> list[dict[str, Any]]:
    """[frequency in Hz, 20 log10 |H|] and [frequency in Hz, coherence] of the first functions, those of one force after another."""
    pairs = [(o, i) for i in range(len(frf.input_names)) for o in range(len(frf.output_names))]
    hz, found = frf.frequency_hz, []
    for o, i in pairs[:MOST_CURVES]:
        with np.errstate(divide="ignore", invalid="ignore"):
            level = 20 * np.log10(np.abs(frf.H[:, o, i]))
        coherence = np.full(len(hz), np.nan) if frf.coherence is None else frf.coherence[:, o]
        drawn = {"measured": thinned(hz, level), "coherence": thinned(hz, coherence, digits=4)}
        found.append({"response": frf.output_names[o], "force": frf.input_names[i], **drawn})
    return found
