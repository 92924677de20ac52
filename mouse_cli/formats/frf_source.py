"""Frequency response functions of a file that no deck describes."""

import os

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, RecordError
from mouse_cli._span import Span
from mouse_cli.formats.frf_merge import merged
from mouse_cli.formats.frf_values import scaled, variance
from mouse_cli.formats.record_drafts import Findings, FrfDraft
from mouse_cli.formats.recording_files import Function, read_contents
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.units import UNDECLARED


def read_frf(path: str, kind: str = "") -> tuple[FrfTest, tuple[Diagnostic, ...]] | None:
    """The functions of a file that names response and force of each, in the units it states; None where it holds none.

    kind: one of KINDS, where the file does not say. Raises RecordError with all that is wrong with them.
    """
    contents = read_contents(path)
    if not contents.functions:
        return None
    say, where, title = Findings(), Span(path, 1), os.path.splitext(os.path.basename(path))[0]
    drafts = [_draft(each, kind, path, title, say, where) for each in contents.functions]
    whole = [] if None in drafts else merged(drafts, say)
    if len(whole) != 1 or any(d.severity == ERROR for d in say.diagnostics):
        raise RecordError(say.diagnostics)
    one = whole[0]
    outputs, inputs = (tuple(sensor.name for sensor in sensors) for sensors in (one.outputs, one.inputs))
    found = FrfTest(
        one.frequency_hz, one.H, one.kind, np.arange(len(outputs)), np.arange(len(inputs)), one.variance, outputs, inputs,
        one.coherence, title, path, decay_rate=one.decay_rate, window=one.window,
    )  # fmt: skip
    return found, tuple(say.diagnostics)


def _draft(each: Function, kind: str, path: str, title: str, say: Findings, where: Span) -> FrfDraft | None:
    """One function in SI units."""
    scale = scaled(kind, "", each.unit, each.kind, UNDECLARED, say, where)
    if scale is None:
        return None
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is told of by those who use it
        H = each.values * scale[1]
        spread = variance(H, each.coherence, None) if each.variance is None else each.variance * scale[1] ** 2
    shape = (len(H), 1, 1)
    return FrfDraft(
        title, path, scale[0], each.frequency_hz, H.reshape(shape), spread.reshape(shape), (SensorDraft(each.output, where),),
        (SensorDraft(each.input, where),), None if each.coherence is None else each.coherence[:, None], where,
        decay_rate=each.decay_rate, window=each.window,
    )  # fmt: skip
