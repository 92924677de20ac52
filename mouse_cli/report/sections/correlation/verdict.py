"""The correlation in two sentences: how many modes have a partner, and how far off the model is."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import ALONE, Correlation
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section


def verdict(found: Correlation, options: Options) -> Iterator[Block]:
    """Partners, frequency errors, MAC, and whether there are remarks."""
    test, paired = found.problem.test, np.flatnonzero(found.modes != ALONE)
    yield Text(f"{len(paired)} of {test.m} measured modes have a partner in the model.{_errors(found, paired)}")
    count = len(found.warnings)
    yield Text(f"{count} remarks below." if count > 1 else "One remark below." if count else "No remark.")


def _errors(found: Correlation, paired: np.ndarray) -> str:
    """Over the pairs; what was not measured is left out."""
    test, text = found.problem.test, ""
    off = 100 * (found.frequencies_hz[found.modes[paired]] / test.frequency_hz[paired] - 1)
    if np.isfinite(off).any():
        worst = int(np.nanargmax(np.abs(off)))
        text = (
            f" Frequency errors of the model: rms {np.sqrt(np.nanmean(off**2)):.3g} %, largest {off[worst]:+.3g} % "
            f"(mode {test.number[paired[worst]]})."
        )
    alike = found.mac[paired, found.modes[paired]]
    if np.isfinite(alike).any():
        text += f" MAC of the pairs: {np.nanmin(alike):.3f} to {np.nanmax(alike):.3f}."
    return text


SECTION = Section("correlation-verdict", 10, "Correlation of test and model", verdict, (Correlation,), place=VERDICT)
