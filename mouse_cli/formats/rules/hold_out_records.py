"""Rules for recordings and frequency response functions that are kept from every fit, and their division."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.hold_out import HeldRecords
from mouse_cli.model.recording import Recording

Divided = tuple[tuple[FrfTest, ...], tuple[Recording, ...], HeldRecords | None]


def divided(draft: Draft, frf: tuple[FrfTest, ...], recordings: tuple[Recording, ...]) -> Divided:
    """What fits use of the functions and of the recordings, and what they do not; None where they use all."""
    given = draft.hold_out
    if given is None or not (given.recordings or given.segments or given.frf or given.lines):
        return frf, recordings, None
    held_frf = _chosen(draft, "frf", given.frf, [each.title for each in frf])
    held = _chosen(draft, "recordings", given.recordings, [each.title for each in recordings])
    fitted, kept = (
        [each for each in frf if each.title not in held_frf],
        [each for each in frf if each.title in held_frf],
    )
    for band, where in given.lines:
        fitted, more = _without_lines(draft, fitted, band, where)
        kept += more
    stays, away = [r for r in recordings if r.title not in held], [r for r in recordings if r.title in held]
    for title, segment, where in given.segments:
        stays, more = _without_segment(draft, stays, title, segment, where)
        away += more
    if (frf or recordings) and not (fitted or stays or draft.test):
        message = "test.hold_out takes all recordings and functions out of the test; nothing is left to fit"
        draft.error("MD432", message, given.where, help="leave some to the fit")
    return tuple(fitted), tuple(stays), HeldRecords(tuple(kept), tuple(away))


def _chosen(draft: Draft, key: str, given: Iterable[tuple[str, Span]], titles: list[str]) -> set[str]:
    for title, where in given:
        if title not in titles:
            note = f"its titles are {', '.join(titles[:12])}" if titles else f"the test has no {key}"
            message = f"test.hold_out names '{title[:40]}', which is no title of test.{key}"
            draft.error("MD433", message, where, note, "write it as the title is written")
    return {title for title, _ in given}


def _without_lines(
    draft: Draft, frf: list[FrfTest], band: tuple[float, float], where: Span
) -> tuple[list[FrfTest], list[FrfTest]]:
    """Functions without the lines in `band`, and those lines of them."""
    stays, away = [], []
    for each in frf:
        inside = (each.frequency_hz >= band[0]) & (each.frequency_hz <= band[1])
        stays += [_lines(each, ~inside)] if not inside.all() else []
        away += [_lines(each, inside)] if inside.any() else []
    if not away:
        message = f"test.hold_out.lines [{band[0]:g}, {band[1]:g}] Hz holds no line of test.frf"
        draft.error("MD433", message, where, help="give a band that holds lines")
    return stays, away


def _lines(each: FrfTest, keep: np.ndarray) -> FrfTest:
    """The functions at the lines of the mask alone."""
    if keep.all():
        return each
    coherence = None if each.coherence is None else each.coherence[keep]
    return replace(
        each, frequency_hz=each.frequency_hz[keep], H=each.H[keep], variance=each.variance[keep], coherence=coherence
    )  # fmt: skip


def _without_segment(
    draft: Draft, recordings: list[Recording], title: str, segment: tuple[int, int], where: Span
) -> tuple[list[Recording], list[Recording]]:
    """Recordings without a stretch of one of them, which falls in two where it lies within, and that stretch."""
    stays, away = [], []
    first, last = segment
    for each in recordings:
        end = each.start + len(each.samples)
        if each.title != title or not each.start <= first < last <= end:
            stays.append(each)
            continue
        away.append(stretch(each, first, last))
        stays += [stretch(each, *span) for span in ((each.start, first), (last, end)) if span[1] - span[0] > 1]
    if not away:
        message = (
            f"test.hold_out.segments names samples {first} to {last} of '{title[:40]}', which fits do not use anyway"
        )
        draft.error("MD433", message, where, help="give the title of a recording and samples of it, as its file counts")
    return stays, away


def stretch(recording: Recording, first: int, last: int) -> Recording:
    """Samples `first` up to but without `last`, as the file counts from 0."""
    samples = recording.samples[first - recording.start : last - recording.start]
    return replace(recording, samples=samples, start=first)
