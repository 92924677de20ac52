"""What a deck says of its parameters and its modal test, with the keys of a result: for frames, written nowhere."""

from typing import Any

import numpy as np

from mouse_cli.model.problem import Problem
from mouse_cli.model.units import system
from mouse_cli.report.json_values import dof_name, fields, plain, rows

_LARGEST_COVARIANCE = 200


def document(problem: Problem) -> dict[str, Any]:
    """Parameters, their covariance before the test, measured modes and components of their shapes, in plain Python values.

    Shapes are in the units measured; what was not measured is None.
    """
    covariance = problem.prior.dense() if len(problem.parameters) <= _LARGEST_COVARIANCE else None
    return plain(
        {
            "title": problem.title.strip(),
            "source": problem.source.path,
            "units": system(problem.units) or None,
            "parameters": _parameters(problem),
            "prior_covariance": covariance,
            **({"modes": _modes(problem), "shapes": _shapes(problem)} if problem.test else {}),
        }
    )


def _parameters(problem: Problem) -> list[dict[str, Any]]:
    sd = problem.prior.sd
    return [
        {
            "name": each.name,
            "unit": each.unit,
            "prior": problem.prior.mean[i],
            "prior_sd": sd[i],
            **fields(each, "lower", "upper", "transform"),
        }
        for i, each in enumerate(problem.parameters)
    ]


def _modes(problem: Problem) -> list[dict[str, Any]]:
    test = problem.test
    return rows(mode=test.number, test_hz=test.frequency_hz, test_sd_hz=test.frequency_sd_hz)


def _shapes(problem: Problem) -> list[dict[str, Any]]:
    """One entry a measured component."""
    test, labels = problem.test, problem.structure.labels
    names = test.sensors or tuple(labels[dof] for dof in test.dofs)
    return [
        {
            "mode": test.number[i],
            "dof": dof_name(names[s]),
            "test": test.shapes[s, i],
            "test_sd": test.shape_sd[s, i],
        }
        for i in range(test.m)
        for s in range(test.s)
        if np.isfinite(test.shapes[s, i])
    ]
