"""The answers of a campaign, read again from their files."""

import json
from typing import Any

import numpy as np

from mouse_cli.batch.outcome import Outcome
from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.campaign import Answered


def document(outcome: Outcome) -> dict[str, Any]:
    """The document in the file of `outcome`; empty where it has no answer."""
    if outcome.exit_code >= 4:
        return {}
    with open(outcome.result, encoding="utf-8") as stream:
        return json.load(stream)["document"] or {}


def read(outcome: Outcome, names: list[str], modes: list[int]) -> Answered:
    """What the file of `outcome` says of the parameters called so and of these modes, (mode of the model, from 0)."""
    found = document(outcome)
    values = {each["name"]: each for each in found.get("parameters", ())}
    residual = found.get("residual") or {}
    return Answered(
        outcome.exit_code,
        outcome.ended,
        found.get("model_form") or "",
        _numbers([values.get(name, {}).get("posterior") for name in names]),
        _numbers([values.get(name, {}).get("posterior_sd") for name in names]),
        _frequencies(found.get("eigenvalues") or [], modes),
        _number(residual.get("chi2")),
        _number(residual.get("p")),
        outcome.result,
    )


def _frequencies(eigenvalues: list, modes: list[int]) -> np.ndarray:
    values = _numbers([eigenvalues[i] if i < len(eigenvalues) else None for i in modes])
    return frequency_hz(np.maximum(values, 0.0))


def _numbers(values: list) -> np.ndarray:
    return np.array([_number(value) for value in values], float)


def _number(value: Any) -> float:
    return np.nan if value is None else float(value)
