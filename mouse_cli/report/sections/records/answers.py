"""The answers of a diagnosis by recordings, in plain sentences: what, where, how much, and is it true."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, elsewhere
from mouse_cli.model.record_diagnosis import AS_IT_IS, WITH_CAUSE, RecordDiagnosis, RecordScore
from mouse_cli.report.blocks import Block, Heading, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import leaders, p_value, rivals_of_site, sized, where, with_p, within
from mouse_cli.report.sections._field import field_blocks
from mouse_cli.report.verdict_sentences import remains, sentences


def answers(found: RecordDiagnosis, options: Options) -> Iterator[Block]:
    """The verdict, then the answers one by one."""
    yield Text(" ".join(sentences(found)))
    yield from field_blocks(found.field, found.problem.units)
    yield from (Text(text) for text in found.cautions)
    for question, told in (
        ("Where?", _where(found)),
        ("What?", _what(found)),
        ("How much?", _how_much(found)),
        ("Validated?", _true(found)),
    ):
        yield Heading(question, 2)
        yield Text(told)


def _where(found: RecordDiagnosis) -> str:
    if found.kind == NOTHING and found.noise:
        return "Nowhere: no force that follows from the motion of any site explains the residual."
    if found.kind == NOTHING:
        return "Nowhere: model and records are consistent within their accuracies."
    if found.kind in (NAMED, ONE_OF):
        at = lambda one: f"{where(one)}{rivals_of_site(elsewhere(found.explanations, one))}"
        return "; ".join(_capital(at(one)) for one in leaders(found)) + "."
    best = found.best
    if best is None or not best.causes:
        return "No site can be given."
    return f"No site can be given. The nearest explanation, which does not suffice, has it here: {where(best)}."


def _what(found: RecordDiagnosis) -> str:
    baseline, best = found.baseline, found.best
    left = f"The linear model leaves {baseline.chi2 / baseline.dof:.4g} times the variance that the accuracy of the channels has"
    if found.kind == NOTHING and found.noise:
        return f"{left}. {_noise(found)}"
    if found.kind == NOTHING:
        return f"{left}: goodness of fit {p_value(baseline.p)}, and less than 1.1 times is taken as none."
    if best is None or not best.causes:
        return f"{left}; no law was found that leaves less."
    after = f"with {best.title} {best.chi2 / best.dof:.4g} times"
    gained = f"log evidence over none {best.log_evidence - baseline.log_evidence:.4g}"
    told = f"{left}, {after} ({gained}).{_conditional(found)}"
    return f"{told} {_noise(found)}" if found.noise else told


def _conditional(found: RecordDiagnosis) -> str:
    """What probabilities are of; none is given where no explanation is adequate."""
    if found.leader is None:
        return ""
    inside = within(found.explanations, found.leader)
    told = (
        f" Group {found.leader.group}: {with_p(found.probability)}{f', members within it: {inside}' if inside else ''}."
    )
    told += f" That is not all: {remains(found.rest)}." if found.rest is not None else ""
    return f"{told} Probabilities hold on condition that the mechanisms are laws of the library at their sites."


def _noise(found: RecordDiagnosis) -> str:
    """What is left and is taken for noise, and why."""
    noise = found.noise
    sizes = ", ".join(f"{name} {size:.3g}" for name, size in zip(found.channels, noise.size, strict=True))
    level = "the level does not vary enough to show whether it grows with the motion"
    if noise.grows == noise.grows:
        level = "it does not grow with the motion"
    return (
        f"The residual (rms: {sizes}) has a spectrum of its own, and is taken for noise, of disturbing forces, hum or drift: "
        f"no law at any site takes more than {100 * noise.explained:.2g} % of it, and {level}."
    )


def _how_much(found: RecordDiagnosis) -> str:
    if found.kind not in (NAMED, ONE_OF):
        return "Nothing to be sized." if found.kind == NOTHING else "Without a mechanism there is no size."
    return "; ".join(f"{_capital(cause.title)}: {sized(cause)}" for one in leaders(found) for cause in one.causes) + "."


def _true(found: RecordDiagnosis) -> str:
    if not found.scores:
        return "Not proved: the records are too short to hold anything out."
    told = " ".join(_proof(one) for one in found.scores)
    return f"Held-out records, rms residual of the outputs: {told}"


def _proof(one: RecordScore) -> str:
    share = lambda error: 100 * ((error / one.signal) ** 2).mean() ** 0.5
    size = lambda error: f"{share(error):.3g} %" if share(error) < float("inf") else "divergence"
    name = f"'{one.title}'"
    if WITH_CAUSE not in one.short:
        return (
            f"{name} {size(one.short[AS_IT_IS])} over {one.horizon_s:.2g} s, {size(one.free[AS_IT_IS])} over the whole."
        )
    pair = lambda errors: f"from {size(errors[AS_IT_IS])} to {size(errors[WITH_CAUSE])}"
    return f"{name} {pair(one.short)} over {one.horizon_s:.2g} s, {pair(one.free)} over the whole."


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


SECTION = Section("record-answers", 10, "Diagnosis", answers, (RecordDiagnosis,), place=VERDICT)
