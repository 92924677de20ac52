"""What may be said: nothing is missing, it is this, it is one of these, or something no candidate explains."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.companions import Shared, carrying, panelled, placed, shared, steady
from mouse_cli.diagnosis.gates import DEMANDED, FAR, GATE, LIKELY, ODDS, STAYS, SURE
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.unseen import unmeasured_hz
from mouse_cli.diagnosis.nameless.fit import significant
from mouse_cli.diagnosis.search.fit import Fit
from mouse_cli.diagnosis.search.rank import Ranking, explains, group, unnamed
from mouse_cli.diagnosis.validate.averaged import averaged
from mouse_cli.diagnosis.validate.held_out import held_out
from mouse_cli.model.diagnosis import (
    BY_DECK,
    NAMED,
    NOTHING,
    ONE_OF,
    UNKNOWN,
    HeldOut,
    Rest,
)
from mouse_cli.model.groups import leading
from mouse_cli.updating.chi_square import upper_tail

_BELIEVED = 0.5  # share of the stated accuracies in the leading explanation below which the test itself is the finding
_MAJORITY = 0.5  # probability of what has no name, from which on it is more probable than all that has one
_STANDS = 1e-6  # probability of no mechanism below which some mechanism acts, whatever errors the test has


def doubtful(baseline: Fit, shifted: bool) -> bool:
    """Whether what the update leaves is no chance: misfit, one parameter far from its prior, or all together (`shifted`)."""
    return shifted or baseline.strained or upper_tail(baseline.misfit, baseline.dof) < GATE


@dataclass(frozen=True)
class Verdict:
    """kind of answer; best: the fit that leads, with a mechanism; proof: how it predicts what was held out.

    refuted: groups that held-out data speak against. field: the leading rival without a name where the answer is UNKNOWN, with
    field_proof, how it predicts what was held out; where it is ONE_OF, that rival if it leads these. reasons: what forbids a
    name that evidence alone would give, in sentences. certain: what of `best` is named, where its companions are open. placed:
    whether its site is as sure as a name; what is named all the same is so within `panelled`.
    """

    kind: str
    best: Fit | None
    proof: HeldOut | None
    refuted: tuple[str, ...] = ()
    field: Fit | None = None
    field_proof: HeldOut | None = None
    reasons: tuple[str, ...] = ()
    certain: Shared | None = None
    placed: bool = True

    @property
    def put(self) -> Fit | None:
        """What goes into a deck: the fit that leads, or the rival without a name."""
        return self.best if self.kind in (NAMED, ONE_OF) else self.field

    @property
    def sure(self) -> tuple[int, ...] | None:
        """Numbers of the mechanisms of `put` that are certain, where its companions are open; None: all are."""
        return None if self.certain is None else self.certain.which


def judge(ranking: Ranking, shifted: bool, model: Reduced) -> Verdict:
    """What may be said of all fits; one of several predicts as all hypotheses together do."""
    found = _judged(ranking, shifted, model)
    if found.kind != ONE_OF:
        return found
    proof = found.proof and (averaged(model, ranking) or found.proof)
    return replace(found, proof=proof, field=_rival_field(ranking))


def _rival_field(ranking: Ranking) -> Fit | None:
    """The most probable fit of physics without a name, where that is more probable than all that has one; None: it is not."""
    fields = [(p, one) for p, one in zip(ranking.probabilities.tolist(), ranking.fits, strict=True) if one.nameless]
    return max(fields, key=lambda each: each[0])[1] if sum(p for p, _ in fields) > _MAJORITY else None


def _judged(ranking: Ranking, shifted: bool, model: Reduced) -> Verdict:
    """The same: by their evidence, and by data that none of them has seen; shifted: its parameters moved too far.

    Something is missing where the update leaves too much, where the model as it is is improbable (DEMANDED), or where some
    mechanism is sure and what the deck holds out confirms it. Where none of that holds and yet the model as it is is not probable
    (LIKELY), or the model as it is fails on what the deck holds out and a mechanism predicts it, it is likely, not proved: one of
    several, the model as it is among them. What leads without a name, and has no value that differs from 0, makes nothing likely:
    members scatter. A mechanism that is sure at one of several sites is one of these, unless all of them are in one line of
    panels: that is the place then; of a set those are named whose sites are sure. Of a set that data held out refute, or modes
    that are predicted from one another, that one mechanism is named which carries it, if any does.
    """
    baseline, best, none = ranking.baseline, leader(ranking), dict(ranking.groups).get("none", 0.0)
    believed = ranking.stated[0] >= _BELIEVED
    shown = believed and (not ranking.fits[0].nameless or significant(ranking.fits[0]))
    demanded = doubtful(baseline, shifted) or (baseline.telling and none < GATE) or (shown and none < DEMANDED)
    likely = best is not None and shown and none <= LIKELY
    asked = demanded or likely or (believed and best is not None and _odds(ranking, best) > 0)
    proof = held_out(model, baseline, best if asked else None)
    gain = _gain(proof)
    if not demanded and not (likely and gain > -ODDS):
        if asked and not likely and _predicts(ranking, proof):
            return Verdict(ONE_OF, best, proof)
        return Verdict(NOTHING, None, None if proof is None else replace(proof, revised=None))
    kind, reasons = decide(ranking)
    if not demanded and gain <= ODDS:
        kind = ONE_OF
    if kind == UNKNOWN or best is None:
        return _unknown(ranking, model, best, proof, (), reasons)
    if gain < -ODDS:
        return _unknown(ranking, model, best, proof, (group(best),), reasons)
    if kind == NAMED and len(best.recipes) > 1 and proof is not None and proof.refuted:
        part = carrying(ranking, best)
        if part is None:
            return _unknown(ranking, model, best, proof, (group(best),), reasons)
        return Verdict(kind, best, proof, reasons=reasons, certain=part)
    return _named(ranking, Verdict(kind, best, proof, reasons=reasons))


def _named(ranking: Ranking, found: Verdict) -> Verdict:
    """The same, and which mechanisms of a set are named, and whether their places are sure."""
    best, certain_ = found.best, found.kind == NAMED and ranking.groups[0][1] >= SURE
    moved = certain_ and placed(best) < SURE
    spread = certain_ and 0 < len(steady(best)) < len(best.recipes)
    part = shared(ranking, best) if moved or spread or (found.kind == NAMED and not certain_) else None
    if moved and (part is None or len(part.which) == len(best.recipes)):
        return replace(found, kind=NAMED if panelled(best) else ONE_OF, placed=False)
    return replace(found, certain=part)


def _odds(ranking: Ranking, one: Fit) -> float:
    """ln of how much better a fit predicts the data than the model as it is."""
    return float(next(odds for odds, each in zip(ranking.log_odds, ranking.fits, strict=True) if each is one))


def _predicts(ranking: Ranking, proof: HeldOut | None) -> bool:
    """Whether what the deck holds out refutes the model as it is (GATE), and is predicted better with the mechanism than by chance.

    It is the best of all that were tried, so that ODDS are asked of it for each of them. Modes predicted from one another are no
    new data: the evidence has all of them already, and the site was chosen with them.
    """
    refuted = proof is not None and proof.kind == BY_DECK and proof.baseline.p < GATE
    return refuted and _gain(proof) / ranking.noise_scale > ODDS + float(np.log(len(ranking.named)))


def _unknown(ranking: Ranking, model: Reduced, best: Fit | None, proof, struck: tuple, reasons: tuple) -> Verdict:
    """No name; what has none is given where its odds over the model as it is are enough for one.

    Of several that which all data make the most probable, those that the deck holds out among them: a law at one place fits modes
    one by one, and says nothing of others.
    """
    fields = [each for each in zip(ranking.log_odds, ranking.fits, strict=True) if each[1].nameless and each[0] > ODDS]
    if not fields:
        return Verdict(UNKNOWN, best, averaged(model, ranking) or proof, struck, reasons=reasons)
    proofs = [held_out(model, ranking.baseline, fields[0][1])]
    if proofs[0] is not None and proofs[0].kind == BY_DECK:
        proofs += [held_out(model, ranking.baseline, one) for _, one in fields[1:]]
    first = int(
        np.argmax([odds + _gain(own) / ranking.noise_scale for (odds, _), own in zip(fields, proofs, strict=False)])
    )
    together = averaged(model, ranking) or proofs[first]
    return Verdict(UNKNOWN, best, proof, struck, fields[first][1], together, reasons)


def leader(ranking: Ranking) -> Fit | None:
    """The leading fit of the leading group that has a mechanism with a name; None without any."""
    groups = [group(ranking.fits[i]) for i in ranking.named]
    at = leading(ranking.groups, groups)
    return None if at is None or groups[at] == "none" else member(ranking, groups[at])


def member(ranking: Ranking, name: str) -> Fit:
    """The leading fit of a group that has a mechanism with a name.

    Of mechanisms that are another one at an end of their range, that one itself where its odds against them are above -ODDS: a
    spring to the ground has no mode of its own, an oscillator that stands in for it has one below the band.
    """
    of = [i for i in ranking.named if group(ranking.fits[i]) == name]
    least = np.exp(-ODDS) * ranking.probabilities[of[0]]
    alike = [ranking.fits[i] for i in of if ranking.probabilities[i] >= least]
    plain = (one for one in alike if one.groups == [recipe.candidate.group for recipe in one.recipes])
    return next(plain, alike[0])


def sure(ranking: Ranking) -> bool:
    """Whether some mechanism acts, whichever it is, and the test may be as accurate as it is said to be."""
    return dict(ranking.groups).get("none", 0.0) <= 1 - SURE and ranking.stated[0] >= _BELIEVED


def decide(ranking: Ranking) -> tuple[str, tuple[str, ...]]:
    """The kind of answer when something is missing, by the gates of adequacy, probability and odds; and why no name is given."""
    first, (name, probability) = ranking.fits[0], ranking.groups[0]
    if unnamed(first) and name not in {group(ranking.fits[i]) for i in ranking.named}:
        best = leader(ranking)
        rival = best is not None and dict(ranking.groups)[group(best)] > STAYS and explains(best)
        return ONE_OF if rival else UNKNOWN, ()
    if name == "none":
        return UNKNOWN, ()
    first = leader(ranking) or first
    if not explains(first) or first.strained:
        return UNKNOWN, ()
    if ranking.stated[0] < _BELIEVED and dict(ranking.groups).get("none", 0.0) > _STANDS:
        return UNKNOWN, ()  # the test is not as accurate as it is stated, and what is missing besides cannot be told
    if far := far_parameters(first):
        return UNKNOWN, (_FAR.format(far),)
    if not _odds(ranking, first) > ODDS or (probability < SURE and shared(ranking, first) is None):
        return ONE_OF, ()
    if not first.model.base.data.by_shape and any(recipe.own for recipe in first.recipes):
        return ONE_OF, ()  # paired by number, a list of frequencies cannot prove that it holds one mode more
    if not first.telling and (hz := unmeasured_hz(first)):
        return ONE_OF, (_OWN_MODE.format(", ".join(f"{value:.4g} Hz" for value in hz)),)
    return NAMED, ()


_FAR = (
    "With this mechanism {} of the deck would have to be wrong by more than 5 of its prior standard deviations: either the prior "
    "is much too narrow, or the physics is another."
)
_OWN_MODE = (
    "This mechanism has a mode of its own at {}, below the highest that was measured, which the test does not have: look for it "
    "there; unless it is measured, the mechanism is not proved."
)


def rest(ranking: Ranking) -> Rest | None:
    """What the leading explanation leaves, where that is more than chance."""
    first = leader(ranking) or ranking.fits[0]
    dof = max(first.dof, 1)
    p = upper_tail(first.misfit, dof)
    return None if p >= GATE else Rest(float((first.misfit - dof) / max(ranking.baseline.misfit - dof, 1.0)), p)


def far_parameters(one: Fit) -> str:
    """Names of the parameters that are FAR from their prior means; empty: none is."""
    names = one.model.base.problem.parameters
    return ", ".join(f"'{names[j].name}'" for j in np.flatnonzero(np.abs(shifts(one)) > FAR))


def shifts(one: Fit) -> np.ndarray:
    """How far the parameters (p,) are from their prior means, in prior sd."""
    base = one.model.base
    size = np.sqrt((base.L**2).sum(axis=1))
    return base.L @ one.point.x[: one.model.k] / np.where(size > 0, size, np.inf)


def _gain(proof: HeldOut | None) -> float:
    """Nats by which a cause predicts data that the deck holds out better than the model without it; 0 without such data."""
    if proof is None or proof.revised is None or proof.kind != BY_DECK:
        return 0.0
    return proof.revised.log_predictive_density - proof.baseline.log_predictive_density
