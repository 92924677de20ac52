"""S*: how well the revised properties are known together."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Column, Matrix, Table, Text
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import LEFT, names


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
    columns = (Column("property", align=LEFT), Column("property", align=LEFT), Column("correlation"))
    rows = tuple((labels[i], labels[j], float(correlation[i, j])) for i, j in pairs if strength[i, j] > 0)
    if not rows:
        yield Text("The revised properties are not correlated.")
        return
    yield Text(f"The strongest {len(rows)} correlations among {len(labels)} properties:")
    yield Table(columns, rows, keys=2)


def _correlation(result: Result) -> np.ndarray:
    """Correlation (p, p); NaN for properties that are held or at a limit."""
    sd = np.where(result.at_limit | (result.sd_theta == 0), np.nan, result.sd_theta)
    return result.covariance / sd[:, None] / sd


SECTION = Section("covariance", 110, "Covariance of the revised properties", covariance, place=APPENDIX)
