"""One answer beside its truth, by rules that were fixed before any answer was seen."""

from collections import Counter
from dataclasses import dataclass, field
from itertools import permutations

import numpy as np

from benchmarks.trials.case import REGION
from benchmarks.trials.draw import Trial

RIGHT, PART, MISPLACED, WRONG, ABSTAINED, MISSED, REFUSED = OUTCOMES = (
    "right",  # all mechanisms named, at their sites; of a control: nothing is missing
    "part",  # all that is named is true and at its site, but not all is named
    "misplaced",  # all that is named is true, but not at its site
    "wrong",  # something is named that is not missing
    "abstained",  # one of several, or unknown
    "missed",  # nothing is missing, it says
    "refused",  # no answer
)
ALIKE = {"compliance": "force"}  # changes of rank one, a force in truths whatever its sign
MEANT = {  # by what a truth is, besides its declared properties: at one place a law is free; a force along bars is axial
    "elastomer mount": "law",
    "attached beam": "law",
    "outrigger": "law",
    "support softened by amplitude": "law",
    "gradient of axial force": "axial",
}
IGNORED = {"gains": "sensor"}  # groups that describe an error of the test that the deck does not state


@dataclass(frozen=True)
class Scored:
    """One deck. said: in words; error: of the sites of what was named truly, over the span, nan without one.

    alarm: on a control, anything but nothing missing, or one of several with none among them; probability: that of the name, `true`
    whether all of its groups are missing; alone: that nothing else is, `complete` whether that is so; rivals: (probability,
    whether true) of each group of a one-of; field: of physics without a name, (property right, region right), None where not
    scored; gain: rms error of held-out frequencies in %, of the baseline and of the revised model; suspected: error of the test
    that the answer suspects.
    """

    name: str
    trial: Trial
    outcome: str
    said: str
    seconds: float
    error: float = np.nan
    alarm: bool = False
    probability: float = np.nan
    true: bool = False
    alone: float = np.nan
    complete: bool = False
    rivals: list[tuple[float, bool]] = field(default_factory=list)
    field: tuple[bool | None, bool | None] = (None, None)
    gain: tuple[float, float] | None = None
    suspected: str = ""

    @property
    def truth(self) -> dict:
        """As sealed."""
        return self.trial.truth()


def scored(name: str, trial: Trial, document: dict) -> Scored:
    """`document` of `mouse diagnose --json`, or {refused, seconds}."""
    seconds = float(document["seconds"])
    if "refused" in document:
        last = (document["refused"].splitlines() or ["no answer"])[-1]
        return Scored(name, trial, REFUSED, f"refused: {last}"[:160], seconds)
    verdict, truth = document["verdict"], trial.truth()
    kind, told = verdict["kind"], _told(verdict, truth)
    outcome, error = _named(told, truth) if kind == "named" else (_unnamed(kind, truth), np.nan)
    quiet = kind == "nothing-missing" or (kind == "one-of" and "none" in verdict.get("rivals", []))
    return Scored(
        name,
        trial,
        outcome,
        _said(verdict),
        seconds,
        error,
        alarm=not truth["mechanisms"] and not quiet and bool(told or kind == "unknown"),
        probability=float(verdict["probability"] or np.nan) if kind == "named" else np.nan,
        true=_missing([group for _, group, _ in told], truth),
        alone=_alone(verdict) if kind == "named" else np.nan,
        complete=_complete([group for _, group, _ in told], truth),
        rivals=_rivals(document, truth) if kind == "one-of" else [],
        field=_field(verdict, truth) if kind == "unknown" else (None, None),
        gain=_gain(document),
        suspected=document.get("misstated") or "",
    )


Told = list[tuple[str, str, tuple[float, ...] | None]]  # physics, group, place


def _told(verdict: dict, truth: dict) -> Told:
    """What a verdict names or leads with, without what describes an error of the test."""
    split = lambda key: [part for part in (verdict.get(key) or "").split(" + ") if part not in ("", "none")]
    places = [_places(site, truth) for site in verdict.get("sites") or []]
    physics, groups = split("physics"), split("group")
    at = groups.index("support") if "support" in groups else 0  # which counts once in a group, at however many supports
    groups[at:at] = groups[at : at + 1] * (len(physics) - len(groups))
    found = [(name, group, at) for name, group, own in zip(physics, groups, places, strict=False) for at in own]
    return [one for one in found if one[1] != IGNORED.get(truth["error"])]


def _places(site: dict, truth: dict) -> list[tuple[float, ...] | None]:
    """The place of a site; of several nodes each, for that all of them are alike names every one."""
    each = [place(site | {"ids": [i], "position": None}, truth) for i in site.get("ids") or []]
    several = site.get("kind") == "node" and len(each) > 1 and not site.get("position") and None not in each
    return each if several else [place(site, truth)]


def place(site: dict, truth: dict) -> tuple[float, ...] | None:
    """Coordinates of a site: its own, else the mean of those of its nodes or elements."""
    if site.get("position"):
        return tuple(site["position"])
    book = truth["elements"] if site.get("kind") == "element" else truth["nodes"]
    own = [book[key] for key in (str(i).rstrip("TRXYZ-") for i in site.get("ids") or []) if key in book]
    return tuple(np.mean(own, axis=0)) if own and site.get("kind") != "sensor" else None


def _is(one: tuple[str, str, object], mechanism: dict) -> bool:
    """Whether a name is that of a mechanism, its group, or declared to be as true."""
    physics, group = one[0], one[1]
    names = [(mechanism["physics"], mechanism["group"]), *mechanism["also"]]
    return any(own and (physics == own or group == its) for own, its in names)


