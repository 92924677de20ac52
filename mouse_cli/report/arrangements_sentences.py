"""The verdict on several configurations of a structure in sentences: the same in printout, JSON document and page."""

from collections.abc import Iterator

from mouse_cli._texts import capital
from mouse_cli.model.arrangements import ArrangementsDiagnosis, Turn
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, UNKNOWN
from mouse_cli.report.field_words import field_sentences
from mouse_cli.report.sections._diagnosis_wording import (
    grouped,
    nats,
    p_value,
    probable,
    rivals_of_site,
    sized,
    where,
    with_p,
    within,
)
from mouse_cli.report.verdict_sentences import remains
from mouse_cli.report.verdict_sentences import sentences as of_one

_VERDICTS = {
    NOTHING: "Nothing is missing that these configurations could show: the model, with its parameters revised, explains them.",
    NAMED: "The model lacks what follows, each identified with all before it in the model; the remainder is consistent with noise.",
    ONE_OF: "The model lacks what follows, each identified with all before it in the model, not all of it settled; what then "
    "remains may be noise.",
    UNKNOWN: "More remains than noise, and no candidate explains it. Do not trust the revised parameters.",
}
_BY_ITSELF = "Diagnose one of the decks before by itself, and put what it lacks into all decks."
_BESIDE_NAMED = (
    "No change was sought beside that: with it in them the decks are no structures, or do not explain the state before. Put into "
    "all decks what of it is right."
)
_BESIDE_OPEN = "No change was sought: what the state before lacks is not settled, and a change beside it would be put elsewhere."
_EVEN = 0.5  # probability of no mechanism up to which one is called likely


def sentences(found: ArrangementsDiagnosis) -> tuple[str, ...]:
    """What the state before lacks, if that was asked; what was found, then one paragraph a mechanism in the order of its
    identification.
    """
    return (*_state(found), *_sought(found))


def _state(found: ArrangementsDiagnosis) -> Iterator[str]:
    """What the state before lacks by itself, and whether a change was sought beside that."""
    if found.state is None:
        return
    first, *others = of_one(found.state)
    yield f"The model does not explain the state before. Diagnosed by itself: {first}"
    yield from others
    if found.begun:
        yield "With that in all decks, of what has changed since:"


def _sought(found: ArrangementsDiagnosis) -> tuple[str, ...]:
    first = list(_unchanged(found)) if found.unchanged else [_VERDICTS[found.kind]]
    if found.kind == UNKNOWN and found.unsought:
        first = [*_unsought(found), "Do not trust the revised parameters."]
    elif found.kind == UNKNOWN and found.field is not None:
        first = list(field_sentences(found.field))
    elif found.remaining is not None:
        first.append(f"None of the following is proved: with all of it in the model {remains(found.remaining)}.")
    steps = [f"{number}. {_step(turn, found.kind != UNKNOWN)}" for number, turn in enumerate(found.turns, 1)]
    return (*first, *steps)


def _unsought(found: ArrangementsDiagnosis) -> tuple[str, ...]:
    """Why no change was sought, and what to do."""
    if found.state is None:
        return found.unsought, _BY_ITSELF
    return (_BESIDE_NAMED if found.state.kind == NAMED else _BESIDE_OPEN,)


def _unchanged(found: ArrangementsDiagnosis) -> Iterator[str]:
    """That the tests are alike; and that the model explains neither, where it does not."""
    tests = found.tests
    yield (
        "Nothing has changed that these tests could show: before and after they differ by no more than noise (chi-square "
        f"{tests.chi2:.1f} on {tests.dof}, {p_value(tests.p)} of the largest difference)."
    )
    if not found.adequate:
        yield "The model explains neither: diagnose the state before by itself, and do not trust the revised parameters."


def _step(turn: Turn, explains: bool) -> str:
    """explains: whether all mechanisms together explain the data; without that no probability is given."""
    best, tried = turn.best, turn.explanations
    gain = (
        f"log evidence {nats(turn.gain)} above none; chi-square {turn.before.chi2:.1f} to {best.chi2:.1f} on {best.dof}"
    )
    p = f"{with_p(turn.probability)}; " if explains else ""
    at, sizes = f"{where(best)}{rivals_of_site(turn.elsewhere)}", capital(sized(best.causes[0]))
    if turn.kind == NAMED or not explains:
        if not (explains and within(tried, best)):
            return f"{capital(best.title)}: {at} ({p}{gain}). {sizes}."
        inside = within(tried, best)
        return f"{capital(grouped(tried, best))} ({p}{gain}): {inside}. If it is {best.title}: {at}. {sizes}."
    rivals = [f"{grouped(tried, one)}, {where(one)}" for one in turn.rivals if one.causes]
    names = f", one of {{{'; '.join(rivals)}}}" if len(rivals) > 1 else f": {''.join(rivals)}"
    none = next((each for name, each in turn.groups if name == "none" and any(not o.causes for o in turn.rivals)), None)
    likely = "Not settled"
    if none is not None:
        likely = f"{'Likely' if none <= _EVEN else 'Possible'}, not proved (probability that nothing is missing {probable(none)})"
    return (
        f"{likely}{names} ({gain}). {capital(best.title)} leads ({with_p(turn.probability)} of its "
        f"group) and is what the search goes on with: {at}; {sized(best.causes[0])}."
    )
