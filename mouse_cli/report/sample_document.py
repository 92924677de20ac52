"""Samples of a posterior as one JSON document, schema mouse.sample/1; the samples themselves go to a file of their own."""

from typing import Any

from mouse_cli.model.sampled import Quantity, Sampled
from mouse_cli.report.json_values import coded, fields, heading
from mouse_cli.report.result_document import tested

SCHEMA = "mouse.sample/1"


def document(found: Sampled) -> dict[str, Any]:
    """`found` in plain Python values."""
    problem, result = found.problem, found.result
    kept, walkers = found.chain.log_posterior.shape
    return {
        **heading(SCHEMA, problem),
        "exit_code": found.exit_code,
        "status": result.status.key,
        "model_form": result.model_form,
        "residual": tested(result.residual),
        **fields(found, "doubtful", "k_hat", "draws"),
        "parameters": [_quantity(each) for each in found.parameters],
        "frequencies": [
            {**_quantity(each), "measured": each.measured, "predicted": each.predicted} for each in found.frequencies
        ],
        "places": [{"values": each.theta, "cost": each.cost, "share": each.share} for each in found.modes],
        "chain": {
            "walkers": walkers,
            "steps": found.steps,
            "burn": found.burn,
            "kept": kept * walkers,
            **fields(found, "tau", "acceptance", "long_enough", "seed", "evaluations"),
        },
        "warnings": coded((*problem.warnings, *found.warnings)),
    }


def _quantity(each: Quantity) -> dict[str, Any]:
    low, left, median, right, high = each.quantiles
    return {
        "name": each.name,
        "unit": each.unit,
        "run": each.normal_mean,
        "run_sd": each.normal_sd,
        "mean": each.mean,
        "sd": each.sd,
        "median": median,
        "interval_68": [left, right],
        "interval_95": [low, high],
        "tau": each.tau,
        "effective_size": each.size,
        "r_hat": each.r_hat,
    }
