"""How a file was sampled: by what the deck says, what the file says and what its time column shows, which must agree."""

import re
from collections.abc import Sequence

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.channels import column
from mouse_cli.formats.record_drafts import Findings
from mouse_cli.formats.recording_files import Column, Contents
from mouse_cli.records.faults import Clock, clock

_TIME = re.compile(
    r"(t|times?|zeit|temps|seconds|time_s|t_s|time ?stamp|date ?/? ?time|x_value)([ _]*[0-9]+)?( *- .*)?", re.IGNORECASE
)
_SECONDS = {"": 1.0, "s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0}
_AGREE = 1e-3  # of two sample rates


def is_time(name: str) -> bool:
    """Whether a column of this name, or of its part after a group or struct, holds the time: `t`, `Zeit`, `run.Time`.

    >>> is_time("Time (s)".partition(" ")[0]), is_time("tip"), is_time("Time 1 - default sample rate"), is_time("run.t")
    (True, False, True, True)
    """
    return any(_TIME.fullmatch(each.strip()) for each in (name, name.rpartition(".")[2]))


def step_s(
    contents: Contents, chosen: Sequence[Column], given_hz: float | None, time: str | None, span: tuple[int, int],
    say: Findings, where: Span | None,
) -> float | None:  # fmt: skip
    """Time between samples of the channels `chosen`; None after an error. span: samples first to last that are used."""
    stated = [1 / each.step_s for each in chosen if each.step_s] or [contents.sample_rate_hz] * bool(
        contents.sample_rate_hz
    )
    found = _time(contents, chosen, time, say, where)
    ticks = None if found is None else _clock(found, span, say, where)
    rates = {
        "the deck": given_hz,
        "the file": stated[0] if stated else None,
        "its time column": 1 / ticks.step_s if ticks else None,
    }
    rates = {source: rate for source, rate in rates.items() if rate}
    if not rates:
        if found is None or found.values.dtype.kind == "c":
            message = "neither deck nor file gives the sample rate"
            say.error("MD602", where, message, "give sample_rate in Hz, or name the time column: time: NAME")
        return None
    source, rate = next(iter(rates.items()))
    slack = _AGREE + (2 * ticks.resolution_s / (ticks.step_s * (span[1] - span[0])) if ticks else 0)
    others = [(rates[s], s) for s in rates] + [(hz, "another channel") for hz in stated[1:]]
    for other, who in others:
        if abs(other / rate - 1) > slack:
            message = f"{source} says {rate:.7g} samples a second, {who} {other:.7g}"
            return say.error("MD603", where, message, "find out which is right: all frequencies are proportional to it")
    return 1 / rate


def _time(
    contents: Contents, chosen: Sequence[Column], name: str | None, say: Findings, where: Span | None
) -> Column | None:
    """The time column: the one that is named, or one that bears such a name and is none of the channels."""
    if name is not None:
        return column(contents, name, say, where)
    length = len(chosen[0].values)
    return next(
        (
            each
            for each in contents.columns
            if is_time(each.name)
            and len(each.values) == length
            and not np.isnan(each.values).all()
            and all(each is not other for other in chosen)
        ),
        None,
    )


def _clock(found: Column, span: tuple[int, int], say: Findings, where: Span | None) -> Clock | None:
    times = np.asarray(found.values[span[0] : span[1]].real, float) * _SECONDS.get(found.unit.strip().lower(), 1.0)
    ticks = clock(times)
    if ticks is None:
        message = f"column '{found.name}' shows no even sampling"
        say.error("MD602", where, message, "name the right one: time: NAME; or give sample_rate")
    elif ticks.backward is not None:
        sample = span[0] + ticks.backward
        message = f"time runs backwards in column '{found.name}' at sample {sample}"
        return say.error("MD604", where, message, "give one recording at a time: segment: [first, last]")
    elif ticks.still is not None:
        sample = span[0] + ticks.still
        message = f"sample {sample} has the time of the one before it in column '{found.name}'"
        help = "a sample was written twice, or two records follow one another: segment: [first, last]"
        return say.error("MD604", where, message, help)
    elif ticks.breaks:
        sample, missing = ticks.breaks[0]
        more = f", and at {len(ticks.breaks) - 1} more positions" if len(ticks.breaks) > 1 else ""
        message = (
            f"{missing} samples are missing before sample {span[0] + sample} by the time column '{found.name}'{more}"
        )
        return say.error(
            "MD604", where, message, f"use a stretch without a gap, e.g. segment: [{span[0]}, {span[0] + sample}]"
        )
    return ticks
