"""The answers of a diagnosis by recordings, in plain sentences: what, where, how much, and is it true."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, Rest
from mouse_cli.model.record_diagnosis import AS_IT_IS, WITH_CAUSE, RecordDiagnosis, RecordScore
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._diagnosis_wording import leaders, place, sized, where, with_p
from mouse_cli.report.sections._wording import chance


def answers(found: RecordDiagnosis, options: Options) -> Iterator[Block]:
    """The verdict, then the answers one by one."""
    yield Text(_verdict(found))
    yield from (Text(text) for text in found.cautions)
    for question, told in (
        ("Where?", _where(found)),
        ("What?", _what(found)),
        ("How much?", _how_much(found)),
        ("Is it true?", _true(found)),
    ):
        yield Heading(question, 2)
        yield Text(told)


def _verdict(found: RecordDiagnosis) -> str:
    if found.kind == NOTHING:
        told = "Nothing is missing that these records could show: the linear model, with its parameters revised, explains them"
        return f"{told}{' but for noise of their own' if found.noise else ''}."
    if found.kind == NAMED:
        told = f"The model lacks {found.best.title}: {where(found.best)} ({with_p(found.probability)})"
        return f"{told}{'' if found.rest is None else f', {_more(found.rest)}'}."
    if found.kind == ONE_OF:
        each = ", or ".join(f"{one.title} {where(one)}" for one in leaders(found))
        return (
            f"Something is missing, and the records do not settle what: {each}. "
            "Another level of excitation tells most laws apart."
        )
    return "Something is missing that no law of the library explains, nor two of them. Do not name a cause."


def _more(rest: Rest) -> str:
    return f"and something more remains: {100 * rest.share:.2g} % of the misfit"


def _where(found: RecordDiagnosis) -> str:
    if found.kind == NOTHING and found.noise:
        return "Nowhere: no force that follows from the motion of any place explains what is left."
    if found.kind == NOTHING:
        return "Nowhere: model and records part no more than their accuracies let expect."
    if found.kind in (NAMED, ONE_OF):
        return "; ".join(_capital(where(one)) for one in leaders(found)) + "."
    best = found.best
    if best is None or not best.causes:
        return "No place can be given."
    return f"No place can be given for certain; the nearest explanation stands {place(best.causes[0].site)}."


def _what(found: RecordDiagnosis) -> str:
    baseline, best = found.baseline, found.best
    left = f"The linear model leaves {baseline.chi2 / baseline.dof:.4g} times the variance that the accuracy of the channels has"
    if found.kind == NOTHING and found.noise:
        return f"{left}. {_noise(found)}"
    if found.kind == NOTHING:
        return f"{left}: by chance it would be more {chance(baseline.p)}, and less than 1.1 times is taken as none."
    if best is None or not best.causes:
        return f"{left}; no law was found that leaves less."
    after = f"with {best.title} {best.chi2 / best.dof:.4g} times"
    gained = f"ln evidence over none {best.log_evidence - baseline.log_evidence:.4g}"
    told = f"{left}, {after} ({gained}). P holds on condition that the cause is one law of the library, or two, at their places."
    return f"{told} {_noise(found)}" if found.noise else told


def _noise(found: RecordDiagnosis) -> str:
    """What is left and is taken for noise, and why."""
    noise = found.noise
    sizes = ", ".join(f"{name} {size:.3g}" for name, size in zip(found.channels, noise.size, strict=True))
    level = "the level does not vary enough to tell whether it grows with the motion"
    if noise.grows == noise.grows:
        level = "it does not grow with the motion"
    return (
        f"What is left (rms: {sizes}) has a spectrum of its own, and is taken for noise, of disturbing forces, hum or drift: "
        f"no law at any place takes more than {100 * noise.explained:.2g} % of it, and {level}."
    )


def _how_much(found: RecordDiagnosis) -> str:
    if found.kind not in (NAMED, ONE_OF):
        return "Nothing to be sized." if found.kind == NOTHING else "Without a cause there is no size."
    return "; ".join(f"{_capital(cause.title)}: {sized(cause)}" for one in leaders(found) for cause in one.causes) + "."


def _true(found: RecordDiagnosis) -> str:
    if not found.scores:
        return "Not proved: the records are too short to hold anything out."
    told = " ".join(_proof(one) for one in found.scores)
    return f"Records that no fit has seen, rms of what is left of the outputs: {told}"


def _proof(one: RecordScore) -> str:
    size = lambda error: f"{100 * ((error / one.signal) ** 2).mean() ** 0.5:.3g} %"
    name = f"'{one.title}'"
    if WITH_CAUSE not in one.short:
        return (
            f"{name} {size(one.short[AS_IT_IS])} over {one.horizon_s:.2g} s, {size(one.free[AS_IT_IS])} over the whole."
        )
    pair = lambda errors: f"from {size(errors[AS_IT_IS])} to {size(errors[WITH_CAUSE])}"
    return f"{name} {pair(one.short)} over {one.horizon_s:.2g} s, {pair(one.free)} over the whole."


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


SECTION = Section("record-answers", 10, "Diagnosis", answers, (RecordDiagnosis,))
