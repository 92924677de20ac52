"""The verdict of a diagnosis in sentences: the same in printout, JSON document and page, for every kind of test."""

from mouse_cli.model.diagnosis import BY_DECK, NAMED, NOTHING, ONE_OF, RIVAL, UNPROVED, Diagnosis, Explanation, Rest
from mouse_cli.model.explanation import elsewhere, foremost
from mouse_cli.model.groups import enumerated
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.shared_place import at_one_place
from mouse_cli.report.field_words import field_acts, field_sentences
from mouse_cli.report.sections._diagnosis_wording import (
    called,
    companions,
    grouped,
    in_common,
    inside,
    lacking,
    leaders,
    of_groups,
    p_value,
    probable,
    rivals_of_site,
    separation,
    where,
    with_p,
    within,
)

_EVEN = 0.5  # probability of no mechanism up to which one is called likely
_SURE = 0.95  # probability of what acts beside a name, from which on its place alone is open


def sentences(found: Diagnosis) -> tuple[str, ...]:
    """What was found, the first sentence first."""
    if found.kind == NOTHING:
        possible = _possible(found)
        return tuple(filter(None, (_nothing(found, possible), possible)))
    if found.kind == NAMED:
        return _named(found)
    if found.kind == ONE_OF:
        return tuple(filter(None, (_one_of(found), _common(found), _separating(found))))
    return _unknown(found)


def faulty(best: Explanation) -> bool:
    """Whether the fault lies in the test alone."""
    return all(cause.site.kind == "sensor" for cause in best.causes)


def _nothing(found: Diagnosis, possible: str) -> str:
    """possible: what is more probable than that nothing is missing; empty: nothing."""
    if isinstance(found, RecordDiagnosis):
        sentence = "Nothing is missing that these records could show: the linear model, with its parameters revised, explains them"
        return f"{sentence}{' but for noise of their own' if found.noise else ''}."
    status = found.result.status
    shown = "This test does not show that something is missing, nor that nothing is"
    begin = shown if possible else "Nothing is missing that this test could show"
    sentence = f"{begin}: the model, with its parameters revised, explains the data."
    if not found.result.residual.dof:
        sentence = (
            "Nothing is missing that this test could show, and it could show little: its parameters can follow all of its data, so "
            "that only their shift from the prior shows what is missing."
        )
    return sentence if status.exit_code == 0 else f"{sentence} But its revision is not to be trusted. {status.sentence}"


def _possible(found: Diagnosis) -> str:
    """What may be missing although nothing is shown to be: where that is the more probable."""
    none = dict(found.groups).get("none", 1.0)
    group, p = max(found.groups, key=lambda each: each[1], default=("none", 1.0))
    if p <= none:
        return ""
    first = foremost(found.explanations, group) if group != "none" else None
    begin, nothing = "Something may be missing all the same", f"that nothing is: {probable(none)}"
    if first is None and found.nameless > none:
        return f"{begin}, most likely a change without a name ({with_p(found.nameless)}; {nothing})."
    if first is None:
        return f"{begin} (probability {nothing})."
    return f"{begin}, most likely {grouped(found.explanations, first)} ({with_p(p)}; {nothing})."


def _named(found: Diagnosis) -> tuple[str, ...]:
    """Probability of the hypothesis where its group has no other member that counts, else of the group and of each member."""
    best, members = found.best, inside(found)
    if not found.placed:
        return tuple(filter(None, (_panelled(found), _separating(found))))
    begin = f"The test is at fault{', not the model' * _alone(found)}:" if faulty(best) else "The model lacks"
    if not members:
        other = (
            f"It may act elsewhere{rivals_of_site(found.elsewhere).removeprefix('; or')}." if found.elsewhere else ""
        )
        p = f" ({with_p(found.probability)})" if len(best.causes) == 1 else f": {with_p(found.probability)}"
        first = f"{begin} {lacking(best)}{p}{_rest(found.rest)}."
        return tuple(filter(None, (first, other, _loose(found), _companions(found))))
    first = f"{begin} {called(found)} ({with_p(found.probability)}): {members}{_rest(found.rest)}."
    at = f"If it is {best.title}, it acts here: {where(best)}{rivals_of_site(found.elsewhere)}."
    return tuple(filter(None, (first, at, _loose(found), _companions(found))))


def _alone(found: Diagnosis) -> bool:
    """Whether nothing may act beside what is named."""
    return found.certain is None or dict(found.certain.companions).get("none", 0.0) > UNPROVED


def _panelled(found: Diagnosis) -> str:
    """What is sure of a place, and what is not."""
    best, at = found.best, "" if found.shared is None else f" within {in_common(found.shared, found.problem.units)}"
    open_ = f"between which nodes: {where(best)}{rivals_of_site(found.elsewhere)}"
    return f"The model lacks {best.title} ({with_p(found.probability)}){at}, and the test does not settle {open_}."


def _companions(found: Diagnosis) -> str:
    """What acts beside what is named; where that is sure itself, its place is what keeps it from the name."""
    if found.certain is None:
        return ""
    groups, p = found.certain.companions[0]
    if groups != "none" and found.held_out is not None and found.held_out.refuted:
        held = found.held_out
        unseen = "what the deck holds out" if held.kind == BY_DECK else "modes as the others predict them"
        return (
            f"What acts beside it is open: {of_groups(found, groups)} beside it explains what was fitted, and fails on {unseen} "
            f"({p_value(held.p)})."
        )
    if groups != "none" and p >= _SURE:
        return f"Beside it acts {of_groups(found, groups)} ({with_p(p)}), and the test does not settle where."
    return f"What acts beside it is open: {companions(found)}."


