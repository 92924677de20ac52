"""What an answer stands or falls with, in sentences: accuracy of the test, held-out data, the place that shapes point to."""

from collections.abc import Iterable, Iterator
from math import sqrt

import numpy as np

from mouse_cli.diagnosis.effects.element_sets import text
from mouse_cli.diagnosis.explained import acting
from mouse_cli.diagnosis.gates import GATE, beyond
from mouse_cli.diagnosis.likelihoods.modal.accuracy import Doubt, scatter
from mouse_cli.diagnosis.likelihoods.modal.mixed import mixed
from mouse_cli.diagnosis.likelihoods.modal.repeated import exchanged, repeated
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.noise import LOUD
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.grounded import one_tie
from mouse_cli.diagnosis.search.rank import NOISY, Ranking
from mouse_cli.diagnosis.verdict import Verdict, shifts
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, RIVAL, UNKNOWN, Location, Site
from mouse_cli.model.groups import enumerated
from mouse_cli.model.held import ElementGroup
from mouse_cli.updating.chi_square import upper_tail

_PROBABLE = 0.5  # of errors of the test from which on they are the finding
_FAR = 0.1  # of the span, between the place of a cause and the nearest one that shapes point to
_PLAIN = 0.05  # probability of a misfit as large as that of the best single place, from which on it may be the place
_SMALL = 0.2  # share of all places that the 90 % region may hold to point anywhere
_CHECK = "Check the value, or state a larger sd."
_LEADING = 8  # explanations, by their evidence, that are asked for a parameter that strains them
_AGAIN = 1.2  # times the stated scatter, up to which a test is as accurate as it says
_SCATTER = "scatter"  # error of the test: all of it scatters more than the deck says
_OFFSET = "offset"  # group of masses that are not at their nodes
_CERTAIN = ("is less accurate than stated in the deck", "has an error")  # of all entries of a kind, and of one mode
_POSSIBLE = ("may be less accurate than stated in the deck", "may have an error")
_TOLD = {
    "gains": "every sensor looks off by about {size:.1f} % of what it reads, in all modes alike: calibrate the sensors, or add "
    "that much of each component to shape_sd",
    "places": "every sensor appears misplaced by about {size:.2f} % of its row of bars: measure the sensor positions, "
    "or add the resulting shape error to shape_sd",
    "drift": "the frequencies look off by about {size:.2f} % each (temperature, amplitude, sensors moved between "
    "modes): repeat the test, or add that much to frequency_sd",
    "frequency": "the frequency of mode {modes} does not agree with all that agrees among the others: measure it again, or make "
    "it null; if it stays, the structure moves that mode alone",
    "mode": "mode {modes} is none that the structure can have beside the others: a false mode of the identification, of another "
    "part, or paired wrongly: check it, or leave it out",
}


def misstated(ranking: Ranking) -> str | None:
    """Key of the error that explains the data better than the accuracies of the deck do; None where those may be right."""
    found = _doubts(ranking) if ranking.noise_scale <= NOISY else []
    if sum(each.probability for each in found) > _PROBABLE:
        return found[0].key
    return _SCATTER if _scattered(ranking) else None


def _scattered(ranking: Ranking) -> bool:
    """Whether more scatter than stated explains the data as well as whatever has a name or none: no mechanism has ODDS over it, or
    it is more probable than all of them.
    """
    one, none = ranking.baseline, dict(ranking.groups).get("none", 0.0)
    leads = ranking.scattered or (none > _PROBABLE and ranking.noise_scale <= LOUD)
    return leads and upper_tail(one.misfit, one.dof) < GATE


def _doubts(ranking: Ranking) -> list[Doubt]:
    """Errors of the test that may be; of a mode with the shape of another one see `_repeated`."""
    alike = {mode for pair in repeated(ranking.baseline) for mode in pair}
    return [each for each in ranking.doubts if each.key != "mode" or not alike & set(each.modes)]


def cautions(ranking: Ranking, verdict: Verdict, location: Location | None) -> tuple[str, ...]:
    """The sentences, each whole; none where nothing is missing."""
    if verdict.kind == NOTHING:
        return ()
    table = *_exchanged(ranking), *_twice(ranking)
    doubted = *_repeated(ranking, verdict), *_errors(ranking, verdict), *_noise(ranking), *_narrow(ranking, verdict)
    named = *_tied(ranking, verdict), *_centres(verdict), *_refuted(verdict), *_elsewhere(verdict, location)
    return (*table, *verdict.reasons, *doubted, *named)


