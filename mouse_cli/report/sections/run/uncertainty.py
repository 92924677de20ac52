"""How well the revised properties are known."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Matrix, Table, Text, heads
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import finite, names

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
        ("relative error of the answer by that of the data", finite(found.data)),
        ("relative error of the answer by that of the sensitivities", finite(found.sensitivities)),
        *last,
    )
    yield Table(heads("<bound | at most"), tuple(row for row in rows if row[1] is not None))
    stands = ", with the prior among the data" if found.with_prior else ""
    yield Text(
        f"Lengths are in prior standard deviations{stands}; the bounds hold to first order, for errors of any kind, and are met by "
        "the worst one. Least known is " + _weakest(result) + "."
    )
    if not np.isfinite(found.condition):
        yield Text("The sensitivities leave some combination of the properties undetermined.")


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


def covariance(result: Result, options: Options) -> Iterator[Block]:
    """S* and correlations in full for a few properties, else the strongest correlations."""
    if not result.status.answered:
        return
    if result.covariance is None:
        yield Text(
            f"The covariance of {len(result.problem.parameters)} properties was not formed; `print_covariance: true` in the deck "
            "or --print-covariance forms it. Their standard deviations stand above."
        )
        return
    labels, correlation = names(result.problem), _correlation(result)
    if len(labels) <= options.properties:
        shown = np.where(np.isnan(correlation), np.nan, result.covariance)
        yield Matrix("covariance S* of the revised properties", shown, labels, labels)
        if len(labels) > 1:
            yield Matrix("correlation of the revised properties", correlation, labels, labels)
        return
    strength = np.nan_to_num(np.abs(np.triu(correlation, 1)))
    most = min(options.correlations, strength.size)
    flat = np.argpartition(-strength, most - 1, axis=None)[:most]
    pairs = sorted(zip(*np.unravel_index(flat, strength.shape), strict=True), key=lambda p: (-strength[p], p))
    columns = heads("<property | <property | correlation")
    rows = tuple((labels[i], labels[j], correlation[i, j]) for i, j in pairs if strength[i, j] > 0)
    if not rows:
        yield Text("The revised properties are not correlated.")
        return
    yield Text(f"The strongest {len(rows)} correlations among {len(labels)} properties:")
    yield Table(columns, rows, keys=2)


def _correlation(result: Result) -> np.ndarray:
    """Correlation (p, p); NaN for properties that are held or at a limit."""
    sd = np.where(result.at_limit | (result.sd_theta == 0), np.nan, result.sd_theta)
    return result.covariance / sd[:, None] / sd


SECTIONS = (
    Section("conditioning", 112, "How errors reach the answer", conditioning),
    Section("covariance", 110, "Covariance of the revised properties", covariance, place=APPENDIX),
)
