"""What arrangements lack, in the order in which it was told, in plain sentences."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis, Turn
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, UNKNOWN
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import nats, sized, where, with_p
from mouse_cli.report.sections._wording import chance

_VERDICTS = {
    NOTHING: "Nothing is missing that these arrangements could show: the model, with its parameters revised, explains them.",
    NAMED: "The model lacks what follows, each found beside all before it; what is then left may be noise.",
    ONE_OF: "The model lacks what follows, each found beside all before it, not all of it settled; what is then left may be noise.",
    UNKNOWN: "More is left than noise, and no candidate explains it. Do not trust the revised parameters.",
}


def answers(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """The verdict, one paragraph a cause, what is left, whether it is true."""
    yield Text(_VERDICTS[found.kind])
    for number, turn in enumerate(found.turns, 1):
        yield Text(f"{number}. {_told(turn)}")
    if found.refuted:
        yield Text(
            f"Refuted by the arrangements held out, which are predicted worse with it than without: {found.refuted}."
        )
    yield Heading("What is left?", 2)
    yield Text(
        f"Chi-square {found.chi2:.1f} on {found.dof}: noise alone leaves more {chance(found.p)}. "
        "Sizes that stand with all causes in the model are under Parameters; those above are as each was told."
    )
    yield Heading("Is it true?", 2)
    yield Text(_true(found))


def _told(turn: Turn) -> str:
    best, cause = turn.best, turn.best.causes[0]
    gain = f"{nats(turn.gain)} nats over none; misfit {turn.before.chi2:.1f} to {best.chi2:.1f} on {best.dof}"
    if turn.kind == NAMED:
        return f"{_capital(best.title)}: {where(best)} ({with_p(turn.probability)}; {gain}). {_capital(sized(cause))}."
    rivals = [f"{one.title}, {where(one) or 'nowhere'}" for one in turn.rivals if one.causes]
    return (
        f"Not settled, one of {{{'; '.join(rivals)}}} ({gain}). {_capital(best.title)} leads with {with_p(turn.probability)} "
        f"and is what the search goes on with: {sized(cause)}."
    )


def _true(found: ArrangementsDiagnosis) -> str:
    held = found.held_out
    if held is None:
        return "Not proved: no arrangement was held out (`--held-out`)."
    base, after = held.baseline, held.revised
    errors = f"the root mean square error of {len(held.labels)} frequencies is {100 * base.rms_frequency_error:.2g} %"
    seen = "Arrangements that no fit has seen"
    if after is None:
        return f"{seen}: {errors}, and {100 * base.covered:.0f} % lie within their 90 % intervals."
    return (
        f"{seen}: {errors} without any cause, and {100 * after.rms_frequency_error:.2g} % with all; the ln predictive density goes "
        f"from {base.log_predictive_density:.1f} to {after.log_predictive_density:.1f}, and {100 * after.covered:.0f} % lie within "
        "their 90 % intervals. Parameters and errors of theory are revised in both."
    )


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


SECTION = Section("arrangements-answers", 10, "Diagnosis", answers, (ArrangementsDiagnosis,))
