"""The page of a trial: counts, calibration, sites, held-out data, and every wrong answer."""

from collections import Counter
from collections.abc import Callable

import numpy as np

from benchmarks.trials.calibration import calibration_error, table
from benchmarks.trials.case import NEAR, REGION
from benchmarks.trials.draw import FELT
from benchmarks.trials.kinds import CLASSES
from benchmarks.trials.scoring import MEANT, MISPLACED, MISSED, OUTCOMES, REFUSED, WRONG, Scored
from benchmarks.trials.seal import Seal
from benchmarks.trials.test_data import QUALITIES

_RULE_OF_THREE = 0.05  # 1 - confidence of the bound beside counts of nothing


def page(results: list[Scored], seals: list[Seal]) -> str:
    """Markdown of one trial or of several together."""
    parts = [
        "# Blind trials\n",
        _head(results, seals),
        "## Answers\n",
        _counts("class", results, lambda one: one.truth["class"], CLASSES),
        _counts("class, quality", results, _class_and_quality, [f"{c}, {q}" for c in CLASSES for q in QUALITIES]),
        _counts("structure", results, lambda one: one.truth["family"]),
        _alarms(results),
        "## Calibration\n",
        _calibration(results),
        "## Sites\n",
        _sites(results),
        "## Outside of the library\n",
        _outside(results),
        "## Held-out data and cost\n",
        _held(results),
        "## Wrong answers\n",
        _listed(results, (WRONG, MISPLACED)),
        "## Missed and refused\n",
        _listed(results, (MISSED, REFUSED)),
        "## By kind\n",
        _counts("kind", results, lambda one: f"{one.truth['class']}: {one.truth['family']}, {one.truth['what']}"),
    ]
    return "\n".join(part for part in parts if part)


def _head(results: list[Scored], seals: list[Seal]) -> str:
    made = "; ".join(
        f"{seal.cases} from {'a seed that was withheld' if seal.seed is None else f'seed {seal.seed}'} (SHA-256 `{seal.truths}`, "
        f"salt `{seal.salt}`)"
        for seal in seals
    )
    qualities = "; ".join(
        f"{key}: {q.sensors} sensors, {100 * q.frequency_sd:g} % of frequencies, {100 * q.shape_sd:g} % of shapes"
        for key, q in QUALITIES.items()
    )
    return (
        "`python -m benchmarks.trials` made decks whose truths mouse did not compute, and sealed the truths before `mouse "
        f"diagnose` saw a deck: {made}. {len(results)} decks have an answer.\n\n"
        f"Qualities: {qualities}. A right answer names all mechanisms within {100 * NEAR:g} % of the span. Cases were taken only "
        "if a model without one of the mechanisms, its parameters fitted to frequencies and shapes without noise, misses them by a "
        f"chi-square above {FELT:g}.\n"
    )


def _counts(title: str, results: list[Scored], key: Callable[[Scored], str], order: object = ()) -> str:
    """A row for each value of `key`, a column for each outcome."""
    values = [*order, *sorted({key(one) for one in results} - set(order))]
    lines = [f"| {title} | " + " | ".join(OUTCOMES) + " | all |", "|---" * (len(OUTCOMES) + 2) + "|"]
    for value in [*values, "all"]:
        own = [one for one in results if value == "all" or key(one) == value]
        count = Counter(one.outcome for one in own)
        lines += [f"| {value} | " + " | ".join(str(count[o]) for o in OUTCOMES) + f" | {len(own)} |"] if own else []
    return "\n".join(lines) + "\n"


def _class_and_quality(one: Scored) -> str:
    return f"{one.truth['class']}, {one.truth['quality']}"


def _alarms(results: list[Scored]) -> str:
    """Controls with an alarm, and with a name."""
    lines = []
    for title, errors in (("Controls", False), ("Controls whose noise is misstated", True)):
        own = [one for one in results if not one.truth["mechanisms"] and bool(one.truth["error"]) == errors]
        if own:
            alarms, names = sum(one.alarm for one in own), sum(one.outcome == WRONG for one in own)
            bound = 100 * (1 - _RULE_OF_THREE ** (1 / len(own)))
            lines.append(
                f"{title}: {alarms} of {len(own)} with an alarm (anything but nothing missing, or one of several with none "
                f"among them), {names} with a name; no alarm at all would bound the rate at {bound:.1f} %, 95 %.\n"
            )
    named = [one for one in results if np.isfinite(one.probability)]
    wrong = sum(one.outcome in (WRONG, MISPLACED) for one in named)
    suspected = Counter((one.truth["error"] or "none", one.suspected) for one in results if one.suspected)
    pairs = ", ".join(f"{said} where there was {error}: {n}" for (error, said), n in suspected.most_common())
    lines += [f"Errors of the test that answers suspect: {pairs}.\n"] if pairs else []
    return "\n".join([*lines, f"Of {len(named)} names, {wrong} were wrong or misplaced.\n"])


