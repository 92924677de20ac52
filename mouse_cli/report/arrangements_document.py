"""A diagnosis of several arrangements as one JSON document, schema mouse.arrangements/1."""

from typing import Any

from mouse_cli import __version__
from mouse_cli.model.arrangements import ArrangementsDiagnosis, Turn
from mouse_cli.model.diagnosis import ONE_OF
from mouse_cli.model.units import system
from mouse_cli.report.diagnosis_document import candidate, score, site
from mouse_cli.report.geometry_document import geometry
from mouse_cli.report.json_values import plain
from mouse_cli.report.theory import document as theory

SCHEMA = "mouse.arrangements/1"


def document(found: ArrangementsDiagnosis) -> dict[str, Any]:
    """`found` in plain Python values; what was not found out is None."""
    held, told = found.held_out, (found.extended or found.problems)[0].parameters
    return plain(
        {
            "schema": SCHEMA,
            "version": __version__,
            "title": found.problem.title.strip(),
            "sources": [each.source.path for each in found.problems],
            "changed": None if found.changed is None else list(found.changed),
            "exit_code": found.exit_code,
            "verdict": {"kind": found.kind, "causes": [_told(turn) for turn in found.turns]},
            "turns": [_turn(turn) for turn in found.turns],
            "rest": [candidate(found.rest[0], one) for one in found.rest],
            "residual": {"chi2": found.chi2, "dof": found.dof, "p": found.p},
            "parameters": [
                {"name": p.name, "unit": p.unit, "prior": p.nominal, "posterior": value, "sd": sd}
                for p, value, sd in zip(told, found.values, found.sd, strict=True)
            ],
            "shared_errors": [{"mode": e.mode, "value": e.value, "sd": e.sd} for e in found.shared],
            "common_sd": found.common_sd,
            "theory": theory(found),
            "held_out": None
            if held is None
            else {
                "labels": list(held.labels),
                "measured_hz": held.measured_hz,
                "baseline": score(held.baseline),
                "revised": None if held.revised is None else score(held.revised),
            },
            "refuted": found.refuted or None,
            "geometry": geometry((found.extended or found.problems)[0]),
            "units": system(found.problem.units) or None,
            "remarks": list(found.remarks),
            "warnings": [f"{d.code}: {d.message}" for each in found.problems for d in each.warnings],
        }
    )


def _told(turn: Turn) -> dict[str, Any]:
    """The cause of a turn, and what else it may be."""
    best = turn.best
    rivals = [one.physics for one in turn.rivals if one.group != best.group] if turn.kind == ONE_OF else []
    return {
        "kind": turn.kind,
        "physics": best.physics,
        "group": best.group,
        "site": site(best.causes[0].site),
        "probability": turn.probability,
        "rivals": rivals,
    }


def _turn(turn: Turn) -> dict[str, Any]:
    before = turn.before
    return {
        "before": {"chi2": before.chi2, "dof": before.dof, "p": before.p},
        "candidates": [candidate(turn.before, one) for one in turn.explanations],
        "groups": [{"group": name, "probability": p} for name, p in turn.groups],
        "noise_scale": turn.noise_scale,
        "gain": turn.gain,
        "held_out": None if turn.held is None else score(turn.held),
    }