def _exchanged(ranking: Ranking) -> Iterator[str]:
    """Two columns of the table of shapes that stand in the other's place."""
    number = ranking.baseline.data.test.number
    for i, j in exchanged(ranking.baseline):
        yield (
            f"The shapes of modes {number[i]} and {number[j]} are each that of the other mode of the model, beside frequencies "
            "that are near their own: exchange the two columns of shapes if the table has them in the wrong order, and diagnose "
            "again. Nothing else that is said here holds before that is settled."
        )


def _twice(ranking: Ranking) -> Iterator[str]:
    """A mode that a table has twice."""
    number = ranking.baseline.data.test.number
    for i, j in repeated(ranking.baseline, twice=True):
        yield (
            f"Modes {number[i]} and {number[j]} have one shape at about one frequency, and the model has no such two modes: one "
            "mode was probably identified twice, and stands for an oscillator, or for something else with a mode of its own. Give "
            "it once, and diagnose again."
        )


def _repeated(ranking: Ranking, verdict: Verdict) -> Iterator[str]:
    """Modes with one shape at several frequencies, where nothing that was tried explains them."""
    pairs = repeated(ranking.baseline) if verdict.kind == UNKNOWN else []
    if not pairs:
        return
    number = ranking.baseline.data.test.number
    named = enumerated([f"{number[i]} with {number[j]}" for i, j in pairs])
    yield (
        f"Modes {named} share a shape at these sensors, at two frequencies, and no two modes of the model do. Unless one of two is "
        "a false mode of the identification, they differ in a motion that the sensors do not see and the model does not have: "
        "floors that turn because their masses are off their axes, motion along another axis, or something attached. Measure "
        "there, and give the model that motion."
    )


def _mixed(one: Fit, doubt: Doubt) -> str:
    """Of a mode that would be said to be false, and that the structure may have as its members scatter; empty: it may not."""
    found = mixed(one, doubt.modes) if doubt.key == "mode" else {}
    if not found:
        return ""
    (j, own), *_ = found.items()  # it is of one mode
    hz = enumerated([f"{f:.4g} Hz" for f in np.sqrt(one.point.eigenvalues[own]) / (2 * np.pi)])
    return (
        f"Mode {one.data.test.number[j]} has the shape of none of the model's, and may be one of them all the same ({hz}): "
        "members that differ by a few per cent mix modes that are close, or that swing where no sensor is. Leave it out of the "
        "test, or measure where the model has these modes swing."
    )


def _errors(ranking: Ranking, verdict: Verdict) -> Iterator[str]:
    """Errors of the test that explain the data, alone or beside a mechanism; where they need not be, as what may be wrong."""
    begin = "Unless what is missing is in no library, the test" if verdict.kind == UNKNOWN else "The test"
    coarse, entry = _POSSIBLE if misstated(ranking) in (None, _SCATTER) else _CERTAIN
    for doubt in _doubts(ranking) if ranking.noise_scale <= NOISY else ():
        if doubt.probability > RIVAL and (said := _mixed(ranking.baseline, doubt)):
            yield said
        elif doubt.probability > RIVAL:
            p = f"probability {doubt.probability:.2f}" if doubt.probability < 0.995 else "probability > 0.99"
            number = ranking.baseline.data.test.number
            modes = enumerated([str(number[j]) for j in doubt.modes])
            said = _TOLD[doubt.key].format(size=100 * doubt.size, modes=modes)
            yield f"{begin} {entry if doubt.modes else coarse} ({p}): {said}."


def _noise(ranking: Ranking) -> Iterator[str]:
    """What the accuracies would have to be for the best explanation to be right."""
    if ranking.noise_scale > NOISY or _scattered(ranking):
        best = min((one for one in ranking.fits if one.dof > 0), key=lambda one: one.misfit / one.dof)
        named = [each for each in zip(("frequencies", "shapes"), scatter(best), strict=True) if np.isfinite(each[1])]
        parts, left = " and ".join(f"{name} {factor:.2g} times" for name, factor in named), sqrt(best.misfit / best.dof)
        if max((factor for _, factor in named), default=left) <= _AGAIN:
            return
        parts = parts or f"{left:.2g} times"
        yield (
            f"Even the best explanation leaves {parts} the scatter that the deck states. Unless the mechanism is outside the "
            "library, the test is less accurate by that factor: repeat a measurement to estimate its scatter."
        )


