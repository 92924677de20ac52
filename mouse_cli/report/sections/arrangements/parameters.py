"""Parameters with all causes in the model, and what theory errs in each mode."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import RESULT, Options, Section
from mouse_cli.report.sections._wording import LEFT

_COLUMNS = (
    Column("parameter", align=LEFT, literal=True),
    Column("unit", align=LEFT),
    Column("before"),
    Column("revised"),
    Column("sd"),
)
_ERRORS = (Column("mode"), Column("theory errs", "per cent"), Column("sd", "per cent"))


def parameters(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """Those of the decks first, then those of the causes."""
    told = (found.extended or found.problems)[0].parameters
    rows = tuple(
        (p.name, p.unit, f"{p.nominal:.5g}" if i < len(found.problem.parameters) else "", f"{value:.5g}", f"{sd:.2g}")
        for i, (p, value, sd) in enumerate(zip(told, found.values, found.sd, strict=True))
    )
    if rows:
        yield Table(_COLUMNS, rows)
    yield Text("Errors of theory in ln f that all configurations share:")
    yield Table(_ERRORS, tuple((e.mode, f"{100 * e.value:.2f}", f"{100 * e.sd:.2g}") for e in found.shared))


SECTION = Section("arrangements-parameters", 50, "Parameters", parameters, (ArrangementsDiagnosis,), place=RESULT)
