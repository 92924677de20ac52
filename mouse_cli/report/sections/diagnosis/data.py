"""The deck of a diagnosis, and its data before and after."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.diagnosis import BY_DECK, BY_MODE, ONE_OF, Diagnosis, Score
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.result import Result
from mouse_cli.model.units import system
from mouse_cli.report.asked import considered
from mouse_cli.report.blocks import Block, Cell, Table, Text, heads
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._diagnosis_wording import SCORES, mac_text, per_cent, predicting, scored, with_cause
from mouse_cli.report.sections._functions import covered, functions
from mouse_cli.report.sections._wording import counted, deck_table, worded
from mouse_cli.report.sections.run.results import held_out_words
from mouse_cli.report.theory import stated


def fitted(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a mode, both models revised by the test."""
    test, after, name = found.problem.test, found.extended_result, _extended(found)
    hz, off, alike = _against(found.result, test)
    hz_after, off_after, alike_after = _against(after, test) if after else np.full((3, test.m), np.nan)
    rows = zip(test.number, test.frequency_hz, hz, off, hz_after, off_after, alike, alike_after, strict=True)
    columns = heads(
        "mode | test frequency [Hz] | model as it is [Hz] | difference [per cent] | "
        f"{name} [Hz] | difference [per cent] | MAC as it is | MAC {name}"
    )
    yield Table(columns, tuple((n, *_fitted_row(row)) for n, *row in rows)).without_empty_columns()
    which = "Both models with their" if after else "The model with its"
    yield Text(f"{which} parameters revised by these data; differences are model minus test.")
    if after and after.model_form == "rejected":
        which = f"model {name}" if found.kind == ONE_OF else name
        yield Text(
            f"At the stated accuracies alone, which `mouse run` takes, the form of the {which} is rejected too: a diagnosis allows "
            "for what theory leaves beside them."
        )


def _extended(found: Diagnosis) -> str:
    """How the model that was extended is called: with what leads where that is one of several, or whatever it is."""
    return with_cause(found) if found.kind == ONE_OF else "extended model"


def _fitted_row(row: list[float]) -> tuple[Cell, ...]:
    test, hz, off, hz_after, off_after, alike, alike_after = map(float, row)
    return test, hz, per_cent(off), hz_after, per_cent(off_after), mac_text(alike), mac_text(alike_after)


def _against(result: Result, test: ModalTest) -> np.ndarray:
    """Frequencies, differences in per cent, MAC (3, m); NaN of modes that are related to none of the model, which no fit holds."""
    model, kept = result.revised, np.isin(test.number, result.problem.test.number)
    hz = frequency_hz(model.eigenvalues[model.modes])
    found = np.full((3, test.m), np.nan)
    found[:, kept] = hz, 100 * (hz / test.frequency_hz[kept] - 1), model.mac
    return found


def remarks(found: Diagnosis, options: Options) -> Iterator[Block]:
    """What a careful reader should know: warnings of the deck and of the update, remarks of the diagnosis."""
    for text in found.remarks:
        yield Text(text if text.endswith(".") else f"{text}.")
    yield from worded((*found.problem.warnings, *found.result.warnings), options)


def heading(found: Diagnosis, options: Options) -> Iterator[Block]:
    """What was diagnosed: program, deck, model and test. Program and deck, then the size of both."""
    problem = found.problem
    yield deck_table(problem)
    held = f" Held out: {held_out_words(problem.hold_out)}." if problem.hold_out else ""
    yield Text(
        f"{counted(problem.test.m, 'measured mode')} at {counted(problem.test.s, 'sensor')}; a model of "
        f"{counted(problem.structure.n, 'degree', 'degrees')} of freedom with "
        f"{counted(len(problem.parameters), 'parameter')}, which were revised beside each candidate.{held}"
    )
    yield Text(_how(found))
    yield Text(stated(found))


def _how(found: Diagnosis) -> str:
    """What was considered, and in which units."""
    run, named = found.problem.run, system(found.problem.units)
    units = (
        f"units of the deck: {named}" if named else "the deck declares no units: numbers are in those it is written in"
    )
    return f"{considered(found.choices)} Estimator: {run.estimator}, recursion: {run.recursion}; {units}."