def _narrow(ranking: Ranking, verdict: Verdict) -> Iterator[str]:
    """Where all that speaks against the model as it is are parameters further from their priors than chance allows; or against it
    with the fewest mechanisms of those that have most evidence, where none is named.
    """
    if said := _strained(ranking.baseline):
        yield f"The model as it is explains the data {said}: if a prior may be too narrow, nothing need be missing. {_CHECK}"
        return
    if verdict.kind != UNKNOWN:
        return
    most = sorted((one for one in ranking.fits if one.recipes), key=lambda one: -one.log_evidence)[:_LEADING]
    for one in sorted(most, key=lambda one: (len(one.recipes), -one.log_evidence)):
        if said := _strained(one):
            named = enumerated([recipe.candidate.title for recipe in one.recipes])
            yield f"With {named} ({acting(one)}) the model explains the data {said}: a prior may be too narrow. {_CHECK}"
            return


def _strained(one: Fit) -> str:
    """p-value of the data alone, and which parameters are too far from their priors; empty: they are not explained, or none is."""
    base, z = one.model.base, one.point.x[: one.model.k]
    off, p = shifts(one), upper_tail(one.misfit - z @ z, max(one.dof - len(z), 1))  # of the data alone
    chosen = beyond(off)
    if not chosen or p < GATE:
        return ""
    prior, value = (base.parameters(at) for at in (np.zeros_like(z), z))
    parts = [
        f"'{base.problem.parameters[j].name}' at {value[j]:.4g} instead of {prior[j]:.4g} ({off[j]:+.1f} prior sd)"
        for j in chosen
    ]
    return f"(p = {p:.2g}) with {enumerated(parts)}"


def _tied(ranking: Ranking, verdict: Verdict) -> Iterator[str]:
    """A strut from a held node that is the same to the model as the spring to the ground that leads, or the reverse."""
    best = verdict.best
    for one, p in zip(ranking.fits, ranking.probabilities.tolist(), strict=True):
        if best is not None and p > RIVAL and one_tie(best, one):
            where = [f"{each.recipes[0].candidate.title} ({each.sites[0].text})" for each in (best, one)]
            yield (
                f"To the model {where[0]} and {where[1]} are the same tie to the ground, and count as one answer: inspect both "
                "ends of the strut."
            )


def _centres(verdict: Verdict) -> Iterator[str]:
    """Floors whose masses are off their axes, on storeys that have their stiffness on theirs by definition."""
    best = verdict.best if verdict.kind in (NAMED, ONE_OF) else None
    if best is None or not any(recipe.candidate.group == _OFFSET for recipe in best.recipes):
        return
    mesh = best.model.base.problem.mesh
    if mesh is not None and any(members.type == "storey" for members in mesh.elements):
        yield (
            "A test sees how far the centre of mass of a floor is from the centre of stiffness of its storeys, not which of them "
            "is off: columns or walls that are stiffer on one side do the same as masses that are off their nodes. Inspect both."
        )


def _refuted(verdict: Verdict) -> Iterator[str]:
    if verdict.refuted:
        yield f"Refuted by the data held out, which the model with it does not predict: {', '.join(verdict.refuted)}."


def _elsewhere(verdict: Verdict, location: Location | None) -> Iterator[str]:
    """Where the measured shapes point to one place, and the cause that is named does not act there."""
    best = verdict.best
    if verdict.kind != NAMED or location is None or location.p < _PLAIN:
        return
    if location.region > max(1, _SMALL * len(location.places)):
        return
    sites = [recipe.site(recipe.values(best.c[own])) for recipe, own in zip(best.recipes, best.model.own, strict=True)]
    region = location.places[: location.region]
    if any(site.kind == "sensor" for site in sites) or any(_near(a, b.site, best) for a in sites for b in region):
        return
    first = region[0].site
    yield (
        f"The measured shapes by themselves point to {first.text or f'{first.kind} {first.ids}'}, where this mechanism does not "
        "act, or not alone: inspect that site before you trust the name."
    )


def on_set(one: Site, other: Site, groups: Iterable[ElementGroup]) -> bool:
    """Whether a cause of an element set acts at another site: a degree of freedom of a node of its elements."""
    nodes = next((group.nodes for group in groups if one.text == text(group)), ())
    node = str(other.ids[0]).rstrip("TRXYZ") if other.ids else ""
    return node.isdigit() and int(node) in nodes


def _near(one, other, best) -> bool:
    if on_set(one, other, best.model.base.problem.groups):
        return True
    if one.position is None or other.position is None:
        return bool(one.ids) and one.ids == other.ids
    return float(np.linalg.norm(np.subtract(one.position, other.position))) < _FAR * span(best.model.base)