def _calibration(results: list[Scored]) -> str:
    """Of names, and of the rivals of a one-of."""
    named = [(one.probability, one.true) for one in results if np.isfinite(one.probability)]
    inside = [
        (one.probability, one.true)
        for one in results
        if np.isfinite(one.probability) and one.truth["class"] != "outside"
    ]
    complete = [(one.alone, one.complete) for one in results if np.isfinite(one.probability)]
    rivals = [pair for one in results for pair in one.rivals]
    parts = []
    for title, pairs in (
        ("Names: what is named is missing", named),
        ("Names, without truths outside of the library", inside),
        ("Names: nothing else is missing, as likely as nothing is beside what is named", complete),
        ("Rivals of a one-of", rivals),
    ):
        p, true = np.array([x for x, _ in pairs], dtype=float), np.array([y for _, y in pairs], dtype=float)
        error = (
            f": expected calibration error {calibration_error(p, true):.3f}, {len(pairs)} probabilities"
            if pairs
            else ""
        )
        parts += [f"{title}{error}.\n", table(pairs) + "\n"]
    return "\n".join(parts)


def _sites(results: list[Scored]) -> str:
    """Errors of the sites of what was named truly."""
    errors = 100 * np.array([one.error for one in results if np.isfinite(one.error)])
    if not len(errors):
        return "Nothing that acts at a site was named truly.\n"
    return (
        f"Error of the site over the span, of what was named truly: median {np.median(errors):.2f} %, "
        f"95 % quantile {np.quantile(errors, 0.95):.2f} %, largest {errors.max():.2f} % ({len(errors)} answers).\n"
    )


def _outside(results: list[Scored]) -> str:
    """What was said of physics that the library does not have."""
    own = [one for one in results if one.truth["class"] == "outside"]
    kinds = Counter("named" if np.isfinite(one.probability) else one.said.split()[0].strip(",") for one in own)
    share = lambda i: [one.field[i] for one in own if one.field[i] is not None]
    counts = ", ".join(f"{kind} {n}" for kind, n in kinds.most_common())
    gains = [one for one in own if one.gain]
    missed = [one for one in gains if one.gain[0] > 2 * 100 * QUALITIES[one.truth["quality"]].frequency_sd]
    halved = lambda some: f"{sum(one.gain[1] <= one.gain[0] / 2 for one in some)} of {len(some)}"
    accepted = sorted(
        {f"{name} for {m['kind']}" for one in own for m in one.truth["mechanisms"] for name, _ in m["also"]}
    )
    meant = ", ".join(f"{name} for {kind}" for kind, name in sorted(MEANT.items()))
    names = f" Names accepted as true, declared beforehand: {', '.join(accepted)}." if accepted else ""
    return (
        f"{len(own)} decks: {counts or 'none'}. Of fields without a name, {sum(share(0))} of {len(share(0))} have a property "
        f"of what is missing, {sum(share(1))} of {len(share(1))} are largest within {100 * REGION:g} % of the span of where it "
        f"acts most. What was held out is predicted with at most half of the error in {halved(gains)}, by the answer's "
        f"model, named or not; in {halved(missed)} where the deck's model errs by more than twice the noise of a frequency, "
        f"half of which is noise by itself. Properties that are right because of what a truth is (what acts at one place by a law "
        f"that mouse leaves free, a force along bars): {meant}.{names}\n"
    )


def _held(results: list[Scored]) -> str:
    """Error on held-out frequencies, and processor time."""
    pairs = np.array([one.gain for one in results if one.gain and one.truth["held"]])
    seconds = np.array([one.seconds for one in results])
    time = f"Processor time for a diagnosis: median {np.median(seconds):.1f} s, largest {seconds.max():.1f} s.\n"
    if not len(pairs):
        return "No answer was checked on held-out frequencies.\n\n" + time
    before, after = np.median(pairs, axis=0)
    better = int((pairs[:, 1] < pairs[:, 0]).sum())
    error = f"median rms error {before:.2f} % before, {after:.2f} % after; lower in {better} of {len(pairs)}"
    return f"Held-out frequencies: {error}.\n\n{time}"


def _listed(results: list[Scored], outcomes: tuple[str, ...]) -> str:
    """Every answer with one of `outcomes`."""
    own = [one for one in results if one.outcome in outcomes]
    if not own:
        return "None.\n"
    lines = ["| deck | truth | quality | answer | outcome | chi-square left |", "|---|---|---|---|---|---|"]
    for one in sorted(own, key=lambda one: (one.truth["class"], one.name)):
        truth = one.truth
        what = f"{truth['class']}: {truth['family']}, {truth['what']}" + _places(truth)
        said = one.said.replace("|", "/")
        lines.append(f"| {one.name} | {what} | {truth['quality']} | {said} | {one.outcome} | {one.trial.felt:.0f} |")
    note = (
        "Chi-square left: what the least of the mechanisms leaves to a model without it whose parameters were fitted."
    )
    return "\n".join(lines) + f"\n\n{note}\n"


def _places(truth: dict) -> str:
    """Sites of the truth, in words."""
    at = [one["at"] for one in truth["mechanisms"] if one["at"] is not None]
    return " at " + ", ".join(f"({p[0]:.3g}, {p[1]:.3g})" for p in at) if at else ""
