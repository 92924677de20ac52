"""A diagnosis as one JSON document, schema mouse.diagnosis/1."""

from typing import Any

from mouse_cli.model.diagnosis import (
    UNKNOWN,
    Diagnosis,
    EnergyMap,
    Explanation,
    Law,
    Location,
    Site,
)
from mouse_cli.model.result import Result
from mouse_cli.model.units import system
from mouse_cli.report import result_document as of_result
from mouse_cli.report.asked import document as asked
from mouse_cli.report.frf_document import damping, frf, held_frf
from mouse_cli.report.json_values import coded, fields, heading
from mouse_cli.report.theory import document as theory
from mouse_cli.report.verdict_document import held_out, site, verdict

SCHEMA = "mouse.diagnosis/1"
_PLACES = 200  # most that are listed
_NOWHERE = Site("none")


def document(found: Diagnosis) -> dict[str, Any]:
    """`found` in plain Python values; what was not found out is None."""
    problem, result = found.problem, found.result
    return {
        **heading(SCHEMA, problem),
        "exit_code": found.exit_code,
        "verdict": verdict(found),
        "candidates": candidates(found),
        "groups": groups(found),
        "noise_scale": found.noise_scale,
        "innovation": of_result.tested(found.innovation),
        "residual": of_result.tested(result.residual),
        "prior_shift": of_result.tested(result.prior_shift),
        "location": None if found.location is None else _location(found.location),
        "energy": None if found.energy is None else _energy(found.energy),
        "law": None if found.law is None else _law(found.law),
        "held_out": None if found.held_out is None else held_out(found.held_out),
        "frf": frf(found.frf),
        "held_out_frf": held_frf(found.held_frf),
        "damping": damping(found.damping),
        "next_measurement": [
            {"measure": each.text, **fields(each, "between", "separation", "outlook"), "effort": int(each.effort)}
            for each in found.proposals
        ],
        **fields(found, "cautions", "refuted", "misstated"),
        "asked": {**asked(found.choices), **fields(problem.run, "estimator", "recursion")},
        "theory": theory(found),
        "units": system(problem.units) or None,
        **of_result.drawn(found.extended_result or result),
        "baseline": _update(result),
        "extended": None if found.extended_result is None else _update(found.extended_result),
        "remarks": list(found.remarks),
        "warnings": coded((*problem.warnings, *result.warnings)),
    }


def candidates(found: Diagnosis) -> list[dict[str, Any]]:
    """All explanations, the most probable first; without probabilities where none explains the data."""
    return [candidate(found.baseline, one, found.kind != UNKNOWN) for one in found.explanations]


def groups(found: Diagnosis) -> list[dict[str, Any]]:
    """Groups and their probabilities, likewise."""
    return [{"group": name, "probability": None if found.kind == UNKNOWN else p} for name, p in found.groups]


def candidate(baseline: Explanation | None, one: Explanation, explains: bool = True) -> dict[str, Any]:
    """One explanation, compared with that without a cause; explains: whether one of them explains the data."""
    sites = [cause.site for cause in one.causes] or [_NOWHERE]
    return {
        **fields(one, "physics", "group", "title"),
        "site": site(sites[0]),
        "sites": [site(each) for each in sites],
        "log_evidence": one.log_evidence,
        "log_evidence_over_none": None if baseline is None else one.log_evidence - baseline.log_evidence,
        "probability": one.probability if explains else None,
        "elsewhere": [{"sites": [site(each) for each in sites], "share": share} for sites, share in one.elsewhere],
        "parameters": [
            {**fields(s, "name", "unit", "value", "sd", "lower", "upper"), "cause": cause.physics}
            for cause in one.causes
            for s in cause.sizes
        ],
        **fields(one, "chi2", "dof", "p"),
    }


def _location(location: Location) -> dict[str, Any]:
    """The most probable places, the best first; `region` counts those of the 90 % region, listed or not."""
    return {
        **fields(location, "p", "single", "region"),
        "tried": len(location.places),
        "places": [
            {"site": site(p.site), **fields(p, "channel", "probability", "deficit")} for p in location.places[:_PLACES]
        ],
    }


def _energy(energy: EnergyMap) -> dict[str, Any]:
    """The places with the largest shares; `half` counts those that hold half of the whole."""
    return {
        "half": energy.half,
        "of": len(energy.sites),
        "modes": [{"mode": int(m), "error": e} for m, e in zip(energy.mode, energy.error, strict=True)],
        "places": [{"site": site(energy.sites[i]), "share": energy.share[i]} for i in energy.order[:_PLACES]],
    }


def _law(law: Law) -> dict[str, Any]:
    named = {"site": site(law.site), "unit": law.unit, "hz": law.frequency_hz}
    return {**named, **fields(law, "stiffness", "sd", "fitted")}


def _update(result: Result) -> dict[str, Any]:
    """What `mouse run` says of a model, in brief."""
    return {
        "status": result.status.key,
        "message": result.status.sentence,
        **fields(result, "model_form", "exit_code"),
        "parameters": of_result.parameters(result),
        "modes": of_result.modes(result),
        "shapes": of_result.shapes(result),
    }
