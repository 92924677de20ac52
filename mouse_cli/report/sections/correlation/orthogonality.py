"""Orthogonality of the measured shapes by reduced mass matrices, and how much of it noise can spoil."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import Correlation, Orthogonality
from mouse_cli.report.blocks import Block, Heading, Matrix, Text
from mouse_cli.report.section import Options, Section


def orthogonality(found: Correlation, options: Options) -> Iterator[Block]:
    """For each mass matrix: measured with measured, measured with model, and what the figures can be trusted for."""
    test = tuple(str(n) for n in found.problem.test.number)
    model = tuple(str(j + 1) for j in range(len(found.frequencies_hz)))
    for judged in found.orthogonality:
        if not np.isfinite(judged.test).any():
            continue
        yield Heading(judged.title, 2)
        yield Matrix("pseudo-orthogonality of the test", np.round(judged.test, 3), test, test, corner=("test", "test"))
        yield Matrix("cross-orthogonality", np.round(judged.cross, 3), test, model, corner=("test", "model"))
        yield _trust(judged)


def _trust(judged: Orthogonality) -> Text:
    """What noise alone makes of the off-diagonals, and how far this mass matrix stands for the model."""
    off = ~np.eye(len(judged.test), dtype=bool) & np.isfinite(judged.test)
    beyond = _largest(judged.model, ~np.eye(len(judged.model), dtype=bool))
    own = "This mass matrix leaves the model's own shapes with products up to {}."
    if not off.any():
        return Text(own, (beyond,))
    largest, noise = _largest(judged.test, off), 2 * _largest(judged.sd, off)
    outside = int(np.sum(np.abs(judged.test[off]) > 2 * judged.sd[off])) // 2
    return Text(
        "Off the diagonal the largest product of measured shapes is {}; the stated accuracies alone make up to {} (two standard "
        f"deviations), and {outside} of {int(off.sum()) // 2} products lie beyond their own two. {own}",
        (largest, noise, beyond),
    )


def _largest(matrix: np.ndarray, where: np.ndarray) -> float:
    return float(np.round(np.nanmax(np.abs(matrix[where]), initial=0.0), 4))


SECTION = Section("correlation-orthogonality", 50, "Orthogonality", orthogonality, (Correlation,))
