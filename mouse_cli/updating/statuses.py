"""How a run can end: one sentence that says it, one that says what to do. Keyed by the way of ending; two may share a status."""

from dataclasses import replace

from mouse_cli.model.result import NO_ANSWER, UNTRUSTED, Status

STATUSES = {
    "passed": Status("converged", "Converged: the model meets the test within its confidence limits."),
    "stationary": Status("converged", "Converged: no further step along the partial derivatives changes the answer."),
    "exceeded": Status(
        "not-converged",
        "Not converged: all {cycles} computations of the partial derivatives are used up; outside their confidence limits: "
        "{exceedances} of {data} data ({allowed} allowed).",
        "Allow more partials (NPARD), or check the data marked *: one wrong datum is enough, and many contradict the form "
        "of the model.",
        UNTRUSTED,
    ),
    "restless": Status(
        "not-converged",
        "Not converged: all {cycles} computations of the partial derivatives are used up and the steps are not yet negligible.",
        "Allow more partials.",
        UNTRUSTED,
    ),
    "stalled": Status(
        "stalled",
        "Stalled: further cycles change nothing, yet there are data outside their confidence limits: {exceedances} of {data} "
        "({allowed} allowed).",
        "The recursion is at its limit point; no revision of these properties fits better. Check the accuracies and the data "
        "marked *, or the form of the model.",
        UNTRUSTED,
    ),
    "no-descent": Status(
        "no-descent",
        "Stopped: no step along the partial derivatives improves the fit any more, and the mode is not reached.",
        "Check for mode shapes that swap order (pairing) and for data that contradict each other.",
        UNTRUSTED,
    ),
    "diverged": Status(
        "diverged",
        "Diverged: the misfit grew from cycle to cycle ({chi2_first:.4g} to {chi2_last:.4g}).",
        "The perturbation exceeds the linear range: use --recursion anchored, --step second-order, or limits.",
        UNTRUSTED,
    ),
    "indefinite": Status(
        "indefinite",
        "Stopped in cycle {cycle}: the revision makes the model unphysical ({reason}); the results are those of the last good "
        "cycle.",
        "A stiffness or mass was driven negative: the model form may be wrong (see the tests); or use --recursion anchored, "
        "limits, or transform: log.",
        NO_ANSWER,
    ),
    "impossible": Status(
        "impossible",
        "Stopped at values that cannot be: {reason}.",
        "The data pull the property to nothing to compensate for missing physics: use `mouse diagnose`, check units "
        "and supports. transform: log or limits keep it positive; more partials do not help.",
        UNTRUSTED,
    ),
    "unobservable": Status(
        "unobservable",
        "No answer: {reason}; undetermined: {names}.",
        "Measure more, hold those properties (sd 0), or use the Bayes estimator, which keeps the prior where the data are silent.",
        NO_ANSWER,
        answered=False,
    ),
    "infeasible": Status("infeasible", "No answer: {reason}.", "Widen the limits.", NO_ANSWER, answered=False),
}


def status(ending: str, **facts: object) -> Status:
    """The status of that `ending` with its sentence filled in."""
    template = STATUSES[ending]
    return replace(template, sentence=template.sentence.format(**facts))
