"""Candidates for modes over a band of any width: stabilisation diagrams of the whole band and of windows of it, as one.

A polynomial of a few dozen orders cannot follow a resonance of a few lines among thousands; a narrow window cannot hold one that
is heavily damped. Windows of several widths, half overlapping, find both.
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.records.lscf import OrderPoles, lscf
from mouse_cli.records.modal_model import Lines
from mouse_cli.records.stabilisation import Track, persistent, tracks

_WINDOW, _WIDER = 400, 4  # lines of the narrowest window; each kind is so many times wider than the last
_FIRST_ORDER, _ORDERS, _MOST_ORDERS = 2, 40, 100
NARROWEST = 0.3  # lines
_SAME = 0.5  # of the larger decay rate: poles of two windows that are nearer are one


@dataclass(frozen=True)
class Search:
    """candidates: tracks that persist, each once; spikes: those narrower than lines can show; passing: others.

    poles: of every diagram; orders: highest order of any.
    """

    candidates: list[Track]
    spikes: list[Track]
    passing: list[Track]
    poles: list[OrderPoles]
    orders: int


def search(lines: Lines, most: int | None = None) -> Search:
    """Candidates of the lines; `most`: highest order of every diagram."""
    found = [_window(lines, window, most) for window in windows(len(lines.s))]
    candidates, spikes = (_each_once(found, key) for key in ("candidates", "spikes"))
    passing = [track for one in found for track in one.passing]
    return Search(
        candidates, spikes, passing, [p for one in found for p in one.poles], max(one.orders for one in found)
    )


def _each_once(found: list[Search], key: str) -> list[Track]:
    """Tracks of all diagrams by frequency; of those that are one pole the one that was stable in most orders."""
    kept: list[Track] = []
    for track in sorted((t for one in found for t in getattr(one, key)), key=lambda t: -t.stable_orders):
        if all(not _same(track, other) for other in kept):
            kept.append(track)
    return sorted(kept, key=lambda track: abs(track.centre()[0]))


def windows(lines: int) -> list[slice]:
    """The whole band, then its windows from wide to narrow, half overlapping."""
    found, width = [slice(0, lines)], _WINDOW
    widths = []
    while width * 1.5 < lines:
        widths.append(width)
        width *= _WIDER
    for width in reversed(widths):
        count = int(np.ceil((lines - width) / (width / 2)))
        found += [slice(first, first + width) for first in np.linspace(0, lines - width, count + 1).astype(int)]
    return found


def _same(track: Track, other: Track) -> bool:
    """Whether two windows found one pole; poles of one window are different by their orders in common."""
    (one, _), (two, _) = track.centre(), other.centre()
    if track.window == other.window:
        return False
    return abs(one - two) < _SAME * max(-one.real, -two.real)


def _window(lines: Lines, window: slice, most: int | None) -> Search:
    """One stabilisation diagram; more orders where modes take up most of them."""
    s, H, sd = lines.s[window], lines.H[window], lines.sd[window]
    room = max(_FIRST_ORDER + 1, (len(s) - 2) // 2)
    highest = min(most or _ORDERS, room)
    weight = np.where(np.isfinite(sd), 1 / sd, 0)
    while True:
        orders = range(_FIRST_ORDER, highest + 1)
        poles = lscf(s.imag, H, weight, orders)
        every = tracks(poles, (window.start, window.stop))
        stay = [track for track in every if persistent(track, orders)]
        spikes = [track for track in stay if _spike(track, s)]
        kept = [track for track in stay if track not in spikes]
        if most or len(kept) < highest * H.shape[2] / 3 or highest >= min(_MOST_ORDERS, room):
            return Search(kept, spikes, [track for track in every if track not in stay], poles, highest)
        highest = min(2 * highest, _MOST_ORDERS, room)


def _spike(track: Track, s: np.ndarray) -> bool:
    """Whether the half-power bandwidth is so far below the spacing of the lines that it may be that of one wrong line."""
    return -2 * track.centre()[0].real < NARROWEST * (s.imag[-1] - s.imag[0]) / (len(s) - 1)
