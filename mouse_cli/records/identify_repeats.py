"""Repeats whose outputs alone are identified together: whether they are repeats, and what is lost where they are short."""

from collections.abc import Sequence

import numpy as np

from mouse_cli._errors import ERROR, WARNING, Diagnostic, RecordError
from mouse_cli.model.recording import Recording
from mouse_cli.records.identify_output_only import Division

_SAME = 1e-6  # relative difference of two sample rates


def alike(recordings: Sequence[Recording]) -> Recording:
    """The first of the recordings. Raises RecordError (MD655) where outputs or rates of others differ from its."""
    first = recordings[0]
    outputs = lambda one: [
        (one.channels[j].sensor or one.channels[j].name, one.channels[j].quantity) for j in one.outputs
    ]
    for other in recordings[1:]:
        message = ""
        if outputs(other) != outputs(first):
            message = f"'{first.title}' and '{other.title}' have different responses"
        elif abs(other.sample_rate_hz / first.sample_rate_hz - 1) > _SAME:
            rates = f"{first.sample_rate_hz:.7g} samples a second, '{other.title}' {other.sample_rate_hz:.7g}"
            message = f"'{first.title}' has {rates}"
        if message:
            raise RecordError.of("MD655", message, help="identify them one by one: --recording TITLE")
    return first


def short_of(parts: Sequence[np.ndarray], rate_hz: float, least: int) -> Diagnostic:
    """That there are too few samples, after decimation, for any answer."""
    has = "the record has" if len(parts) == 1 else f"{len(parts)} records have, the shortest {min(map(len, parts))},"
    few = f"{has} {sum(map(len, parts))} samples at {rate_hz:.6g} Hz, which the band takes; at least {least} are needed"
    return Diagnostic("MD651", ERROR, few, help="record for longer, or give repeats")


def lost(division: Division, samples: int, rate_hz: float) -> tuple[Diagnostic, ...]:
    """What records that are shorter than usual leave unknown.

    Correlations over a time T tell modes apart that are 1 / T from one another; n blocks know a standard deviation to
    1 / sqrt(2 (n - 1)) of it.
    """
    if not division.short:
        return ()
    lags, blocks = division.usual
    apart, unsure = rate_hz / (2 * division.lags), 100 / np.sqrt(2 * (division.blocks - 1))
    message = (
        f"{samples} samples at {rate_hz:.6g} Hz are few: {division.blocks} blocks of {2 * division.lags} lags instead of "
        f"{blocks} of {2 * lags}; modes less than {apart:.3g} Hz apart may run into one, and standard deviations are known to "
        f"{unsure:.0f} %"
    )
    return (Diagnostic("MD682", WARNING, message, help="record for longer, or give repeats: they are averaged"),)
