"""Every measured shape against every model shape, and each side against itself."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import Correlation
from mouse_cli.report.blocks import Block, Column, Matrix, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT


def assurance(found: Correlation, options: Options) -> Iterator[Block]:
    """MAC matrix, auto-MACs, and close modes as subspaces."""
    if not np.isfinite(found.mac).any():
        return
    test = tuple(str(n) for n in found.problem.test.number)
    model = tuple(str(j + 1) for j in range(len(found.frequencies_hz)))
    yield Matrix("MAC, test by model", _rounded(found.mac), test, model, corner=("test", "model"))
    yield Matrix("auto-MAC of the test", _rounded(found.auto_test), test, test, corner=("test", "test"))
    yield Matrix(
        "auto-MAC of the model at the sensors", _rounded(found.auto_model), model, model, corner=("model", "model")
    )
    yield Text("Off the diagonal an auto-MAC near 1 means that the sensors cannot distinguish two modes.")
    if found.subspaces:
        yield _close(found)
        yield Text(
            "Close modes mix easily, in a structure and in its model, so that single shapes mean little; their span means much. "
            "The squared cosines of the principal angles are 1 where both have the same directions; blank: too few sensors."
        )


def _close(found: Correlation) -> Table:
    columns = (
        Column("close test modes", align=LEFT),
        Column("close model modes", align=LEFT),
        Column("squared cosines", align=LEFT),
    )
    rows = []
    for close in found.subspaces:
        ours = ", ".join(str(found.problem.test.number[i]) for i in close.test)
        theirs = ", ".join(str(j + 1) for j in close.model)
        rows.append((ours, theirs, ", ".join(f"{c:.3f}" for c in close.cosines if np.isfinite(c))))
    return Table(columns, tuple(rows))


def _rounded(matrix: np.ndarray) -> np.ndarray:
    """To three decimals: more is noise, and hides the pattern."""
    return np.round(np.asarray(matrix, dtype=float), 3)


SECTION = Section("correlation-mac", 30, "Modal assurance criterion", assurance, (Correlation,))
