"""A diagnosis by recordings as one JSON document, schema mouse.diagnosis/1 with what recordings add."""

from typing import Any

import numpy as np

from mouse_cli.model.record_diagnosis import RecordDiagnosis, RecordScore, Surface, Trace
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.units import system
from mouse_cli.report import diagnosis_document as of_diagnosis
from mouse_cli.report import result_document as of_result
from mouse_cli.report.asked import document as asked
from mouse_cli.report.frf_document import thinned
from mouse_cli.report.geometry_document import geometry
from mouse_cli.report.json_values import coded, fields, heading
from mouse_cli.report.theory import document as theory
from mouse_cli.report.verdict_document import verdict

_SAMPLES = 500  # of a restoring force


def document(found: RecordDiagnosis) -> dict[str, Any]:
    """`found` in plain Python values; keys of the modal diagnosis that recordings do not fill are None or empty."""
    problem = found.problem
    return {
        **heading(of_diagnosis.SCHEMA, problem),
        "exit_code": found.exit_code,
        "verdict": verdict(found),
        "candidates": of_diagnosis.candidates(found),
        "groups": of_diagnosis.groups(found),
        **fields(found, "noise_scale", "cautions", "refuted"),
        "residual": of_result.tested(found.innovation),
        "noise": None if found.noise is None else vars(found.noise),
        "held_out": held_out(found),
        "restoring_force": restoring_force(found.surface),
        "linearity": vars(found.linearity) | {"levels": [vars(level) for level in found.linearity.levels]},
        "recordings": {
            "fitted": list(found.fitted),
            "inputs": list(found.inputs),
            "outputs": list(found.channels),
            "units": list(found.units),
            "sd": found.sd,
        },
        "next_measurement": [],
        "asked": asked(found.choices),
        "theory": theory(found),
        "geometry": geometry(problem),
        "units": system(problem.units) or None,
        "remarks": list(found.remarks),
        "warnings": coded(problem.warnings),
    }


def held_out(found: RecordDiagnosis | RecordUpdate) -> dict[str, Any]:
    """Records kept from the fit, and a stretch of one."""
    return {"records": [_score(one) for one in found.scores], "trace": _trace(found.trace)}


def _score(one: RecordScore) -> dict[str, Any]:
    """rms of the record and of what either model leaves, by output."""
    return {
        "title": one.title,
        "horizon_s": one.horizon_s,
        "rms": one.signal,
        "error": dict(one.short),
        "error_of_whole_record": dict(one.free),
    }


def _trace(found: Trace | None) -> dict[str, Any] | None:
    """A stretch of a held-out record as [s, value]: measured, and simulated by each model."""
    if found is None:
        return None
    of = lambda values: thinned(found.time_s, np.asarray(values, float), digits=None)
    simulated = {name: of(values) for name, values in found.simulated.items()}
    return {"title": found.title, "unit": found.unit, "measured": of(found.measured), "simulated": simulated}


def restoring_force(found: Surface | None) -> dict[str, Any] | None:
    """Samples of the force at the place of a law, evenly over the record, and what the fitted law gives there."""
    if found is None:
        return None
    own = slice(None, None, -(-len(found.x) // _SAMPLES))
    values = {"motion": found.x, "velocity": found.v, "force": found.force, "law": found.law}
    short = {key: [float(f"{x:.5g}") for x in value[own]] for key, value in values.items()}
    return {"title": found.title, "place": found.site, **short}
