"""A result as one JSON document, schema mouse.result/1."""

from dataclasses import asdict
from typing import Any

import numpy as np

from mouse_cli import __version__
from mouse_cli.dynamics.frequency import frequency_hz, sd_frequency_hz
from mouse_cli.model.arrays import dense, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import ChiSquareTest, Result
from mouse_cli.report.frf_document import conditioned, frf, held_frf
from mouse_cli.report.geometry_document import geometry, moved, shapes_by_dof
from mouse_cli.report.json_values import coded, dof_name, fields, rows
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index, positions, shape_index

SCHEMA = "mouse.result/1"
_LARGEST_COVARIANCE = 200
_LARGEST_MATRIX = 140


def document(result: Result) -> dict[str, Any]:
    """`result` in plain Python values; what is not finite or has no meaning is None."""
    problem = result.problem
    return {
        "schema": SCHEMA,
        "version": result.versions.get("mouse", __version__),
        "title": problem.title.strip(),
        "source": problem.source.path,
        "status": result.status.key,
        "message": result.status.sentence,
        "advice": result.status.advice,
        "exit_code": result.exit_code,
        "estimator": problem.run.estimator,
        "recursion": problem.run.recursion,
        "options": _options(problem),
        "confidence": problem.run.confidence,
        "cycles": [_cycle(cycle) for cycle in result.cycles],
        "parameters": parameters(result),
        "covariance": _covariance(result),
        "prior_covariance": problem.prior.dense() if len(problem.parameters) <= _LARGEST_COVARIANCE else None,
        **({"alternatives": _alternatives(result)} if result.alternatives else {}),
        **_matrices(result),
        "rigid_modes": result.rigid_modes,
        "eigenvalues": result.revised.eigenvalues,
        "modes": modes(result),
        "shapes": shapes(result),
        **drawn(result),
        "exceedances": [name for name, out in zip(result.labels, result.exceeding, strict=True) if out],
        "allowed": result.allowed,
        **_judged(result),
        **_sensitivities(result),
        **({"frf": frf(result.frf)} if result.frf else {}),
        **({"held_out_frf": held_frf(result.held_frf)} if result.held_frf else {}),
        "conditioning": conditioned(result),
        "warnings": coded((*problem.warnings, *result.warnings)),
        "versions": result.versions,
    }


def _options(problem: Problem) -> dict[str, Any]:
    """Every option of the run; degrees of freedom count from 1, as in decks."""
    dofs = [dof + 1 for dof in problem.run.total_mass_dofs]
    return {**asdict(problem.run), "total_mass_dofs": dofs, "scale": problem.test.scale}


def _sensitivities(result: Result) -> dict[str, Any]:
    """How the partial derivatives of the data at the revised model were computed; themselves when they were asked for."""
    method = "adjoint" if is_sparse(result.revised.K) else "all modes"
    found = {"sensitivities": {"method": method, "error": result.partials_error}}
    if result.B is None:
        return found
    elements, names = result.problem.elements.labels(), [p.name for p in result.problem.parameters]
    partials = {"data": result.labels, "elements": elements, "B": result.B, "parameters": names, "T": result.T}
    return {**found, "partials": partials}


def _cycle(cycle) -> dict[str, Any]:
    keys = ("theta", "chi2", "exceedances", "allowed", "cost", "damping")
    return {"cycle": cycle.index, **{key: getattr(cycle, key) for key in keys}}


def parameters(result: Result) -> list[dict[str, Any]]:
    """One entry a property; a run without an answer has no posterior, a property at its limit no standard deviation."""
    have, prior_sd = result.status.answered, result.problem.prior.sd
    return [
        {
            "name": parameter.name,
            "unit": parameter.unit,
            "prior": result.prior.theta[i],
            "prior_sd": prior_sd[i],
            "posterior": result.revised.theta[i] if have else None,
            "posterior_sd": result.sd_theta[i] if have and not result.at_limit[i] else None,
            "interval": result.interval(i) if have and not result.at_limit[i] else None,
            "transform": parameter.transform,
            "at_limit": result.at_limit[i],
        }
        for i, parameter in enumerate(result.problem.parameters)
    ]


