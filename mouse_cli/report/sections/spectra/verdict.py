"""Frequency response functions in brief: how many, how they were averaged, and how good they are."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.spectra import MeasuredFrf, SpectraResult
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted


def verdict(result: SpectraResult, options: Options) -> Iterator[Block]:
    """One paragraph for each set of recordings."""
    for each in result.measured:
        yield Text(_averaged(each))


def _averaged(each: MeasuredFrf) -> str:
    spacing = each.sample_rate_hz / each.block_samples
    coherence = np.array([q.median_coherence for q in each.quality])
    told = f", median coherence {coherence.min():.3f} to {coherence.max():.3f}" if np.isfinite(coherence).all() else ""
    stroke = f" The force counts as 0 after {each.force_window} samples of each block." if each.force_window else ""
    return (
        f"{', '.join(each.recordings)}: {counted(len(each.quality), 'function')}{told if len(coherence) else ''}; "
        f"{counted(each.blocks, 'block')} of {each.block_samples} samples at {each.sample_rate_hz:.6g} Hz, lines {spacing:.5g} Hz "
        f"apart, {each.averages:.4g} independent averages.{stroke}"
    )


SECTION = Section("spectra-verdict", 10, "Frequency response functions", verdict, (SpectraResult,), place=VERDICT)
