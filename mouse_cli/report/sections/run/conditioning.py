"""How far errors of the data and of the sensitivities could have moved the answer."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, names

_LISTED = 4  # properties in the combination that is known least
_SHARE = 0.3  # of the largest of them, below which one is not named


def conditioning(result: Result, options: Options) -> Iterator[Block]:
    """The bounds, and the combination of the properties that is known least."""
    found = result.conditioning
    if found is None or not result.status.answered:
        return
    last = () if not found.shift else (("answer, by the estimated error of the sensitivities", found.shift),)
    rows = (
        ("condition number of the weighted sensitivities", found.condition),
        ("relative error of the answer by that of the data", _finite(found.data)),
        ("relative error of the answer by that of the sensitivities", _finite(found.sensitivities)),
        *last,
    )
    yield Table((Column("bound", align=LEFT), Column("at most")), tuple(row for row in rows if row[1] is not None))
    stands = ", with the prior among the data" if found.with_prior else ""
    yield Text(
        f"Lengths are in prior standard deviations{stands}; the bounds hold to first order, for errors of any kind, and are met by "
        "the worst one. Least known is " + _weakest(result) + "."
    )
    if not np.isfinite(found.condition):
        yield Text("The sensitivities leave some combination of the properties undetermined.")


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _weakest(result: Result) -> str:
    """The combination in words: properties by their share of it in prior standard deviations."""
    weight = result.conditioning.weakest
    order = np.argsort(-np.abs(weight), kind="stable")
    largest = np.abs(weight[order[0]])
    shown = [i for i in order[:_LISTED] if np.abs(weight[i]) >= _SHARE * largest]
    sign = np.sign(weight[shown[0]]) or 1.0
    called = names(result.problem)
    parts = [f"{'-' if weight[i] * sign < 0 else '+'} {called[i]}" for i in shown]
    return " ".join(parts).removeprefix("+ ")


SECTION = Section("conditioning", 112, "How errors reach the answer", conditioning)