def _gap(one: tuple[str, str, tuple[float, ...] | None], mechanism: dict) -> float:
    """Distance of a site from the true one in m; 0 where the mechanism acts everywhere."""
    if mechanism["at"] is None:
        return 0.0
    return float(np.hypot(*np.subtract(one[2][:2], mechanism["at"][:2]))) if one[2] else np.inf


def _named(told: Told, truth: dict) -> tuple[str, float]:
    """Outcome of a name, and the largest error of its sites over the span, of what is named truly and acts at a place."""
    mechanisms = truth["mechanisms"]
    if not told:  # nothing but an error of the test
        return (MISSED if mechanisms else RIGHT), np.nan
    ways = [
        list(zip(told, order, strict=True))
        for order in permutations(mechanisms, len(told))
        if all(_is(one, own) for one, own in zip(told, order, strict=True))
    ]
    if not ways:
        return WRONG, np.nan
    excess = lambda way: max(_gap(one, own) - own["reach"] for one, own in way)
    best = min(ways, key=excess)
    local = lambda own: own["at"] is not None and own["reach"] <= REGION * truth["span"]
    gaps = [_gap(one, own) / truth["span"] for one, own in best if local(own)]
    outcome = MISPLACED if any(own["at"] and _gap(one, own) > own["reach"] for one, own in best) else RIGHT
    if outcome == RIGHT and len(told) < len(mechanisms):
        outcome = PART
    return outcome, float(max(gaps)) if gaps and np.isfinite(gaps).all() else np.nan


def _unnamed(kind: str, truth: dict) -> str:
    if kind == "nothing-missing":
        return MISSED if truth["mechanisms"] else RIGHT
    return ABSTAINED


def _complete(groups: list[str], truth: dict) -> bool:
    """Whether groups are those of all mechanisms, no more and no less."""
    return len(groups) == len(truth["mechanisms"]) and _missing(groups, truth)


def _alone(verdict: dict) -> float:
    """Probability that what is named is all that is missing: that of the name, and of nothing beside it where that is open."""
    beside = {one["group"]: one["probability"] for one in verdict.get("companions") or []}
    return float(verdict["probability"]) * (beside.get("none", 0.0) if beside else 1.0)


def _missing(groups: list[str], truth: dict) -> bool:
    """Whether groups are of mechanisms that are there, each one once."""
    mechanisms = truth["mechanisms"]
    if not groups:
        return not mechanisms
    return any(
        all(_is(("", g, None), own) for g, own in zip(groups, order, strict=True))
        for order in permutations(mechanisms, len(groups))
    )


def _rivals(document: dict, truth: dict) -> list[tuple[float, bool]]:
    """Probability of each group that a one-of leaves, and whether it is true; `none` is true where nothing is missing."""
    verdict = document["verdict"]
    left = {verdict.get("group"), *verdict.get("rivals", [])}
    parts = lambda group: [part for part in group.split(" + ") if part not in ("", "none", IGNORED.get(truth["error"]))]
    return [
        (float(one["probability"]), _complete(parts(one["group"]), truth))
        for one in document.get("groups", [])
        if one["group"] in left
    ]


def _field(verdict: dict, truth: dict) -> tuple[bool | None, bool | None]:
    """Whether a field without a name has a property of the true mechanisms, and is largest within REGION of where they act most."""
    found, mechanisms = verdict.get("field"), truth["mechanisms"]
    properties = {name for own in mechanisms for name in (*own["properties"], *filter(None, [MEANT.get(own["kind"])]))}
    if not found or not properties:
        return None, None
    right = ALIKE.get(found["property"], found["property"]) in properties
    boxes = [box for own in mechanisms for box in own["regions"]]
    largest = max(found["sites"], key=lambda one: abs(one["value"]), default=None)
    if not boxes or largest is None:
        return right, None
    own = [str(i).rstrip("TRXYZ-") for i in largest["ids"]]
    book = truth["elements"] if any(i in truth["elements"] for i in own) else truth["nodes"]
    at = np.mean([book[i][:2] for i in own if i in book] or [[np.inf, np.inf]], axis=0)
    gaps = [
        np.hypot(*(at - np.clip(at, np.minimum(low, high), np.maximum(low, high))))
        for low, high in np.array(boxes)[..., :2]
    ]
    return right, bool(min(gaps) <= REGION * truth["span"])


def _gain(document: dict) -> tuple[float, float] | None:
    """rms error in % of frequencies held out, before and after, by the model of the answer: without a name that of the field."""
    field = document["verdict"].get("field") or {}
    held = field.get("held_out") or document.get("held_out") or {}
    before, after = held.get("baseline"), held.get("revised")
    if not before or not after:
        return None
    measured = np.array(held["measured_hz"], dtype=float)
    rms = lambda score: float(100 * np.sqrt(np.mean((np.array(score["hz"], dtype=float) / measured - 1) ** 2)))
    return rms(before), rms(after)


def _said(verdict: dict) -> str:
    """A verdict in a line."""
    kind, where = verdict["kind"], "; ".join(site["text"] for site in verdict.get("sites") or [])
    if kind == "named":
        return f"{verdict['physics']} ({where}), probability {verdict['probability']:.3f}"
    if kind == "one-of":
        return f"one of {', '.join(Counter([verdict['group'] or '', *verdict.get('rivals', [])]))}"
    field = verdict.get("field")
    return f"unknown, a field of {field['property']}" if field else kind
