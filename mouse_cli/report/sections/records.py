"""What the report says of a diagnosis or an update by recordings."""

from collections.abc import Iterator

import numpy as np

from mouse_cli._texts import capital
from mouse_cli.model.diagnosis import NAMED, NOTHING, ONE_OF, UNKNOWN, elsewhere
from mouse_cli.model.record_diagnosis import AS_IT_IS, WITH_CAUSE, RecordDiagnosis, RecordScore
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.report.asked import considered
from mouse_cli.report.blocks import Block, Column, Heading, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import leaders, p_value, rivals_of_site, sized, where, with_p, within
from mouse_cli.report.sections._field import field_blocks
from mouse_cli.report.sections._wording import counted, deck_table, worded
from mouse_cli.report.sections.diagnosis.evidence import evidence
from mouse_cli.report.theory import stated
from mouse_cli.report.verdict_sentences import remains, sentences

_MOST = 0.5  # of chi2 of the model as it is, that the nearest explanation may leave to say where to look
_LOUD = 10.0  # % of a held-out record that is noise, from which on that is told


def answers(found: RecordDiagnosis, options: Options) -> Iterator[Block]:
    """The answers of a diagnosis by recordings, in plain sentences: what, where, how much, and is it true."""
    yield Text(" ".join(sentences(found)))
    yield from field_blocks(found.field, found.problem.units)
    yield from (Text(text) for text in found.cautions)
    for question, answer in (
        ("Where?", _where(found)),
        ("What?", _what(found)),
        ("How much?", _how_much(found)),
        ("Validated?", _true(found)),
    ):
        if answer:
            yield Heading(question, 2)
            yield Text(answer)


def _where(found: RecordDiagnosis) -> str:
    if found.kind == NOTHING and found.noise:
        return "Nowhere: no force that follows from the motion of any site explains the residual."
    if found.kind == NOTHING:
        return ""
    if found.kind in (NAMED, ONE_OF):
        at = lambda one: f"{where(one)}{rivals_of_site(elsewhere(found.explanations, one))}"
        return "; ".join(capital(at(one)) for one in leaders(found)) + "."
    near = found.nearest
    if near is None or near.chi2 > _MOST * found.baseline.chi2:
        return "No site can be given."
    return f"No site can be given. The nearest explanation, which does not suffice, has it here: {where(near)}."


def _what(found: RecordDiagnosis) -> str:
    baseline, best = found.baseline, found.nearest if found.kind == UNKNOWN else found.best
    left = f"The linear model leaves {baseline.chi2 / baseline.dof:.4g} times the variance that the accuracy of the channels has"
    if found.kind == NOTHING and found.noise:
        return f"{left}. {_noise(found)}"
    if found.kind == NOTHING and len(found.explanations) > 1:
        return f"{left}: goodness of fit {p_value(baseline.p)}, but no law at any site has a log evidence over none."
    if found.kind == NOTHING:
        return f"{left}: goodness of fit {p_value(baseline.p)}, and less than 1.1 times is taken as none."
    if best is None or not best.causes:
        return f"{left}; no law was found that leaves less."
    after = f"with {best.title} {best.chi2 / best.dof:.4g} times"
    gained = f"log evidence over none {best.log_evidence - baseline.log_evidence:.4g}"
    text = f"{left}, {after} ({gained}).{_conditional(found)}"
    return f"{text} {_noise(found)}" if found.noise else text


def _conditional(found: RecordDiagnosis) -> str:
    """What probabilities are of; none is given where no explanation is adequate."""
    if found.leader is None:
        return ""
    inside = within(found.explanations, found.leader)
    text = (
        f" Group {found.leader.group}: {with_p(found.probability)}{f', members within it: {inside}' if inside else ''}."
    )
    text += f" That is not all: {remains(found.rest)}." if found.rest is not None else ""
    return f"{text} Probabilities are conditional on the mechanisms being laws of the library at their sites."


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
        return "" if found.kind == NOTHING else "Without a mechanism there is no size."
    return "; ".join(f"{capital(cause.title)}: {sized(cause)}" for one in leaders(found) for cause in one.causes) + "."


def _true(found: RecordDiagnosis) -> str:
    if not found.scores:
        return "Not proved: the records are too short to hold anything out."
    scores = " ".join(_proof(one) for one in found.scores)
    return f"Held-out records, rms residual of the outputs: {scores}"


def _proof(one: RecordScore) -> str:
    share = lambda error: 100 * ((error / one.signal) ** 2).mean() ** 0.5
    size = lambda error: f"{share(error):.3g} %" if share(error) < float("inf") else "divergence"
    name = f"'{one.title}'"
    noise = np.nan if one.noise is None else share(one.noise)
    loud = f"; noise alone is {noise:.3g} %" if noise > _LOUD else ""
    if WITH_CAUSE not in one.short:
        return f"{name} {size(one.short[AS_IT_IS])} over {one.horizon_s:.2g} s, {size(one.free[AS_IT_IS])} over the whole{loud}."
    pair = lambda errors: f"from {size(errors[AS_IT_IS])} to {size(errors[WITH_CAUSE])}"
    return f"{name} {pair(one.short)} over {one.horizon_s:.2g} s, {pair(one.free)} over the whole{loud}."


