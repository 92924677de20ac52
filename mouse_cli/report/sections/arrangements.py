"""What the report says of a diagnosis of several configurations."""

from collections.abc import Iterator

from mouse_cli._texts import capital
from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import UNKNOWN, Explanation
from mouse_cli.report.arrangements_sentences import sentences
from mouse_cli.report.asked import considered
from mouse_cli.report.blocks import Block, Cell, Column, Heading, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import SCORES, nats, p_value, per_cent, probable, scored, where
from mouse_cli.report.sections._field import field_blocks, untried_text
from mouse_cli.report.sections._wording import LEFT, counted, deck_table, worded
from mouse_cli.report.theory import stated


def answers(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """The verdict, one paragraph a mechanism, what is left, whether it is true."""
    yield from map(Text, sentences(found))
    yield from field_blocks(found.field, found.problem.units)
    if found.refuted:
        yield Text(
            f"Refuted by the configurations held out, which are predicted worse with it than without: {found.refuted}."
        )
    yield Heading("Remainder", 2)
    yield Text(
        f"Chi-square {found.chi2:.1f} on {found.dof}, goodness of fit {p_value(found.p)}. "
        "Sizes with all mechanisms in the model are under Parameters; those above are as each was identified."
    )
    yield Heading("Validated?", 2)
    yield Text(_true(found))


def _true(found: ArrangementsDiagnosis) -> str:
    held = found.held_out
    if held is None:
        return "Not proved: no configuration was held out (`--held-out`)."
    base, after = held.baseline, held.revised
    errors = f"the root mean square error of {len(held.labels)} frequencies is {100 * base.rms_frequency_error:.2g} %"
    seen = "Configurations that no fit has seen"
    if after is None:
        return f"{seen}: {errors}, and {100 * base.covered:.0f} % lie within their 90 % intervals."
    return (
        f"{seen}: {errors} without any mechanism, and {100 * after.rms_frequency_error:.2g} % with all; the log predictive "
        f"density goes from {base.log_predictive_density:.1f} to {after.log_predictive_density:.1f}, and "
        f"{100 * after.covered:.0f} % lie within their 90 % intervals. Parameters and errors of theory are revised in both."
    )


_PARAMETERS_COLUMNS = heads(Column("parameter", align=LEFT, literal=True), "<unit | before | revised | sd")
_ERRORS = heads("mode | theory errs [per cent] | sd [per cent]")


def parameters(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """Those of the decks first, then those of the causes."""
    revised = (found.extended or found.problems)[0].parameters
    rows = tuple(
        (p.name, p.unit, f"{p.nominal:.5g}" if i < len(found.problem.parameters) else "", f"{value:.5g}", f"{sd:.2g}")
        for i, (p, value, sd) in enumerate(zip(revised, found.values, found.sd, strict=True))
    )
    if rows:
        yield Table(_PARAMETERS_COLUMNS, rows)
    yield Text("Errors of theory in ln f that all configurations share:")
    yield Table(_ERRORS, tuple((e.mode, f"{100 * e.value:.2f}", f"{100 * e.sd:.2g}") for e in found.shared))


def remarks(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """What a careful reader of a diagnosis of arrangements should know. One paragraph each."""
    for text in found.remarks:
        yield Text(f"{capital(text)}.")
    yield from worded((remark for each in found.problems for remark in each.warnings), options)


def heading(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """What was diagnosed: the decks of all arrangements, and how well theory is held to know them."""
    first = found.problem
    yield deck_table(first)
    data = sum(each.test.m for each in found.problems)
    unseen = 0 if found.held_out is None else len(found.held_out.labels)
    yield Text(
        f"{counted(len(found.problems), 'configuration')} of one structure, {counted(data, 'measured mode')} in all, fitted "
        f"together; {counted(unseen, 'frequency', 'frequencies')} of other configurations held out. They share "
        f"{counted(len(first.parameters), 'parameter')} and every mechanism."
    )
    yield Text(considered(found.choices))
    yield Text(f"{stated(found)} What the decks state of their tests comes in addition, independent in each.")
    yield Text(f"Fitted: {', '.join(each.source.path for each in found.problems)}.")
    if found.changed is not None:
        own = [each.source.path for each, has in zip(found.problems, found.changed, strict=True) if has]
        yield Text(f"Mechanisms are sought in the changed configurations only: {', '.join(own)}.")


_SHOWN = 6  # of each turn
_TURNS_COLUMNS = heads("<candidate | <site | log evidence over none | probability | chi-square")


def turns(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """One table a step, and what was tried with all mechanisms in the model and is not demanded."""
    explains = found.kind != UNKNOWN
    for number, turn in enumerate(found.turns, 1):
        yield Heading(f"Step {number}: {turn.best.title}", 2)
        yield _table(turn.before, turn.explanations, explains)
        if turn.noise_scale > 1:
            yield Text(
                f"The best of these leaves {turn.noise_scale:.3g} times the variance that the decks state: more is missing, and "
                "the evidence is computed with that much noise."
            )

    yield Heading("With all of these in the model, not demanded", 2)
    yield _table(found.rest[0], found.rest, explains)
    yield from untried_text(found.untried)


def _table(before: Explanation, tried: tuple[Explanation, ...], explains: bool) -> Table:
    """explains: whether all mechanisms together explain the data; else no probability is given."""
    order = sorted(tried, key=lambda one: -one.probability)
    rows = tuple(_row(before, one, explains) for one in order[:_SHOWN])
    return Table(_TURNS_COLUMNS, rows).without_empty_columns()


def _row(before: Explanation, one: Explanation, explains: bool) -> tuple[Cell, ...]:
    over = nats(one.log_evidence - before.log_evidence)
    return one.physics, where(one), over, probable(one.probability) if explains else None, f"{one.chi2:.1f}"


_ROWS = heads(
    "<frequency | test [Hz] | as it is [Hz] | error [per cent] | with all mechanisms [Hz] | sd [Hz] | error [per cent]"
)


def held_out(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """Scores turn by turn, then one line a frequency; nothing without such data."""
    held = found.held_out
    if held is None:
        return
    after = held.revised
    scores = [("as it is", held.baseline)]
    scores += [(f"with {turn.best.title}", turn.held) for turn in found.turns if turn.held is not None]
    scores += [] if after is None else [("with all mechanisms, fitted together", after)]
    yield Table(SCORES, tuple(scored(name, score) for name, score in scores))
    off = 100 * (held.baseline.frequencies_hz / held.measured_hz - 1)
    columns = [held.measured_hz, held.baseline.frequencies_hz, map(per_cent, off)]
    if after is not None:
        left = 100 * (after.frequencies_hz / held.measured_hz - 1)
        columns += [after.frequencies_hz, (f"{sd:.2g}" for sd in after.sd_hz), map(per_cent, left)]
    yield Table(_ROWS[: len(columns) + 1], tuple(zip(held.labels, *columns, strict=True)))


SECTIONS = (
    Section("arrangements-answers", 10, "Diagnosis", answers, (ArrangementsDiagnosis,), place=VERDICT),
    Section("arrangements-parameters", 50, "Parameters", parameters, (ArrangementsDiagnosis,), place=RESULT),
    Section("arrangements-remarks", 90, "Remarks", remarks, (ArrangementsDiagnosis,), place=RESULT),
    Section("arrangements-heading", 20, "Decks", heading, (ArrangementsDiagnosis,)),
    Section("arrangements-turns", 40, "Evidence", turns, (ArrangementsDiagnosis,)),
    Section(
        "arrangements-held-out", 80, "Configurations held out, before and after", held_out, (ArrangementsDiagnosis,)
    ),
)
