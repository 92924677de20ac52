"""A diagnosis of several arrangements as one JSON document, schema mouse.arrangements/1."""

from collections.abc import Sequence
from itertools import product
from math import prod
from typing import Any

from mouse_cli.model.arrangements import ArrangementsDiagnosis, Turn
from mouse_cli.model.diagnosis import ONE_OF, UNKNOWN
from mouse_cli.model.units import system
from mouse_cli.report.arrangements_sentences import sentences
from mouse_cli.report.asked import document as asked
from mouse_cli.report.diagnosis_document import candidate
from mouse_cli.report.geometry_document import geometry
from mouse_cli.report.json_values import fields
from mouse_cli.report.theory import document as theory
from mouse_cli.report.verdict_document import elsewhere, field, rest, score, site, untried, verdict

SCHEMA = "mouse.arrangements/1"


def document(found: ArrangementsDiagnosis) -> dict[str, Any]:
    """`found` in plain Python values; what was not found out is None."""
    held, parameters = found.held_out, (found.extended or found.problems)[0].parameters
    return {
        "schema": SCHEMA,
        "title": found.problem.title.strip(),
        "sources": [each.source.path for each in found.problems],
        "changed": None if found.changed is None else list(found.changed),
        "exit_code": found.exit_code,
        "verdict": _verdict(found),
        "turns": [_turn(turn, found.kind != UNKNOWN) for turn in found.turns],
        "rest": [candidate(found.rest[0], one, found.kind != UNKNOWN) for one in found.rest],
        "residual": fields(found, "chi2", "dof", "p"),
        "state": None if found.state is None else {"in_all_decks": found.begun, "verdict": verdict(found.state)},
        "tests": None if found.tests is None else fields(found.tests, "chi2", "dof", "p"),
        "parameters": [
            {"name": p.name, "unit": p.unit, "prior": p.nominal, "posterior": value, "sd": sd}
            for p, value, sd in zip(parameters, found.values, found.sd, strict=True)
        ],
        "shared_errors": [fields(e, "mode", "value", "sd") for e in found.shared],
        "common_sd": found.common_sd,
        "asked": asked(found.choices),
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


def _verdict(found: ArrangementsDiagnosis) -> dict[str, Any]:
    """All mechanisms together with the keys of any diagnosis, in the order of their identification, and each by itself."""
    explains = found.kind != UNKNOWN
    turns = found.turns if explains else ()
    best = [turn.best for turn in turns]
    sites = [site(cause.site) for one in best for cause in one.causes]
    return {
        "kind": found.kind,
        "sentences": list(sentences(found)),
        "physics": " + ".join(one.physics for one in best) or None,
        "group": " + ".join(one.group for one in best) or None,
        "site": sites[0] if sites else None,
        "sites": sites,
        "probability": prod(turn.probability for turn in turns) if turns else None,
        "members": _members(turns) or None,
        "elsewhere": elsewhere(turns[0].elsewhere) if len(turns) == 1 else [],
        "companions": [],
        "rest": rest(found.remaining),
        "field": field(found.field),
        "untried": untried(found.untried),
        "causes": [_cause(turn, explains) for turn in found.turns],
    }


def _members(turns: Sequence[Turn]) -> dict[str, float]:
    """Physics within the groups of all turns, and their probability where it is more than 1e-6."""
    ways = product(*([each for each in turn.members if each[1] > 1e-6] for turn in turns)) if turns else ()
    return {" + ".join(physics for physics, _ in way): prod(p for _, p in way) for way in ways}


def _cause(turn: Turn, explains: bool) -> dict[str, Any]:
    """The mechanism of a turn, and what else it may be; without probabilities where all together explain nothing."""
    best = turn.best
    rivals = [one.physics for one in turn.rivals if one.group != best.group] if turn.kind == ONE_OF else []
    return {
        "kind": turn.kind,
        "physics": best.physics,
        "group": best.group,
        "site": site(best.causes[0].site),
        "sites": [site(cause.site) for cause in best.causes],
        "probability": turn.probability if explains else None,
        "members": dict(turn.members) if explains else None,
        "elsewhere": elsewhere(turn.elsewhere) if explains else [],
        "rivals": rivals,
    }


def _turn(turn: Turn, explains: bool) -> dict[str, Any]:
    before = turn.before
    return {
        "before": fields(before, "chi2", "dof", "p"),
        "candidates": [candidate(turn.before, one, explains) for one in turn.explanations],
        "groups": [{"group": name, "probability": p if explains else None} for name, p in turn.groups],
        "noise_scale": turn.noise_scale,
        "gain": turn.gain,
        "held_out": None if turn.held is None else score(turn.held),
    }