def _loose(found: Diagnosis) -> str:
    """How well the place of a mechanism is known where that is less certain than the mechanism."""
    unit = found.problem.units.of("m") if found.loose else ""
    each = [f"that of {title} has a standard deviation of {sd:.2g} {unit}" for title, sd in found.loose]
    return f"The position is less certain: {enumerated(each)}." if each else ""


def _rest(rest: Rest | None) -> str:
    if rest is None:
        return ""
    return f", whose law is of another shape than this: {remains(rest)}" if rest.there else f", and something more: {remains(rest)}"


def remains(rest: Rest) -> str:
    """What is left unexplained beside what was named."""
    there = ", and most of it follows from the motion there" * rest.there
    return f"{100 * rest.share:.2g} % of the misfit remains{there}, {p_value(rest.p)}"


def _one_of(found: Diagnosis) -> str:
    """Likely, not proved, where it may be that nothing is missing; else one of several."""
    none, first = dict(found.rivals).get("none"), leaders(found)
    named = "; ".join([*(grouped(found.explanations, one) for one in first), *_nameless(found)])
    test = "the records do" if isinstance(found, RecordDiagnosis) else "the test does"
    if not found.placed:
        at = f"{where(found.leader)}{rivals_of_site(found.elsewhere)}"
        return f"The model lacks {named} ({with_p(found.probability)}), and {test} not settle where: {at}."
    if none is None:
        return f"Something is missing, and {test} not settle what: one of {{{named}}}."
    likely = "It is likely, not proved, that" if none <= _EVEN else "It is possible, not likely, that"
    if len(first) != 1 or _nameless(found):
        nothing = f"probability that nothing is: {probable(none)}"
        return f"{likely} something is missing ({nothing}), and {test} not settle what: one of {{{named}}}."
    (one,) = first
    inside, p = within(found.explanations, one), with_p(dict(found.groups)[one.group])
    nothing = f"; that nothing is missing: {probable(none)}" if none > UNPROVED else ", and not validated"
    begin = "the test is at fault:" if faulty(one) else "the model lacks"
    return f"{likely} {begin} {named if inside else lacking(one)} ({p}{nothing}){f': {inside}' if inside else ''}."


def _common(found: Diagnosis) -> str:
    """What all sites share between which the test does not decide: where to look."""
    first = leaders(found)
    if found.placed and len(first) > 1 and not _nameless(found):
        sites = [sites for one in first for sites in (one.sites, *(other for other, _ in elsewhere(found.explanations, one)))]
        near = all(len(each) == 1 for each in sites) and at_one_place(found.problem.mesh, [site for (site,) in sites])
        return f"All of these act at or beside {where(first[0])}: an inspection there finds which it is." if near else ""
    if found.placed or found.shared is None:
        return ""
    return f"All of these sites share {in_common(found.shared, found.problem.units)}: an inspection there finds which it is."


def _nameless(found: Diagnosis) -> tuple[str, ...]:
    """What has no name, where it is a rival."""
    if not found.nameless > RIVAL:
        return ()
    acts = "" if found.field is None else f" that {field_acts(found.field)}"
    return (f"a change without a name{acts} ({with_p(found.nameless)})",)


def _separating(found: Diagnosis) -> str:
    if isinstance(found, RecordDiagnosis):
        return "Another level of excitation separates most laws."
    aim = "to separate them" if len(leaders(found)) > 1 else "to settle it"
    if not found.proposals:
        return f"No measurement can be proposed {aim}."
    best = found.proposals[0]
    if not best.promise:
        best = max(found.proposals, key=lambda each: each.separation)
        tried = f"the best, {best.text}, has a predicted separation of {separation(best.separation)}"
        if best.promise:  # it tells the leading one from another than the next
            words = (lambda text: of_groups(found, text)) if found.placed else str  # what is between is groups, or sites
            first, second, other = map(words, (*found.proposals[0].between, best.between[1]))
            tells = f"{best.text} separates {first} from {other} (predicted separation {separation(best.separation)})"
            return f"No measurement that was tried separates {first} from {second}; {tells}."
        return f"None of the measurements that were tried will settle it; {tried}."
    return f"Measure this {aim}: {best.text} (predicted separation {separation(best.separation)}, {best.outlook})."


def _unknown(found: Diagnosis) -> tuple[str, ...]:
    """No probability is given: none is of a hypothesis that explains the data."""
    if isinstance(found, RecordDiagnosis) and found.outside:
        return ("The model does not explain the records, and what follows does, which is no law of the library.",)
    if found.misstated:
        first = (
            "Model and test disagree, and an error of the test is more probable than that it is as accurate as stated, unless what "
            "is missing is in no library. No mechanism can be named before that is settled."
        )
        beside = "What explains the data best beside such an error"
        return (first, *(() if found.field is None else field_sentences(found.field, beside)))
    if found.field is not None:
        return field_sentences(found.field)
    first = "Something is missing that no candidate explains. Do not trust the revised parameters, and do not name a mechanism."
    return (first,)