_COLUMNS = heads("<damping | value | standard deviation | <unit | <")


def fitted_functions(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a function; then loss factor and viscous damping of the structure beside the cause."""
    yield from functions(found.frf)
    if found.damping:
        rows = []
        for d in found.damping:
            unit, doubt = d.unit if d.unit != "1" else "", "" if d.determined else "hardly determined by the FRFs"
            rows.append((f"{d.name}: {d.meaning}", f"{d.value:.4g}", f"{d.sd:.2g}", unit, doubt))
        yield Table(_COLUMNS, rows)
        which = found.frf[0].models[-1].name
        yield Text(
            f"Damping of the structure is that of the {which if len(found.frf[0].models) == 1 else f'model {which}'}."
        )


_HOW = {
    BY_DECK: "The deck holds these data out: no fit has seen them, and no candidate was chosen by them.",
    BY_MODE: "The deck holds nothing out. Each mode in turn was left out, both models fitted to the others, and it was predicted; "
    "the mechanism was chosen with all of them, so that this proves less than data which the deck holds out.",
}


def held_out_data(found: Diagnosis, options: Options) -> Iterator[Block]:
    """One line a frequency, then the scores; nothing without such data."""
    held = found.held_out
    if held is None:
        return
    before, alike = _predicted(held.baseline, held.measured_hz)
    nothing = [np.full(len(held.labels), np.nan)] * 3
    after, alike_after = _predicted(held.revised, held.measured_hz) if held.revised else (nothing, nothing[0])
    rows = zip(held.labels, held.measured_hz, *before, *after, alike, alike_after, strict=True)
    name = predicting(found)
    columns = heads(
        "<held out | measured [Hz] | model as it is [Hz] | sd [Hz] | difference [per cent] | "
        f"{name} [Hz] | sd [Hz] | difference [per cent] | MAC as it is | MAC {name}"
    )
    yield Table(columns, tuple((label, *_held_out_row(row)) for label, *row in rows)).without_empty_columns()
    scores = (("as it is", held.baseline), (name, held.revised))
    yield Table(SCORES, tuple(scored(name, score) for name, score in scores if score is not None))
    yield Text(f"{_HOW[held.kind]} Each sd is that of the difference, by model and measurement.")


def _predicted(score: Score, measured: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    hz = score.frequencies_hz
    return [hz, score.sd_hz, 100 * (hz / measured - 1)], score.mac


def _held_out_row(row: list[float]) -> tuple[Cell, ...]:
    measured, hz, sd, off, hz_after, sd_after, off_after, alike, alike_after = map(float, row)
    before, after = (hz, _fine(sd), per_cent(off)), (hz_after, _fine(sd_after), per_cent(off_after))
    return measured, *before, *after, mac_text(alike), mac_text(alike_after)


def _fine(sd: float) -> str:
    return "" if sd != sd else f"{sd:.2g}"


def held_functions(found: Diagnosis, options: Options) -> Iterator[Block]:
    """The same tables as of those that were fitted, and whether the mechanism predicts them better."""
    yield from functions(found.held_frf)
    yield from covered(found.held_frf)
    for fit in found.held_frf:
        if len(fit.models) > 1 and fit.median_db(fit.revised) > fit.median_db(fit.prior):
            yield Text("The mechanism increases the error of held-out FRFs: that is evidence against it.")


SECTIONS = (
    Section("diagnosis-fitted", 70, "Fitted data, before and after", fitted, (Diagnosis,), place=RESULT),
    Section("diagnosis-remarks", 90, "Remarks", remarks, (Diagnosis,), place=RESULT),
    Section("diagnosis-heading", 20, "Deck", heading, (Diagnosis,)),
    Section(
        "diagnosis-functions", 74, "Frequency response functions, before and after", fitted_functions, (Diagnosis,)
    ),
    Section("diagnosis-held-out", 80, "Held-out data, before and after", held_out_data, (Diagnosis,)),
    Section("diagnosis-held-functions", 84, "Frequency response functions held out", held_functions, (Diagnosis,)),
)
