"""The four answers of a diagnosis, in plain sentences: what, where, how much, and is it true."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, Diagnosis, Explanation, HeldOut, Location
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import place, sized, where, with_p
from mouse_cli.report.sections._wording import chance, counted

_DEMANDED = 0.5  # probability of no cause below which others stay likely though the data do not demand them
_SETTLES, _HELPS = 4.0, 1.0  # nats from which on a measurement will separate two explanations, and may
_GAIN, _RATIO, _COVERED = 3.0, 0.7, 0.7  # what a proof takes: nats, ratio of errors, share within 90 % intervals


def answers(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The verdict, then the answers one by one."""
    yield Text(_verdict(found))
    for question, told in (
        ("Where?", _where(found)),
        ("What?", _what(found)),
        ("How much?", _how_much(found)),
        ("Is it true?", _true(found)),
    ):
        yield Heading(question, 2)
        yield Text(told)


def _verdict(found: Diagnosis) -> str:
    best = found.best
    if found.kind == NOTHING:
        return (
            "Nothing is missing that this test could show: the model, with its parameters revised, explains the data."
        )
    if found.kind == NAMED:
        faulty = all(cause.site.kind == "sensor" for cause in best.causes)
        begin = "The test is at fault, not the model:" if faulty else "The model lacks"
        return f"{begin} {best.title}: {where(best)} ({with_p(found.probability)})."
    if found.kind == ONE_OF:
        named = [name for name, _ in found.rivals if name != "none"]
        doubt = (
            " None of them makes the data much more probable: they may also be less accurate than they are said to be."
        )
        unsure = doubt if len(named) < len(found.rivals) else ""
        causes = ", ".join(named)
        return (
            f"Something is missing, and the test does not settle what: one of {{{causes}}}.{_separating(found)}{unsure}"
        )
    return (
        "Something is missing that no candidate explains. Do not trust the revised parameters, and do not name a cause."
    )


def _separating(found: Diagnosis) -> str:
    if not found.proposals:
        return " No measurement that was tried would separate them."
    best = found.proposals[0]
    return f" Measure this to separate them: {best.text} ({_promise(best.separation)})."


def _promise(separation: float) -> str:
    how = (
        "will settle it" if separation > _SETTLES else "may settle it" if separation >= _HELPS else "will not settle it"
    )
    return f"predicted separation {separation:.1f}, {how}"


def _where(found: Diagnosis) -> str:
    shapes = _location(found.location)
    if found.kind == NOTHING:
        return "Nowhere: model and test part no more than their accuracies let expect."
    if found.kind == NAMED:
        return f"{_capital(where(found.best))}.{shapes}"
    if found.kind == ONE_OF:
        each = [f"{one.title}: {where(one)}" for one in _leaders(found)]
        return f"That depends on what it is. {_capital('; '.join(each))}.{shapes}"
    return shapes.strip() or "No place can be given without a cause that explains the data."


def _location(location: Location | None) -> str:
    """What the shapes say by themselves, whatever the law of the force."""
    if location is None or not location.places:
        return ""
    if not location.single:
        return " No force at a single place makes the measured shapes; the cause is distributed, or there are several."
    first = location.places[0]
    return (
        f" The measured shapes by themselves, whatever the cause, point to {place(first.site)} "
        f"({with_p(first.probability)}; the 90 % region holds {counted(location.region, 'place')})."
    )


def _what(found: Diagnosis) -> str:
    best, conditional = found.best, "P holds on condition that the cause is one of those that mouse knows"
    if found.kind == NOTHING:
        total = found.result.residual
        chances = f": by chance the misfit would be larger {chance(total.p)}" if total.dof else ""
        return (
            f"Nothing{chances}. An effect that moves the data by less than their accuracies stays hidden.{_open(found)}"
        )
    if found.kind == NAMED:
        return (
            f"{_capital(best.title)}, group {best.group}, {with_p(found.probability)}. What the extended model leaves "
            f"of the misfit would by chance be larger {chance(best.p)}{_noise(found)}. {conditional}."
        )
    if found.kind == ONE_OF:
        shares = ", ".join(f"{name} {with_p(p)}" for name, p in found.rivals)
        return f"Probabilities of the groups: {shares}{_noise(found)}. {conditional}."
    if best is None or not best.causes or found.groups[0][0] == "none":
        return "No candidate does better than none at all."
    return (
        f"No candidate is adequate. The nearest, {best.title}, leaves a misfit that would by chance be larger "
        f"{chance(best.p)}{_noise(found)}; that it is nearest does not make it the cause."
    )


def _open(found: Diagnosis) -> str:
    """What data that demand no cause leave possible."""
    if not found.probability < _DEMANDED:
        return ""
    told = with_p(found.probability)
    return f" The data demand no cause, and do not rule out those that lead the table either: no cause has {told}."


def _noise(found: Diagnosis) -> str:
    if not found.noise_scale > 1:
        return ""
    return f" (the stated variances were multiplied by {found.noise_scale:.3g}, which the best fit needs)"


def _how_much(found: Diagnosis) -> str:
    if found.kind == NOTHING or found.best is None:
        return "Nothing to be sized."
    if found.kind in (NAMED, ONE_OF):
        each = [f"{cause.title}: {sized(cause)}" for one in _leaders(found) for cause in one.causes]
        return f"{_capital('; '.join(each))}."
    return "Without a cause there is no size."


def _leaders(found: Diagnosis) -> list[Explanation]:
    """The explanation named, or the first of each rival group."""
    if found.kind == NAMED:
        return [found.best]
    firsts = [next(one for one in found.explanations if one.group == name) for name, _ in found.rivals]
    return [one for one in firsts if one.causes]


def _true(found: Diagnosis) -> str:
    held = found.held_out
    if held is None:
        return "Not proved: no data were held out from the fits, and there are too few modes to predict each from the others."
    base = held.baseline
    told = f"Data that no fit has seen ({held.kind}): "
    if held.revised is None or found.kind == NOTHING:
        return f"{told}the model predicts frequencies with a root mean square error of {100 * base.rms_frequency_error:.2g} %."
    after = held.revised
    told += (
        f"the root mean square error of frequencies goes from {100 * base.rms_frequency_error:.2g} % to "
        f"{100 * after.rms_frequency_error:.2g} %, the ln predictive density from {base.log_predictive_density:.1f} to "
        f"{after.log_predictive_density:.1f}; 90 % intervals of the extended model hold {100 * after.covered:.0f} % of the "
        "frequencies."
    )
    return f"{told} {_proof(found, held)}"


def _proof(found: Diagnosis, held: HeldOut) -> str:
    base, after = held.baseline, held.revised
    fails = []
    if not after.log_predictive_density - base.log_predictive_density > _GAIN:
        fails.append("the density gains too little")
    if not after.rms_frequency_error < _RATIO * base.rms_frequency_error:
        fails.append("the error falls too little")
    if not after.covered >= _COVERED:
        fails.append("too few frequencies lie within the intervals")
    if fails:
        return f"That is no full proof: {', and '.join(fails)}."
    if found.kind == NAMED:
        return "The extended model passes. A better prediction is needed for a name to be right; it does not prove it alone."
    return "A better prediction does not make a name of it."


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


SECTION = Section("diagnosis-answers", 10, "Diagnosis", answers, (Diagnosis,))
