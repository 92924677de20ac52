"""A comparison of test and model as one JSON document, schema mouse.correlation/1."""

from dataclasses import asdict
from typing import Any

import numpy as np

from mouse_cli.model.correlation import ALONE, Correlation, Expanded
from mouse_cli.report.json_values import coded, dof_name, fields, heading, rows

SCHEMA = "mouse.correlation/1"


def document(found: Correlation) -> dict[str, Any]:
    """`found` in plain Python values; matrices have a row for each measured mode, columns for model modes 1, 2, ..."""
    problem = found.problem
    return {
        **heading(SCHEMA, problem),
        "rigid_modes": found.rigid_modes,
        "model_hz": found.frequencies_hz,
        "visible": found.visible,
        "modes": [_mode(found, i) for i in range(problem.test.m)],
        "unclaimed": found.unclaimed + 1,
        "mac": found.mac,
        "auto_mac_test": found.auto_test,
        "auto_mac_model": found.auto_model,
        "sensors": rows(name=map(dof_name, found.sensors), comac=found.comac, ecomac=found.ecomac),
        "sensor_faults": [
            {**asdict(f), "sensors": [dof_name(found.sensors[k]) for k in f.sensors]} for f in found.faults
        ],
        "orthogonality": {judged.key: fields(judged, "test", "sd", "cross", "model") for judged in found.orthogonality},
        "subspaces": [
            {
                "modes": problem.test.number[list(close.test)],
                "model_modes": np.array(close.model) + 1,
                "mac": close.cosines,
            }
            for close in found.subspaces
        ],
        "expansion": None if found.expanded is None else _expansion(found, found.expanded),
        "warnings": coded((*problem.warnings, *found.warnings)),
    }


def _mode(found: Correlation, i: int) -> dict[str, Any]:
    """One measured mode; what depends on a partner is None without one."""
    test, j = found.problem.test, int(found.modes[i])
    paired = j != ALONE
    hz = float(found.frequencies_hz[j]) if paired else np.nan
    return {
        "mode": test.number[i],
        "model_mode": j + 1 if paired else None,
        "test_hz": test.frequency_hz[i],
        "test_sd_hz": test.frequency_sd_hz[i],
        "model_hz": hz,
        "difference_percent": 100 * (hz / test.frequency_hz[i] - 1),
        "difference_sd": (hz - test.frequency_hz[i]) / test.frequency_sd_hz[i],
        "mac": found.mac[i, j] if paired else None,
        "scale_factor": found.scale_factor[i],
    }


def _expansion(found: Correlation, expanded: Expanded) -> dict[str, Any]:
    """Shapes row by row in the order of `dofs`, one column a mode."""
    return {
        "method": expanded.key,
        "exact": expanded.exact,
        "modes": found.problem.test.number[expanded.modes],
        "dofs": [dof_name(label) for label in found.problem.structure.labels],
        **fields(expanded, "shapes", "mass", "stiffness", "hz"),
        "misfit_sd": expanded.misfit,
    }
