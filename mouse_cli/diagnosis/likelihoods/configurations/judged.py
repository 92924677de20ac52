"""All explanations of what changed judged by the same errors of theory: those of the model with what leads in it.

By how much theory errs in shapes depends on the shapes; where each explanation brought its own errors, one that changes the modes
more would predict less sharply, and lose for that alone.
"""

from dataclasses import replace

from mouse_cli.diagnosis.likelihoods.configurations.model import Together
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors
from mouse_cli.diagnosis.search.fit import Fit, fit
from mouse_cli.diagnosis.search.rank import Ranking, ranking


def by_leading(found: Ranking) -> Ranking:
    """A ranking of arrangements, judged so; itself where no model is that of several, or nothing leads."""
    base = found.baseline.model.base
    missing = [one for one in found.fits if one.recipes]
    if not base.errors.alike or not missing:
        return found
    best = max(missing, key=lambda one: one.log_evidence + one.data.slack)
    modes = best.model.modes(best.point)
    if modes is None:
        return found
    errors = Errors(modes, base.common_sd)
    rest = [one for one in found.fits if one is not found.baseline]
    baseline, *others = (_judged(one, errors) for one in (found.baseline, *rest))
    return found if baseline is None else ranking(baseline, [baseline, *(one for one in others if one is not None)])


def _judged(one: Fit, errors: Errors) -> Fit | None:
    """A fit by other errors; its evidence at further places is as much more than its own as it was."""
    base = replace(one.model.base, erring=errors, slack=0.0)
    found = fit(Together(base, one.recipes), one.c, one.point.x[: one.model.k])
    if found is None:
        return None
    more = one.log_evidence - one.by_itself
    kept = {"elsewhere": one.elsewhere, "variants": one.variants, "taken": one.taken}
    return replace(found, log_evidence=found.log_evidence + more, **kept)
