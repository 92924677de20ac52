"""From the channels of a file to a Recording in the units of the deck, with every channel that is no measurement diagnosed."""

import os

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.channels import channel, column, scaled, unstated
from mouse_cli.formats.record_drafts import Findings, Pick
from mouse_cli.formats.recording_files import Column, Contents
from mouse_cli.formats.sampling import step_s
from mouse_cli.model.recording import Channel, Recording
from mouse_cli.model.units import UNDECLARED, Units
from mouse_cli.records.faults import faults

LEAST = 2  # samples


def recording(
    contents: Contents, picks: list[Pick], path: str, title: str, say: Findings, where: Span | None = None, *,
    sample_rate_hz: float | None = None, time: str | None = None, segment: tuple[int, int] | None = None,
    units: Units = UNDECLARED,
) -> Recording | None:  # fmt: skip
    """The channels `picks` of a file, samples segment[0] up to but without segment[1]; None after errors."""
    columns = [column(contents, pick.channel, say, pick.where) for pick in picks]
    if None in columns or not columns:
        return None
    found = [channel(pick, each, units, say) for pick, each in zip(picks, columns, strict=True)]
    span = _span(columns, segment, say, where)
    if span is None:
        return None
    step = step_s(contents, columns, sample_rate_hz, time, span, say, where)
    if None in found or step is None:
        return None
    unstated(picks, columns, say, where)
    channels, factors = zip(*found, strict=True)
    samples = [scaled(each, factor, *span) for each, factor in zip(columns, factors, strict=True)]
    if _faulty(channels, samples, span[0], picks, say):
        return None
    title = title or os.path.splitext(os.path.basename(path))[0]
    return Recording(title, step, tuple(channels), np.stack(samples, axis=1), path, span[0])


def _span(
    columns: list[Column], segment: tuple[int, int] | None, say: Findings, where: Span | None
) -> tuple[int, int] | None:
    """The samples that are used, first and one beyond the last; None after an error."""
    lengths = {len(each.values) for each in columns}
    if len(lengths) > 1:
        least, most = (pick(columns, key=lambda each: len(each.values)) for pick in (min, max))
        message = (
            f"channel '{most.name}' has {len(most.values)} samples, channel '{least.name}' {len(least.values)}; "
            "channels of one recording have equally many"
        )
        return say.error("MD608", where, message, "record them together, or cut the file to what they share")
    n = lengths.pop()
    first, last = segment or (0, n)
    if not 0 <= first < last <= n or last - first < LEAST:
        what = f"segment [{first}, {last}]" if segment else f"a recording of {n} samples"
        message = f"{what} is none of at least {LEAST} samples from 0 to {n}"
        return say.error("MD609", where, message, "samples count from 0; the last one is not included")
    return first, last


_WORDS = {
    "gap": ("MD605", "{count} samples of channel '{name}' are no numbers, the first is sample {sample}",
            "use a stretch without gaps: segment: [first, last]"),
    "dead": ("MD607", "channel '{name}' is dead: all {count} samples from {sample} on are zero", "leave it out, or mend its cable"),
    "constant": ("MD607", "channel '{name}' is constant: all {count} samples from {sample} on are {value:.6g}", "leave it out"),
    "clipped": ("MD606", "channel '{name}' is clipped at {value:.6g} {unit}: {count} samples, the first is sample {sample}",
                "measure again with a wider range, or use a stretch without it"),
    "stuck": ("MD613", "channel '{name}' stands still at {value:.6g} {unit} for {count} samples from sample {sample} on",
              "use a stretch before or after it: segment: [first, last]"),
}  # fmt: skip


def _faulty(
    channels: tuple[Channel, ...], samples: list[np.ndarray], start: int, picks: list[Pick], say: Findings
) -> bool:
    """Say what is wrong with the samples; whether any of it forbids their use."""
    refused = False
    for j, (each, pick) in enumerate(zip(channels, picks, strict=True)):
        for fault in faults(samples[j]):
            code, words, help = _WORDS[fault.kind]
            serious = code in ("MD605", "MD607")
            message = words.format(
                name=each.name, unit=each.unit, sample=start + fault.sample, count=fault.count, value=fault.value
            )
            (say.error if serious else say.warn)(code, pick.where, message, help)
            refused |= serious
    return refused
