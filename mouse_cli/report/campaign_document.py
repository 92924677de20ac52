"""A sweep or a bootstrap as one JSON document, schema mouse.campaign/1."""

from typing import Any

from mouse_cli.model.campaign import Answered, Bootstrap, Moved, Spread, Sweep
from mouse_cli.report.json_values import coded, fields

SCHEMA = "mouse.campaign/1"


def document(found: Sweep | Bootstrap) -> dict[str, Any]:
    """`found` in plain Python values; None where there is no answer."""
    problem = found.problem
    own = _sweep(found) if isinstance(found, Sweep) else _bootstrap(found)
    return {
        "schema": SCHEMA,
        "kind": "sweep" if isinstance(found, Sweep) else "bootstrap",
        "title": problem.title.strip(),
        "source": problem.source.path,
        "exit_code": found.exit_code,
        **own,
        "warnings": coded(found.warnings),
    }


def _sweep(found: Sweep) -> dict[str, Any]:
    moved = [("parameters", found.parameters), ("frequencies", found.frequencies)]
    return {
        "varied": found.varied,
        "points": [
            {"values": dict(zip(found.varied, point, strict=True)), **_answered(answer, found)}
            for point, answer in zip(found.points, found.answers, strict=True)
        ],
        **{key: [_moved(each, found.varied) for each in some] for key, some in moved},
    }


def _answered(answer: Answered, found: Sweep | Bootstrap) -> dict[str, Any]:
    names = [each.name for each in found.parameters]
    return {
        "exit_code": answer.exit_code,
        "ended": answer.ended,
        "model_form": answer.model_form or None,
        "chi2": answer.chi2,
        "p": answer.p,
        "posterior": dict(zip(names, answer.theta, strict=True)),
        "posterior_sd": dict(zip(names, answer.sd, strict=True)),
        "hz": dict(zip([each.name for each in found.frequencies], answer.hz, strict=True)),
        "file": answer.file,
    }


def _moved(each: Moved, varied: tuple[str, ...]) -> dict[str, Any]:
    named = {"name": each.name, "unit": each.unit, "lowest": each.low, "highest": each.high, "posterior_sd": each.sd}
    return {**named, "moves_by_sd": each.lengths, "shares": dict(zip(varied, each.shares, strict=True))}


def _bootstrap(found: Bootstrap) -> dict[str, Any]:
    return {
        **fields(found, "over", "seed", "units"),
        "deck": _answered(found.answer, found),
        "left_out": [
            {"without": unit, **_answered(each, found)} for unit, each in zip(found.units, found.left_out, strict=True)
        ],
        "replicates": [
            {"counts": counts, **_answered(each, found)}
            for counts, each in zip(found.counts, found.replicates, strict=True)
        ],
        "parameters": [_spread(each, found.units) for each in found.parameters],
        "frequencies": [_spread(each, found.units) for each in found.frequencies],
    }


def _spread(each: Spread, units: tuple[str, ...]) -> dict[str, Any]:
    most = each.most_influential
    return {
        **fields(each, "name", "unit", "value", "posterior_sd"),
        "predicted_sd": each.predicted,
        "sd": each.sd,
        "bias": each.bias,
        "percentile_95": each.percentile,
        "bca_95": each.bca,
        "jackknife_sd": each.jackknife,
        "influence": dict(zip(units, each.influence, strict=True)),
        "most_influential": None if most is None else units[most],
    }
