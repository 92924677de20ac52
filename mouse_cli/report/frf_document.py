"""What the JSON of a run says of frequency response functions, and of how errors reach the answer."""

from typing import Any

import numpy as np

from mouse_cli.model.frf_fit import FrfFit
from mouse_cli.model.result import Result
from mouse_cli.observables.frf import names


def frf(result: Result) -> list[dict[str, Any]]:
    """One entry a measurement, `functions` in it one a function; errors in dB."""
    return [_measurement(fit) for fit in result.frf]


def _measurement(fit: FrfFit) -> dict[str, Any]:
    outputs, inputs = names(fit.test)
    return {
        "title": fit.test.title,
        "kind": fit.test.kind,
        "form": fit.form,
        "lines": len(fit.lines),
        "lines_hz": fit.test.frequency_hz[fit.lines],
        "accuracy": "assumed" if fit.assumed else "measured",
        "basis": fit.basis or None,
        "basis_error": fit.basis_error,
        "prior_median_db": fit.median_db(fit.prior),
        "revised_median_db": fit.median_db(fit.revised),
        "prior_fdac": fit.fdac(fit.prior),
        "revised_fdac": fit.fdac(fit.revised),
        "functions": [
            _function(fit, outputs[o], inputs[i], o, i)
            for i in range(len(inputs))
            for o in range(len(outputs))
            if fit.have[:, o, i].any()
        ],
    }


def _function(fit: FrfFit, output: str, force: str, o: int, i: int) -> dict[str, Any]:
    values: dict[str, Any] = {"output": output, "input": force, "lines": int(fit.have[:, o, i].sum())}
    for when, model in (("prior", fit.prior), ("revised", fit.revised)):
        values[f"{when}_median_db"] = float(np.nanmedian(np.abs(fit.off_db(model)[:, o, i])))
        values[f"{when}_frac"] = fit.frac(model)[o, i]
    return values


def conditioned(result: Result) -> dict[str, Any] | None:
    """The bounds of errors; what is infinite is None. weakest: by properties, in prior standard deviations."""
    found = result.conditioning
    if found is None or not result.status.answered:
        return None
    return {
        "condition": found.condition,
        "data": found.data,
        "sensitivities": found.sensitivities,
        "shift": found.shift,
        "with_prior": found.with_prior,
        "weakest": found.weakest,
    }