def _covariance(result: Result) -> np.ndarray | None:
    if not result.status.answered or len(result.problem.parameters) > _LARGEST_COVARIANCE:
        return None
    return result.covariance


def _matrices(result: Result) -> dict[str, Any]:
    """Revised K and M, and those before, while they are small enough for a document; [A] of a model of matrices."""
    problem = result.problem
    if problem.structure.n > _LARGEST_MATRIX:
        return {}
    before = {"stiffness": dense(result.prior.K), "mass": dense(result.prior.M)}
    if not problem.terms and len(problem.parameters) <= _LARGEST_COVARIANCE:
        before |= {"elements": problem.elements.labels(), "A": dense(problem.A)}
    return {"stiffness": dense(result.revised.K), "mass": dense(result.revised.M), "before": before}


def modes(result: Result) -> list[dict[str, Any]]:
    """One entry a measured mode. sd_hz: of the revised prediction."""
    test, prior, revised = result.problem.test, result.prior, result.revised
    found = []
    for i, k in enumerate(eigenvalue_index(result)):
        hz = float(frequency_hz(revised.eigenvalues[revised.modes[i]]))
        known = k != NOT_MEASURED and hz > 0 and result.status.answered
        found.append(
            {
                "mode": test.number[i],
                "model_mode": revised.modes[i] + 1,
                "test_hz": test.frequency_hz[i],
                "test_sd_hz": test.frequency_sd_hz[i] if k != NOT_MEASURED else None,
                "prior_hz": float(frequency_hz(prior.eigenvalues[prior.modes[i]])),
                "revised_hz": hz,
                "sd_hz": sd_frequency_hz(hz, revised.sd_predicted[k]) if known else None,
                "mac": revised.mac[i],
                "prior_mac": prior.mac[i],
                "exceeds": bool(k != NOT_MEASURED and result.exceeding[k]),
            }
        )
    return found


def _alternatives(result: Result) -> dict[str, Any]:
    """Other modes of the posterior beside the answer, and what would decide."""
    found = result.alternatives
    names = [parameter.name for parameter in result.problem.parameters]
    others = [
        {
            "share": each.share,
            "cost": each.cost,
            "parameters": rows(name=names, value=each.theta, sd=each.sd),
        }
        for each in found.others
    ]
    telling = None
    if found.deciding is not None:
        mode, dof, here, there = found.deciding
        telling = {"mode": mode, "dof": dof_name(result.problem.structure.labels[dof]), "answer": here, "other": there}
    return {"share": found.share, "others": others, "deciding": telling}


def _judged(result: Result) -> dict[str, Any]:
    """The tests of the model's form."""
    tests = {key: tested(getattr(result, key)) for key in ("innovation", "residual", "prior_shift")}
    return {**tests, "model_form": result.model_form}


def drawn(result: Result) -> dict[str, Any]:
    """What drawings of the revised model need."""
    modes = moved(result)
    return {"geometry": geometry(result.problem, modes), "shapes_by_dof": shapes_by_dof(result.problem, modes)}


def shapes(result: Result) -> list[dict[str, Any]]:
    """One entry a measured component, at the scale of the theory. test_sd: of the test; sd: of the revised prediction."""
    test, places = result.problem.test, positions(result)
    index, have = shape_index(result), result.status.answered
    return [
        {
            "mode": test.number[i],
            "dof": dof_name(places[s]),
            "test": result.test_shapes[s, i],
            "test_sd": result.test_shape_sd[s, i],
            "prior": result.prior.model_shapes[s, i],
            "revised": result.revised.model_shapes[s, i],
            "sd": result.revised.sd_predicted[index[s, i]] if have else None,
            "exceeds": result.exceeding[index[s, i]],
        }
        for i in range(test.m)
        for s in range(test.s)
        if index[s, i] != NOT_MEASURED
    ]


def tested(test: ChiSquareTest) -> dict[str, Any]:
    """A test of the model's form."""
    return fields(test, "chi2", "dof", "p")
