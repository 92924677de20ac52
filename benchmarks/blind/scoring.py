"""Answers of the tool against the truth: confusion, places, reliability, false alarms, gains on held-out data, times."""

from collections import Counter, defaultdict
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

RIGHT, WRONG, ABSTAINED, MISSED, REFUSED = "right", "wrong", "abstained", "missed", "refused"
OUTCOMES = (RIGHT, WRONG, ABSTAINED, MISSED, REFUSED)
NEAR = 0.05  # of the span
BINS = (0.0, 0.5, 0.7, 0.8, 0.9, 0.97, 1.0)
Z90 = 1.645  # sd on either side of 90 % of a normal density
RULE_OF_THREE = 0.05  # 1 - confidence of the bound beside counts of nothing


@dataclass(frozen=True)
class Scored:
    """One deck. said: group or kind; error: of the place, by span, nan without one; probability: of the group that leads.

    misstated: error of the test that was suspected. sizes: true value, that told and its sd, of those that the answer knows.
    """

    answer: dict
    outcome: str
    said: str
    error: float
    probability: float
    leads: bool
    seconds: float
    gains: dict[str, tuple[float, float]]
    misstated: str = ""
    sizes: tuple[tuple[float, float, float], ...] = ()


def scored(answer: dict, found: dict) -> Scored:
    """`answer` of decks.answer beside `found` of `mouse diagnose --json`."""
    if "refused" in found:
        return Scored(answer, REFUSED, REFUSED, np.nan, np.nan, False, found["seconds"], {})
    verdict = found["verdict"]
    groups = named(verdict)
    places = [site["position"] for site in verdict["sites"] if site["position"]]
    error = _error(answer, places)
    kind = verdict["kind"]
    said = " + ".join(groups) if kind == "named" else kind
    leads = _same(answer, groups)
    probability = float(verdict.get("probability") or np.nan)
    return Scored(
        answer,
        _outcome(answer, kind, leads, _near(answer, verdict["sites"], error)),
        said,
        error,
        probability,
        leads,
        found["seconds"],
        _gains(found),
        found.get("misstated") or "",
        _sizes(answer, found),
    )


def named(verdict: dict) -> list[str]:
    """Groups that a verdict leads with."""
    group = verdict.get("group") or ""
    return sorted(part for part in group.split(" + ") if part not in ("", "none"))


def _same(answer: dict, groups: list[str]) -> bool:
    """Whether the groups are those of the truth, but for such as may be named besides."""
    extra, missing = Counter(groups) - Counter(answer["groups"]), Counter(answer["groups"]) - Counter(groups)
    return bool(groups) and not missing and set(extra) <= set(answer["tolerated"])


def _outcome(answer: dict, kind: str, leads: bool, near: bool) -> str:
    if kind == "nothing-missing":
        return RIGHT if not answer["groups"] and not answer["outside"] else MISSED
    if kind in ("one-of", "unknown"):
        return RIGHT if answer["outside"] else ABSTAINED
    return RIGHT if leads and near else WRONG


def _near(answer: dict, sites: list[dict], error: float) -> bool:
    """Whether causes are where they were said to be: between the same nodes, or two of several, or as near as matters."""
    if answer.get("ends"):
        return all(any(set(pair) <= set(site["ids"]) for site in sites) for pair in answer["ends"])
    return not answer["places"] or not np.isfinite(error) or error <= NEAR


def _error(answer: dict, places: list[list[float]]) -> float:
    """The largest distance from a true place to the nearest of those said, by span; nan where none was said or is true."""
    if not answer["places"] or not places:
        return np.nan
    gaps = [min(np.linalg.norm(np.subtract(p, true)) for p in places) for true in answer["places"]]
    return float(max(gaps) / answer["span"])


def _sizes(answer: dict, found: dict) -> tuple[tuple[float, float, float], ...]:
    """By the first explanation that has a size of that name."""
    told = []
    for name, true in answer.get("sizes", {}).items():
        own = (p for each in found["candidates"] for p in each["parameters"] if p["name"] == name)
        told += [(true, p["value"], p["sd"]) for p in [next(own, None)] if p]
    return tuple(told)


def _gains(found: dict) -> dict[str, tuple[float, float]]:
    """Error of the updated baseline and of the extended model, %, on modes held out and on the altered configuration."""
    held = found.get("held_out") or {}
    before, after = held.get("baseline"), held.get("revised")
    if not before or not after:
        return {}
    measured = np.array(held["measured_hz"], dtype=float)
    altered = np.array(["mass added" in label for label in held["labels"]])
    rms = lambda score, own: float(
        100 * np.sqrt(np.mean((np.array(score["hz"], dtype=float)[own] / measured[own] - 1) ** 2))
    )
    parts = {"next modes": ~altered, "mass added": altered}
    return {name: (rms(before, own), rms(after, own)) for name, own in parts.items() if own.any()}


def tables(results: list[Scored]) -> str:
    """All tables, as text."""
    parts = [
        confusion(results),
        locations(results),
        sizes(results),
        reliability(results),
        alarms(results),
        gains(results),
        times(results),
    ]
    return "\n\n".join(part for part in parts if part)


