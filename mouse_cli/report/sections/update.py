"""What the report says of an update by one method."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.arrays import dense
from mouse_cli.model.updated import ASPECTS, Checked, Predicted, Updated
from mouse_cli.report.blocks import Block, Column, Heading, Matrix, Table, Text, heads
from mouse_cli.report.section import APPENDIX, RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table, worded


def remarks(found: Updated, options: Options) -> Iterator[Block]:
    """What forbids to trust an updated model, in words. One paragraph a remark."""
    if not found.warnings:
        yield Text(_sound(found))
    yield from worded((*found.warnings, *found.problem.warnings), options)


def _sound(found: Updated) -> str:
    """What an answer without remarks is worth."""
    if any(not one.fitted for one in found.configurations):
        return "The model is physical, reproduces the fitted data and predicts the held-out data."
    return "The model is physical and reproduces the fitted data; no data were held out for validation."


_ROUNDING = 1e-6  # per cent
_FREQUENCIES_COLUMNS = heads(
    "mode | test frequency [Hz] | prior model [Hz] | difference [per cent] | updated model [Hz] | "
    "difference [per cent] | MAC"
)


def frequencies(found: Updated, options: Options) -> Iterator[Block]:
    """Frequencies by the updated model: those fitted, those held out, and those of the changed structure."""
    for one in found.configurations:
        yield Heading(
            f"{'Fitted modes' if one.fitted else one.title}, {'used' if one.fitted else 'not used'} by the method", 2
        )
        rows = tuple(_row(one, i) for i in range(len(one.number)))
        yield Table(_FREQUENCIES_COLUMNS, rows).without_empty_columns()
        if one.rms_percent == one.rms_percent:
            yield Text("Root mean square difference of the updated model: {} per cent.", (cleared(one.rms_percent),))


def _row(one: Predicted, i: int) -> tuple:
    test, prior, revised = (float(values[i]) for values in (one.test_hz, one.prior_hz, one.revised_hz))
    off = [cleared(100 * (hz / test - 1)) for hz in (prior, revised)]
    return one.number[i], test, prior, off[0], revised, off[1], one.mac[i]


def cleared(percent: float) -> float:
    """A difference in per cent, 0 where it is rounding."""
    return 0.0 if abs(percent) < _ROUNDING else percent


_PROPERTIES_COLUMNS = heads(
    Column("property", align=LEFT, literal=True),
    Column("unit", align=LEFT, literal=True),
    "before | after | change [per cent]",
)


def properties(found: Updated, options: Options) -> Iterator[Block]:
    """One line a property; nothing for methods that revise a matrix."""
    if not found.moved:
        return
    rows = [
        (m.name, m.unit, m.before, m.after, 100 * (m.after / m.before - 1) if m.before else None) for m in found.moved
    ]
    yield Table(_PROPERTIES_COLUMNS, tuple(rows[: options.elements])).without_empty_columns()
    if len(rows) > options.elements:
        yield Text(f"{counted(len(rows) - options.elements, 'further property', 'further properties')}: see --json.")
    bounds = found.conditioning
    if bounds is not None:
        kappa = "is {}" if np.isfinite(bounds.condition) else "is infinite: some combination is not determined"
        values = (bounds.condition,) if np.isfinite(bounds.condition) else ()
        yield Text(f"The condition number of the least-squares equations {kappa}.", values)
        if np.isfinite(bounds.data) and np.isfinite(bounds.sensitivities):
            yield Text(
                "An error of their right side is at most {} times as large, relative, in the answer, and one of their "
                "coefficients {} times.",
                (bounds.data, bounds.sensitivities),
            )


def heading(found: Updated, options: Options) -> Iterator[Block]:
    """Heading of an update by one method: program, deck, method, how it ended. What was done, by which equation."""
    about, test = found.about, found.problem.test
    yield deck_table(found.problem)
    yield Text(f"Method: {about.title} ({about.source}).")
    yield Text(f"    {about.equation}.")
    if test is not None:
        used = f"{counted(test.m, 'measured mode')} at {counted(test.s, 'sensor')}"
        how = (
            f", expanded to {found.problem.structure.n} degrees of freedom by {found.expansion}"
            if found.expansion
            else ""
        )
        yield Text(f"Used: {used}{how}.")
    if found.iterations > 1:
        ended = "settled" if found.converged else "not settled"
        yield Text(
            f"{found.iterations} iterations, {ended}; the last one changed the answer by {{}} of itself.",
            (found.change,),
        )


_GUARANTEES_COLUMNS = heads("<what a structure has | <guaranteed | <here | <because")


def guarantees(found: Updated, options: Options) -> Iterator[Block]:
    """What a method guarantees for any data, beside what it came to for these. One line for each aspect."""
    here = came_to(found.checked)
    yield Table(
        _GUARANTEES_COLUMNS, tuple((g.aspect, g.given, here.get(g.aspect, ""), g.why) for g in found.about.guarantees)
    )


def came_to(checked: Checked) -> dict[str, str]:
    """What became of the aspects that can be counted."""
    modes, definite, rigid, sparse, _ = ASPECTS
    return {
        modes: "" if checked.misfit != checked.misfit else f"force left: {checked.misfit:.1g} of inertia",
        definite: f"{checked.negative} negative eigenvalues" if checked.negative else "no negative eigenvalue",
        rigid: f"{checked.rigid} of {checked.rigid_before}",
        sparse: f"{checked.filled} of {checked.stored + checked.filled} elements new",
    }


def matrix(found: Updated, options: Options) -> Iterator[Block]:
    """The updated stiffness matrix, where it fits the page. K; --json holds it up to 140 degrees of freedom."""
    if found.problem.structure.n <= options.matrix_dofs:
        labels = found.problem.structure.labels
        yield Matrix("updated stiffness matrix", dense(found.K), labels, labels)


SECTIONS = (
    Section("update-remarks", 60, "Verdict", remarks, (Updated,), place=VERDICT),
    Section("update-frequencies", 30, "Test against model, before and after", frequencies, (Updated,), place=RESULT),
    Section("update-properties", 40, "Revised properties", properties, (Updated,), place=RESULT),
    Section("update-heading", 10, "Updating by one method", heading, (Updated,)),
    Section("update-guarantees", 20, "What the method guarantees, and what came of it", guarantees, (Updated,)),
    Section("update-matrix", 50, "Updated stiffness matrix", matrix, (Updated,), place=APPENDIX),
)
