"""A diagnosis by recordings as one JSON document, schema mouse.diagnosis/1 with what recordings add."""

from typing import Any

from mouse_cli import __version__
from mouse_cli.model.record_diagnosis import RecordDiagnosis, RecordScore
from mouse_cli.model.units import system
from mouse_cli.report import diagnosis_document as of_diagnosis
from mouse_cli.report import result_document as of_result
from mouse_cli.report.geometry_document import geometry
from mouse_cli.report.json_values import plain


def document(found: RecordDiagnosis) -> dict[str, Any]:
    """`found` in plain Python values; keys of the modal diagnosis that recordings do not fill are None or empty."""
    problem = found.problem
    return plain(
        {
            "schema": of_diagnosis.SCHEMA,
            "version": __version__,
            "title": problem.title.strip(),
            "source": problem.source.path,
            "exit_code": found.exit_code,
            "verdict": of_diagnosis._verdict(found),
            "candidates": [of_diagnosis.candidate(found.baseline, one) for one in found.explanations],
            "groups": [{"group": name, "probability": p} for name, p in found.groups],
            "noise_scale": found.noise_scale,
            "residual": of_result.tested(found.innovation),
            "noise": None if found.noise is None else vars(found.noise),
            "held_out": {"records": [score(one) for one in found.scores]},
            "linearity": vars(found.linearity) | {"levels": [vars(level) for level in found.linearity.levels]},
            "recordings": {
                "fitted": list(found.fitted),
                "inputs": list(found.inputs),
                "outputs": list(found.channels),
                "units": list(found.units),
                "sd": found.sd,
            },
            "next_measurement": [],
            "geometry": geometry(problem),
            "units": system(problem.units) or None,
            "remarks": list(found.remarks),
            "warnings": [f"{d.code}: {d.message}" for d in problem.warnings],
        }
    )


def score(one: RecordScore) -> dict[str, Any]:
    """rms of the record and of what either model leaves, by output."""
    return {
        "title": one.title,
        "horizon_s": one.horizon_s,
        "rms": one.signal,
        "error": dict(one.short),
        "error_of_whole_record": dict(one.free),
    }
