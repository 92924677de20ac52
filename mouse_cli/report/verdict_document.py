"""The verdict of a diagnosis in plain Python values: the same keys for every kind of test."""

from collections.abc import Sequence
from math import isfinite
from typing import Any

from mouse_cli.model.diagnosis import (
    EVERYWHERE,
    NAMED,
    ONE_OF,
    UNKNOWN,
    Diagnosis,
    Field,
    HeldOut,
    Rest,
    Score,
    Site,
    Untried,
)
from mouse_cli.model.shared_place import SharedPlace
from mouse_cli.report.json_values import dof_name, fields
from mouse_cli.report.verdict_sentences import sentences

Elsewhere = tuple[tuple[tuple[Site, ...], float], ...]


def verdict(found: Diagnosis) -> dict[str, Any]:
    """physics, group and sites of what is named, or leads its rivals, in one order; none of them without a leader."""
    leader = found.leader
    causes, sites = () if leader is None else leader.causes, [site(each) for each in _sites(found)]
    return {
        "kind": found.kind,
        "sentences": list(sentences(found)),
        "physics": leader and leader.physics,
        "group": leader and leader.group,
        "site": sites[0] if sites else None,
        "sites": sites,
        "damping": [cause.law or None for cause in causes],
        "probability": None if found.kind == UNKNOWN else found.probability,
        "members": dict(found.members) or None,
        "companions": [{"group": group, "probability": p} for group, p in found.certain.companions]
        if found.certain
        else [],
        "elsewhere": elsewhere(found.elsewhere),
        "shared": shared(found.shared),
        "rivals": [name for name, _ in found.rivals] if found.kind == ONE_OF else [],
        "rest": rest(found.rest),
        "field": field(found.field),
        "untried": untried(found.untried),
    }


def _sites(found: Diagnosis) -> tuple[Site, ...]:
    """Where the leader acts; of a pair of nodes of which only the panels are sure, all nodes that may be of it."""
    own = () if found.leader is None else found.leader.sites
    if found.placed or found.kind != NAMED:
        return own
    each = zip(own, *(sites for sites, _ in found.elsewhere), strict=True)
    return tuple(one[0] if len(set(one)) == 1 else _any_of(one) for one in each)


def _any_of(sites: Sequence[Site]) -> Site:
    ids = tuple(sorted({i for one in sites for i in one.ids}))
    return Site(sites[0].kind, ids, None, f"between two of nodes {', '.join(map(str, ids))}")


def elsewhere(found: Elsewhere) -> list[dict[str, Any]]:
    """Rival sites with the probability of each, given the physics."""
    return [{"sites": [site(each) for each in sites], "probability": p} for sites, p in found]


def shared(found: SharedPlace | None) -> dict[str, Any]:
    """What rival sites have in common."""
    found = found or SharedPlace()
    extents = {axis: (low, high) for axis, low, high in found.extents}
    return {axis: extents.get(axis) for axis in "xyz"} | {"nodes": list(found.nodes)}


def rest(found: Rest | None) -> dict[str, Any] | None:
    """What remains unexplained beside what is named."""
    return None if found is None else {"share": found.share, "p": found.p, "there": found.there}


def field(found: Field | None) -> dict[str, Any] | None:
    """Physics without a name along the structure."""
    if found is None:
        return None
    return {
        "property": found.property,
        "sites": [site(each.site) | {"value": each.value, "sd": each.sd} for each in found.values],
        "spread": found.spread,
        "length": found.length if isfinite(found.length) else None,
        "unit": found.unit,
        "log_evidence_over_named": found.log_evidence_over_named,
        "held_out": None if found.held_out is None else held_out(found.held_out),
        "beside": field(found.beside),
    }


def untried(found: Sequence[Untried]) -> list[dict[str, Any]]:
    """Candidates left out, each with its reason."""
    return [{"physics": each.physics, "reason": each.reason} for each in found]


def site(place: Site) -> dict[str, Any]:
    """A site; ids as decks write them."""
    ids = [dof_name(i) if isinstance(i, str) else i for i in place.ids]
    text = place.text or (EVERYWHERE.text if place.kind == EVERYWHERE.kind else "")
    return {"kind": place.kind, "ids": ids, "position": place.position, "text": text}


def held_out(held: HeldOut) -> dict[str, Any]:
    """Data kept from the fits, and how either model predicts them."""
    return {
        **fields(held, "kind", "labels", "measured_hz"),
        "baseline": score(held.baseline),
        "revised": None if held.revised is None else score(held.revised),
    }


def score(found: Score) -> dict[str, Any]:
    """How well data that no fit has seen were predicted."""
    return {
        **fields(found, "rms_frequency_error", "log_predictive_density", "covered"),
        "hz": found.frequencies_hz,
        **fields(found, "sd_hz", "mac", "rms_shape_error"),
    }