def confusion(results: list[Scored]) -> str:
    """Truth by answer, and what was said instead."""
    lines = [f"{'truth':26}" + "".join(f"{o:>11}" for o in OUTCOMES) + "   said"]
    rows: dict[str, list[Scored]] = defaultdict(list)
    for one in results:
        rows[f"{one.answer['kind']}: {one.answer['truth']}"].append(one)
    for truth, members in rows.items():
        lines.append(_row(truth, members) + "   " + _said(members))
    faults = [one for one in results if one.answer["groups"]]
    for title, members in (
        ("all that have a name", faults),
        ("no name: " + "controls, outside", _rest(results, faults)),
    ):
        if members:
            lines.append(_row(title, members))
    return "\n".join(lines)


def _rest(results: list[Scored], faults: list[Scored]) -> list[Scored]:
    return [one for one in results if one not in faults]


def _row(title: str, members: list[Scored]) -> str:
    count = Counter(one.outcome for one in members)
    return f"{title:26.26}" + "".join(f"{count[o]:>11}" for o in OUTCOMES)


def _said(members: list[Scored]) -> str:
    return ", ".join(f"{said} {n}" for said, n in Counter(one.said for one in members).most_common())


def locations(results: list[Scored]) -> str:
    """Errors of the places of what was named rightly in group."""
    errors = [
        one.error for one in results if one.leads and one.said not in ("one-of", "unknown") and np.isfinite(one.error)
    ]
    if not errors:
        return ""
    return (
        f"place of what was named, % of the span: median {100 * np.median(errors):.2f}, "
        f"95 % {100 * np.quantile(errors, 0.95):.2f} ({len(errors)} cases)"
    )


def sizes(results: list[Scored]) -> str:
    """Errors of sizes by their sd, and sd by the size, of what was named rightly in group."""
    known = [size for one in results if one.outcome == RIGHT for size in one.sizes]
    if not known:
        return ""
    true, told, sd = np.array(known).T
    z = (told - true) / sd
    within = [f"{(np.abs(z) < limit).sum()} within {limit:g} sd" for limit in (Z90, 3.0)]
    return (
        f"sizes of {len(z)}: {', '.join(within)}, mean of errors {z.mean():.2f} sd, their rms {np.sqrt(np.mean(z**2)):.2f} sd; "
        f"largest sd {100 * (sd / told).max():.1f} % of the size"
    )


def reliability(results: list[Scored]) -> str:
    """How often the leading group was right, by the probability stated for it; truths inside the library only."""
    asked = [
        one
        for one in results
        if one.answer["groups"] and np.isfinite(one.probability) and one.said != "nothing-missing"
    ]
    lines = [f"{'stated':12}{'right':>8}{'of':>6}"]
    for low, high in pairwise(BINS):
        own = [one for one in asked if low <= one.probability < high or (high == 1.0 and one.probability == 1.0)]
        if own:
            lines.append(f"{low:.2f}-{high:.2f}   {sum(one.leads for one in own):>8}{len(own):>6}")
    return "\n".join(lines) if len(lines) > 1 else ""


def alarms(results: list[Scored]) -> str:
    """Controls that were not said to lack nothing, and those for which a cause was named."""
    controls = [one for one in results if not one.answer["groups"] and not one.answer["outside"]]
    if not controls:
        return ""
    alarmed = sum(one.said != "nothing-missing" for one in controls)
    false = sum(one.outcome == WRONG for one in controls)
    bound = 1 - RULE_OF_THREE ** (1 / len(controls))
    errors = Counter(one.misstated for one in controls if one.misstated).most_common()
    suspected = "".join(f"; {key} suspected in {n}" for key, n in errors)
    return (
        f"controls: {alarmed} of {len(controls)} not said to lack nothing, {false} given a name "
        f"(none at all would bound the rate at {100 * bound:.1f} %, 95 %){suspected}"
    )


def gains(results: list[Scored]) -> str:
    """Median error on held-out data, baseline updated and extended, and in how many cases it fell."""
    lines = [f"{'held out, rms %':26}{'next modes':>24}{'mass added':>24}"]
    rows: dict[str, list[Scored]] = defaultdict(list)
    for one in results:
        if one.gains:
            rows[f"{one.answer['kind']}: {one.answer['truth']}"].append(one)
    for truth, members in rows.items():
        cells = []
        for part in ("next modes", "mass added"):
            pairs = np.array([one.gains[part] for one in members if part in one.gains])
            if not len(pairs):
                cells.append(f"{'':>24}")
                continue
            before, after = np.median(pairs, axis=0)
            cells.append(f"{before:>8.2f} -> {after:<5.2f}{(pairs[:, 1] < pairs[:, 0]).sum():>3}/{len(pairs):<3}")
        lines.append(f"{truth:26.26}" + "".join(f"{cell:>24}" for cell in cells))
    return "\n".join(lines) if len(lines) > 1 else ""


def times(results: list[Scored]) -> str:
    """Processor seconds of the diagnoses, start of the program included."""
    seconds = [one.seconds for one in results]
    return (
        f"processor seconds for a diagnosis: median {np.median(seconds):.1f}, largest {max(seconds):.1f}"
        if seconds
        else ""
    )
