"""Spectra as one JSON document, schema mouse.spectra/1."""

from dataclasses import asdict
from typing import Any

from mouse_cli.model.spectra import SpectraResult
from mouse_cli.report.json_values import fields

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
            }
            for each in result.measured
        ],
        "warnings": [f"{d.code}: {d.message}" for d in result.warnings],
    }
