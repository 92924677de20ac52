"""An update by recordings as one JSON document, schema mouse.result/1 with what recordings fill of it."""

from typing import Any

from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.units import system
from mouse_cli.report import record_document as of_records
from mouse_cli.report import result_document as of_result
from mouse_cli.report.geometry_document import geometry
from mouse_cli.report.json_values import coded, fields, heading, rows
from mouse_cli.report.theory import document as theory
from mouse_cli.report.verdict_document import site


def document(found: RecordUpdate) -> dict[str, Any]:
    """`found` in plain Python values; `--prior` takes parameters and covariance from it."""
    problem = found.problem
    return {
        **heading(of_result.SCHEMA, problem),
        "status": "converged",
        "message": found.message,
        "exit_code": found.exit_code,
        "model_form": "accepted" if found.explained else "rejected",
        "parameters": _parameters(found),
        "covariance": found.covariance,
        "laws": [
            {
                "physics": one.physics,
                "title": one.title,
                "site": site(one.site),
                "parameters": [fields(each, "name", "unit", "value", "sd") for each in one.sizes],
            }
            for one in found.laws
        ],
        "residual": of_result.tested(found.residual),
        "noise_scale": found.noise_scale,
        "noise": None if found.noise is None else vars(found.noise),
        "held_out": of_records.held_out(found),
        "restoring_force": of_records.restoring_force(found.surface),
        "theory": theory(found),
        "geometry": geometry(problem),
        "units": system(problem.units) or None,
        "remarks": list(found.remarks),
        "warnings": coded(problem.warnings),
    }


def _parameters(found: RecordUpdate) -> list[dict[str, Any]]:
    own, prior = found.problem.parameters, found.problem.prior
    return rows(
        name=[one.name for one in own],
        unit=[one.unit for one in own],
        prior=prior.mean,
        prior_sd=prior.sd,
        posterior=found.theta,
        posterior_sd=found.sd_theta,
        at_limit=[False] * len(own),
    )
