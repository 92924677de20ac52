"""Campaigns as long tables for spreadsheets and data frames: one line for each run and each quantity; no cell is a formula."""

from collections.abc import Iterable, Iterator

from mouse_cli._texts import csv_text
from mouse_cli.model.campaign import Answered, Bootstrap, Spread, Sweep


def text(found: Sweep | Bootstrap) -> str:
    """The table of `found` in CSV."""
    return csv_text(_swept(found) if isinstance(found, Sweep) else _drawn(found))


_ENDED = ("exit", "ended", "model_form", "chi2", "p")
_QUANTITY = ("quantity", "name", "unit", "value", "posterior_sd")


def _swept(found: Sweep) -> Iterator[tuple]:
    yield ("point", *found.varied, *_ENDED, *_QUANTITY)
    for i, (point, answer) in enumerate(zip(found.points, found.answers, strict=True), 1):
        for quantity in _quantities(answer, found.parameters, found.frequencies):
            yield (i, *point, *_ended(answer), *quantity)


def _drawn(found: Bootstrap) -> Iterator[tuple]:
    yield ("kind", "replicate", *found.units, *_ENDED, *_QUANTITY)
    ones = [1] * len(found.units)
    without = [[int(i != j) for j in range(len(found.units))] for i in range(len(found.units))]
    for kind, counts, answers in (
        ("deck", [ones], [found.answer]),
        ("left out", without, found.left_out),
        ("replicate", found.counts.tolist(), found.replicates),
    ):
        for i, (count, answer) in enumerate(zip(counts, answers, strict=True), 1):
            for quantity in _quantities(answer, found.parameters, found.frequencies):
                yield (kind, i, *count, *_ended(answer), *quantity)


def _ended(answer: Answered) -> tuple:
    return answer.exit_code, answer.ended, answer.model_form, answer.chi2, answer.p


def _quantities(answer: Answered, parameters: Iterable, frequencies: Iterable[Spread]) -> Iterator[tuple]:
    for each, value, sd in zip(parameters, answer.theta, answer.sd, strict=True):
        yield "parameter", each.name, each.unit, value, sd
    for each, value in zip(frequencies, answer.hz, strict=True):
        yield "frequency", each.name, "Hz", value, None
