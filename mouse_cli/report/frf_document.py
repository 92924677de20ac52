"""What JSON says of frequency response functions, and of how errors reach the answer."""

from typing import Any

import numpy as np

from mouse_cli.model.frf_fit import Damping, FrfFit
from mouse_cli.model.result import Result
from mouse_cli.observables.frf import names
from mouse_cli.report.json_values import fields

MOST_POINTS, MOST_CURVES = 600, 4  # points of a curve, and functions of a measurement that have curves


def frf(fits: tuple[FrfFit, ...]) -> list[dict[str, Any]]:
    """One entry a measurement, `functions` in it one a function; errors in dB, under the key of each model."""
    return [_measurement(fit) for fit in fits]


def held_frf(fits: tuple[FrfFit, ...]) -> list[dict[str, Any]]:
    """The same of what was held out; `covered`: share of magnitudes within the 90 % intervals of a model."""
    covered = [{f"{model.key}_covered": fit.covered(model) for model in fit.models} for fit in fits]
    return [_measurement(fit) | shares for fit, shares in zip(fits, covered, strict=True)]


def damping(found: tuple[Damping, ...]) -> list[dict[str, Any]]:
    """Damping of the structure; determined: whether the functions tell it."""
    return [fields(d, "name", "unit", "value", "sd", "determined") for d in found]


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
        **{f"{model.key}_median_db": fit.median_db(model.H) for model in fit.models},
        **{f"{model.key}_rms_sd": fit.rms_sd(model.H) for model in fit.models},
        **{f"{model.key}_fdac": fit.fdac(model.H) for model in fit.models},
        "functions": [
            _function(fit, outputs[o], inputs[i], o, i)
            for i in range(len(inputs))
            for o in range(len(outputs))
            if fit.have[:, o, i].any()
        ],
        "curves": [_curves(fit, outputs[o], inputs[i], o, i) for o, i in _worst(fit)],
    }


def _worst(fit: FrfFit) -> list[tuple[int, int]]:
    """Response and force of the functions that the last model misses most, the worst first."""
    off = np.abs(fit.off_db(fit.revised))
    pairs = [(o, i) for i in range(off.shape[2]) for o in range(off.shape[1]) if fit.have[:, o, i].any()]
    return sorted(pairs, key=lambda pair: -float(np.nanmedian(off[:, *pair])))[:MOST_CURVES]


def _curves(fit: FrfFit, output: str, force: str, o: int, i: int) -> dict[str, Any]:
    """[frequency in Hz, 20 log10 |H|] of test and models."""
    hz, found = fit.test.frequency_hz, {"output": output, "input": force}
    for key, H in (("measured", fit.test.H), *((model.key, model.H) for model in fit.models)):
        with np.errstate(divide="ignore", invalid="ignore"):
            found[key] = thinned(hz, 20 * np.log10(np.abs(H[:, o, i])))
    return found


def thinned(x: np.ndarray, y: np.ndarray, most: int = MOST_POINTS, digits: int | None = 2) -> np.ndarray:
    """Points (r, 2), finite, at most `most` of them: the lowest and the highest of each stretch, so that peaks stay.

    x to six significant digits; y to so many decimals, None for five significant digits.

    >>> thinned(np.arange(6.0), np.array([0.0, 9.0, 1.0, -3.0, np.nan, 0.5]), 4).tolist()
    [[0.0, 0.0], [1.0, 9.0], [3.0, -3.0], [5.0, 0.5]]
    """
    have = np.isfinite(y)
    x, y = x[have], y[have]
    if len(y) > most:
        parts = np.array_split(np.arange(len(y)), most // 2)
        kept = np.unique([part[pick(y[part])] for part in parts for pick in (np.argmin, np.argmax)])
        x, y = x[kept], y[kept]
    short = y.round(digits) if digits is not None else [float(f"{value:.5g}") for value in y]
    return np.column_stack([[float(f"{value:.6g}") for value in x], short])


def _function(fit: FrfFit, output: str, force: str, o: int, i: int) -> dict[str, Any]:
    values: dict[str, Any] = {"output": output, "input": force, "lines": int(fit.have[:, o, i].sum())}
    for model in fit.models:
        values[f"{model.key}_median_db"] = float(np.nanmedian(np.abs(fit.off_db(model.H)[:, o, i])))
        values[f"{model.key}_frac"] = fit.frac(model.H)[o, i]
    return values


def conditioned(result: Result) -> dict[str, Any] | None:
    """The bounds of errors; what is infinite is None. weakest: by properties, in prior standard deviations."""
    found = result.conditioning
    if found is None or not result.status.answered:
        return None
    return fields(found, "condition", "data", "sensitivities", "shift", "with_prior", "weakest")
