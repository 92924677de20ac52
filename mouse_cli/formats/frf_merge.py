"""Frequency response functions of one measurement put side by side."""

from dataclasses import replace

import numpy as np

from mouse_cli.formats.record_drafts import Findings, FrfDraft
from mouse_cli.formats.sensor import SensorDraft

_SAME = 1e-4  # of the line spacing, by which lines that are one may differ


def merged(found: list[FrfDraft], say: Findings) -> list[FrfDraft]:
    """Those of one title as one; H is NaN where none of them measured. Those that do not fit are left out, and it is said."""
    groups: dict[str, list[FrfDraft]] = {}
    for each in found:
        groups.setdefault(each.title, []).append(each)
    return [_whole(group, say) for group in groups.values() if _fit(group, say)]


def _fit(group: list[FrfDraft], say: Findings) -> bool:
    """Whether lines and kinds are those of one measurement."""
    first = group[0]
    if not _ascending(first, say):
        return False
    for each in group[1:]:
        message = _difference(first, each)
        if message:
            say.error("MD614", each.where, message, "give measurements that differ titles of their own")
            return False
    return True


def _difference(first: FrfDraft, each: FrfDraft) -> str:
    """What keeps functions from being of one measurement; empty where nothing does."""
    if each.decay_rate != first.decay_rate:
        rates = f"{first.decay_rate:g} and {each.decay_rate:g} 1/s"
        return f"functions of '{each.title}' have exponential windows of {rates}"
    if each.window != first.window:
        return f"functions of '{each.title}' have different windows, blocks or bursts"
    if each.kind != first.kind:
        return f"'{each.title}' holds functions of {first.kind} and of {each.kind}"
    a, b = first.frequency_hz, each.frequency_hz
    if len(a) != len(b):
        return f"functions of '{each.title}' have {len(a)} and {len(b)} lines; those of one measurement have the same"
    off = np.flatnonzero(np.abs(a - b) > _SAME * np.diff(a).min(initial=np.inf if len(a) > 1 else 1.0))
    if len(off):
        i = int(off[0])
        return f"line {i + 1} of '{each.title}' is at {a[i]:.8g} Hz in one function and at {b[i]:.8g} Hz in another"
    return ""


def _ascending(each: FrfDraft, say: Findings) -> bool:
    hz = each.frequency_hz
    with np.errstate(invalid="ignore"):  # of infinite ones
        bad = np.flatnonzero(~(np.diff(hz, prepend=-np.inf) > 0) | ~np.isfinite(hz) | (hz < 0))
    if not len(hz) or len(bad):
        i = int(bad[0]) if len(bad) else 0
        what = f"frequency {i + 1} of '{each.title}' is {hz[i]:.8g} Hz" if len(bad) else f"'{each.title}' has no lines"
        help = "name the channel of the frequencies: frequency: NAME"
        say.error("MD614", each.where, f"{what}; frequencies ascend, from 0 on", help)
        return False
    infinite = np.argwhere(np.isinf(each.H))
    if len(infinite):
        message = f"'{each.title}' holds {len(infinite)} infinite values"
        say.error("MD605", each.where, message, "write null where nothing was measured")
    return not len(infinite)


def _whole(group: list[FrfDraft], say: Findings) -> FrfDraft:
    first = group[0]
    if len(group) == 1:
        return first
    outputs, inputs = (
        _named(sensor for each in group for sensor in getattr(each, key)) for key in ("outputs", "inputs")
    )
    shape = (len(first.frequency_hz), len(outputs), len(inputs))
    H, variance = np.full(shape, np.nan, complex), np.full(shape, np.nan)
    coherence = np.full(shape[:2], np.nan) if all(each.coherence is not None for each in group) else None
    row, col = ({name: i for i, name in enumerate(named)} for named in (outputs, inputs))
    for each in group:
        at = np.ix_(range(shape[0]), [row[s.name] for s in each.outputs], [col[s.name] for s in each.inputs])
        if (np.isfinite(each.H) & np.isfinite(H[at])).any():
            names = f"{', '.join(s.name for s in each.outputs)} by {', '.join(s.name for s in each.inputs)}"
            message = f"'{each.title}' holds the function of {names} more than once; the last is used"
            say.warn("MD623", each.where, message, "give repeats titles of their own")
        new = np.isfinite(each.H) | ~np.isfinite(H[at])
        H[at], variance[at] = np.where(new, each.H, H[at]), np.where(new, each.variance, variance[at])
        if coherence is not None:
            coherence[:, at[1].ravel()] = np.fmin(coherence[:, at[1].ravel()], each.coherence)
    sensors = {"outputs": tuple(outputs.values()), "inputs": tuple(inputs.values())}
    return replace(first, H=H, variance=variance, coherence=coherence, **sensors)


def _named(sensors) -> dict[str, SensorDraft]:
    found: dict[str, SensorDraft] = {}
    for sensor in sensors:
        found.setdefault(sensor.name, sensor)
    return found