def update(found: RecordUpdate, options: Options) -> Iterator[Block]:
    """The verdict on the model, then one line a parameter."""
    residual = found.residual
    yield Text(
        f"{capital(found.message)}. It leaves {residual.chi2 / residual.dof:.4g} times the variance that the "
        f"accuracy of the channels has; standard deviations are for {found.noise_scale:.4g} times."
    )
    columns = heads("<property | <unit | prior | prior sd | revised | sd")
    prior = found.problem.prior
    table = zip(found.problem.parameters, prior.mean, prior.sd, found.theta, found.sd_theta, strict=True)
    rows = [(p.name, p.unit, *(f"{value:.5g}" for value in values)) for p, *values in table]
    yield Table(columns, tuple(rows)).without_empty_columns()
    yield from _laws(found)


def _laws(found: RecordUpdate) -> Iterator[Block]:
    if not found.laws:
        return
    columns = heads("<law | <place | <size | <unit | deck | revised | sd")
    rows = [
        (
            one.title,
            one.site.text,
            size.name,
            size.unit,
            f"{given.values[size.name]:.5g}",
            f"{size.value:.5g}",
            f"{size.sd:.3g}",
        )
        for one, given in zip(found.laws, found.problem.laws, strict=True)
        for size in one.sizes
    ]
    yield Table(columns, tuple(rows))


def remarks(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """What a careful reader of a diagnosis by recordings should know. One paragraph each."""
    for text in found.remarks:
        yield Text(f"{capital(text)}.")
    for each in getattr(found, "untried", ()):
        yield Text(f"Not considered: {each.physics} ({each.reason}).")
    yield from worded(found.problem.warnings, options)


def heading(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """What was diagnosed by recordings: deck, model, records and the accuracy that was taken for them."""
    problem = found.problem
    excited = f"force at {', '.join(found.inputs)}" if found.inputs else "free decays"
    beside = " beside each law" if isinstance(found, RecordDiagnosis) else ""
    yield deck_table(problem)
    yield Text(
        f"{counted(len(found.fitted), 'recording')} fitted ({', '.join(found.fitted)}), "
        f"{counted(len(found.scores), 'record')} held out; "
        f"{excited}; a model of {counted(problem.structure.n, 'degree', 'degrees')} of freedom with "
        f"{counted(len(problem.parameters), 'parameter')}, which were revised{beside}."
    )
    columns = heads("<output | <unit | sd taken")
    yield Table(columns, tuple(zip(found.channels, found.units, (f"{sd:.3g}" for sd in found.sd), strict=True)))
    yield Text(
        "The sd is the floor of the spectrum of the output, and at least 1 % of its rms: no transducer is better."
    )
    if isinstance(found, RecordDiagnosis):
        yield Text(considered(found.choices))
    yield Text(stated(found))


def linearity(found: RecordDiagnosis, options: Options) -> Iterator[Block]:
    """Signs of nonlinearity in recordings. Coherence, distortion, levels; nothing where no sign could be read."""
    signs = found.linearity
    if np.isfinite(signs.incoherent):
        yield Text(
            f"Coherence of force and first output is below 0.95 over {100 * signs.incoherent:.0f} % of the excited band."
        )
    if np.isfinite(signs.even) or np.isfinite(signs.odd):
        yield Text(_distortion(signs))
    if signs.levels:
        columns = heads("<stretches | rms of the first output | first resonance [Hz] | damping ratio [per cent]")
        rows = zip(("quietest third", "loudest third"), signs.levels, strict=True)
        yield Table(
            columns,
            tuple((name, f"{s.rms:.3g}", f"{s.frequency_hz:.5g}", f"{100 * s.damping:.3g}") for name, s in rows),
        )
        yield Text(
            "The linear model fitted to either alone. A linear structure has the same frequency and damping at all levels."
        )


def _distortion(signs) -> str:
    parts = [
        f"{name} {100 * value:.2g} %"
        for name, value in (("even lines", signs.even), ("odd lines", signs.odd), ("noise", signs.noise))
        if np.isfinite(value)
    ]
    return f"Response at lines that the force leaves out, by that at the others: {', '.join(parts)}."


def held_out(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """Records that no fit has seen, under the model as it is and with the cause. One line a record and output."""
    if not found.scores:
        return
    columns = heads(
        "<record | <output | rms measured | short horizon, as it is",
        Column(found.after),
        "whole record, as it is",
        Column(found.after),
    )
    rows = [
        (
            one.title,
            channel,
            f"{one.signal[i]:.4g}",
            *(_error(part, name, i) for part in (one.short, one.free) for name in (AS_IT_IS, WITH_CAUSE)),
        )
        for one in found.scores
        for i, channel in enumerate(found.channels)
    ]
    yield Table(columns, tuple(rows)).without_empty_columns()
    yield Text(
        f"rms of measured less simulated. Short horizons are of {found.scores[0].horizon_s:.3g} s, each with the initial state "
        "that fits it best, for both models alike: where trajectories diverge, as under impacts, a whole record judges nothing."
    )


def _error(errors: dict, name: str, i: int) -> str:
    if name not in errors:
        return ""
    return f"{errors[name][i]:.4g}" if errors[name][i] < float("inf") else "diverges"


SECTIONS = (
    Section("record-answers", 10, "Diagnosis", answers, (RecordDiagnosis,), place=VERDICT),
    Section("record-update", 10, "Update by recordings", update, (RecordUpdate,), place=VERDICT),
    Section("record-evidence", 40, "Evidence", evidence, (RecordDiagnosis,), place=RESULT),
    Section("record-remarks", 90, "Remarks", remarks, (RecordDiagnosis, RecordUpdate), place=RESULT),
    Section("record-heading", 20, "Deck", heading, (RecordDiagnosis, RecordUpdate)),
    Section("record-linearity", 30, "Is it linear?", linearity, (RecordDiagnosis,)),
    Section("record-held-out", 80, "Held-out records", held_out, (RecordDiagnosis, RecordUpdate)),
)
