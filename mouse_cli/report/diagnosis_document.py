"""A diagnosis as one JSON document, schema mouse.diagnosis/1."""

from typing import Any

from mouse_cli import __version__
from mouse_cli.model.diagnosis import (
    EVERYWHERE,
    NAMED,
    ONE_OF,
    UNKNOWN,
    Diagnosis,
    EnergyMap,
    Explanation,
    HeldOut,
    Law,
    Location,
    Proposal,
    Score,
    Site,
)
from mouse_cli.model.result import Result
from mouse_cli.model.units import system
from mouse_cli.report import result_document as of_result
from mouse_cli.report.frf_document import damping, frf, held_frf
from mouse_cli.report.json_values import dof_name, plain
from mouse_cli.report.theory import document as theory

SCHEMA = "mouse.diagnosis/1"
_PLACES = 200  # most that are listed
_NOWHERE = Site("none")


def document(found: Diagnosis) -> dict[str, Any]:
    """`found` in plain Python values; what was not found out is None."""
    problem, result = found.problem, found.result
    return plain(
        {
            "schema": SCHEMA,
            "version": __version__,
            "title": problem.title.strip(),
            "source": problem.source.path,
            "exit_code": found.exit_code,
            "verdict": _verdict(found),
            "candidates": [candidate(found.baseline, one) for one in found.explanations],
            "groups": [{"group": name, "probability": p} for name, p in found.groups],
            "noise_scale": found.noise_scale,
            "innovation": of_result.tested(found.innovation),
            "residual": of_result.tested(result.residual),
            "prior_shift": of_result.tested(result.prior_shift),
            "location": None if found.location is None else _location(found.location),
            "energy": None if found.energy is None else _energy(found.energy),
            "law": None if found.law is None else _law(found.law),
            "held_out": None if found.held_out is None else _held_out(found.held_out),
            "frf": frf(found.frf),
            "held_out_frf": held_frf(found.held_frf),
            "damping": damping(found.damping),
            "next_measurement": [_proposal(each) for each in found.proposals],
            "cautions": list(found.cautions),
            "refuted": list(found.refuted),
            "misstated": found.misstated,
            "asked": _asked(found),
            "theory": theory(found),
            "units": system(problem.units) or None,
            **of_result.drawn(found.extended_result or result),
            "baseline": _update(result),
            "extended": None if found.extended_result is None else _update(found.extended_result),
            "remarks": list(found.remarks),
            "warnings": [f"{d.code}: {d.message}" for d in (*problem.warnings, *result.warnings)],
        }
    )


def _verdict(found: Diagnosis) -> dict[str, Any]:
    """physics, group and site of the cause that is named, or that leads its rivals; none of them without a candidate cause."""
    best = found.best
    told = best is not None and bool(best.causes) and found.kind in (NAMED, ONE_OF)
    rivals = [name for name, _ in found.rivals] if found.kind == ONE_OF else []
    return {
        "kind": found.kind,
        "physics": best.physics if told else None,
        "group": best.group if told else None,
        "site": site(best.causes[0].site) if told else None,
        "sites": [site(cause.site) for cause in best.causes] if told else [],
        "damping": [cause.law or None for cause in best.causes] if told else [],
        "probability": None if found.kind == UNKNOWN else found.probability,
        "rivals": rivals,
    }


def _proposal(each: Proposal) -> dict[str, Any]:
    return {
        "measure": each.text,
        "between": list(each.between),
        "separation": each.separation,
        "outlook": each.outlook,
        "effort": int(each.effort),
    }


def _asked(found: Diagnosis) -> dict[str, Any]:
    """The options that change the answer."""
    only, run = found.choices.candidates, found.problem.run
    return {
        "candidates": None if only is None else list(only),
        "causes": found.choices.causes,
        "estimator": run.estimator,
        "recursion": run.recursion,
    }


def candidate(baseline: Explanation | None, one: Explanation) -> dict[str, Any]:
    """One explanation, beside that without a cause."""
    sites = [cause.site for cause in one.causes] or [_NOWHERE]
    return {
        "physics": one.physics,
        "group": one.group,
        "title": one.title,
        "site": site(sites[0]),
        "sites": [site(each) for each in sites],
        "log_evidence": one.log_evidence,
        "log_evidence_over_none": None if baseline is None else one.log_evidence - baseline.log_evidence,
        "probability": one.probability,
        "elsewhere": [{"sites": [site(each) for each in sites], "share": share} for sites, share in one.elsewhere],
        "parameters": [
            {
                "name": s.name,
                "unit": s.unit,
                "value": s.value,
                "sd": s.sd,
                "lower": s.lower,
                "upper": s.upper,
                "cause": cause.physics,
            }
            for cause in one.causes
            for s in cause.sizes
        ],
        "chi2": one.chi2,
        "dof": one.dof,
        "p": one.p,
    }


def site(place: Site) -> dict[str, Any]:
    """A place; ids as decks write them."""
    ids = [dof_name(i) if isinstance(i, str) else i for i in place.ids]
    text = place.text or (EVERYWHERE.text if place.kind == EVERYWHERE.kind else "")
    return {"kind": place.kind, "ids": ids, "position": place.position, "text": text}


def _location(location: Location) -> dict[str, Any]:
    """The most probable places, the best first; `region` counts those of the 90 % region, listed or not."""
    return {
        "p": location.p,
        "single": location.single,
        "region": location.region,
        "tried": len(location.places),
        "places": [
            {"site": site(p.site), "channel": p.channel, "probability": p.probability, "deficit": p.deficit}
            for p in location.places[:_PLACES]
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
    return {
        "site": site(law.site),
        "unit": law.unit,
        "hz": law.frequency_hz,
        "stiffness": law.stiffness,
        "sd": law.sd,
        "fitted": law.fitted,
    }


def _held_out(held: HeldOut) -> dict[str, Any]:
    return {
        "kind": held.kind,
        "labels": list(held.labels),
        "measured_hz": held.measured_hz,
        "baseline": score(held.baseline),
        "revised": None if held.revised is None else score(held.revised),
    }


def score(found: Score) -> dict[str, Any]:
    """How well data that no fit has seen were predicted."""
    return {
        "rms_frequency_error": found.rms_frequency_error,
        "log_predictive_density": found.log_predictive_density,
        "covered": found.covered,
        "hz": found.frequencies_hz,
        "sd_hz": found.sd_hz,
        "mac": found.mac,
        "rms_shape_error": found.rms_shape_error,
    }


def _update(result: Result) -> dict[str, Any]:
    """What `mouse run` says of a model, in brief."""
    return {
        "status": result.status.key,
        "message": result.status.sentence,
        "model_form": result.model_form,
        "exit_code": result.exit_code,
        "parameters": of_result.parameters(result),
        "modes": of_result.modes(result),
        "shapes": of_result.shapes(result),
    }
