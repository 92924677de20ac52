"""What a method of updating found, and what several did, as JSON documents, schemas mouse.update/1 and mouse.comparison/1."""

from typing import Any

from mouse_cli import __version__
from mouse_cli.model.arrays import dense
from mouse_cli.model.updated import Compared, Predicted, Updated
from mouse_cli.report.json_values import coded, dof_name, fields, plain, rows

SCHEMA, COMPARISON = "mouse.update/1", "mouse.comparison/1"
LARGEST_MATRIX = 140  # degrees of freedom up to which K is written out


def document(found: Updated | Compared) -> dict[str, Any]:
    """`found` in plain Python values."""
    problem = found.problem
    head = {"version": __version__, "title": problem.title.strip(), "source": problem.source.path}
    if isinstance(found, Updated):
        return plain({"schema": SCHEMA, **head, **_update(found), **_matrix(found)})
    refused = {key: coded(why) for key, why in found.refused.items()}
    each = [_update(one) for one in found.updates]
    return plain({"schema": COMPARISON, **head, "methods": each, "refused": refused})


def _update(found: Updated) -> dict[str, Any]:
    about, bounds = found.about, found.conditioning
    return {
        "method": about.key,
        "equation": about.equation,
        "guarantees": {g.aspect.replace(" ", "_").replace("-", "_"): g.given for g in about.guarantees},
        "physical": about.physical,
        "expansion": found.expansion or None,
        **fields(found, "iterations", "change", "converged", "exit_code"),
        "properties": [fields(m, "name", "unit", "before", "after") for m in found.moved],
        "configurations": [_configuration(one) for one in found.configurations],
        "checked": vars(found.checked),
        "conditioning": bounds and fields(bounds, "condition", "data", "sensitivities"),
        "warnings": coded(found.warnings),
    }


def _configuration(one: Predicted) -> dict[str, Any]:
    modes = rows(mode=one.number, **fields(one, "test_hz", "test_sd_hz", "prior_hz", "revised_hz", "mac"))
    return {**fields(one, "title", "fitted", "rms_percent"), "modes": modes}


def _matrix(found: Updated) -> dict[str, Any]:
    """K where it is small, with the degrees of freedom of its rows."""
    if found.K.shape[0] > LARGEST_MATRIX:
        return {"dofs": None, "stiffness": None}
    return {"dofs": [dof_name(label) for label in found.problem.structure.labels], "stiffness": dense(found.K)}
