"""Probability of each place where one force could make all measured shapes."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis, Place
from mouse_cli.plots import AFTER, Plot

_MOST = 25  # bars, where places have no positions in a row
_DEEP, _TIE = -20.0, -3.0  # ln of the probability over that of the best: the least that is shown, and what is a tie
_STYLES = ("-", "--", ":", "-.")


def draw(found: Diagnosis, axes: Any) -> bool:
    """ln P over that of the best for each channel along the longest direction; bars of P where there is no geometry."""
    location = found.location
    if location is None or not location.places:
        return False
    places = location.places
    if all(p.site.position is not None for p in places) and len(places) > 1:
        _along(places, axes)
        return True
    shown = places[:_MOST]
    axes.bar([_label(p) for p in shown], [p.probability for p in shown], color=AFTER)
    axes.tick_params(axis="x", labelrotation=90 if len(shown) > 6 else 0)
    axes.grid(axis="x", visible=False)
    axes.set_ylabel("probability")
    return True


def _along(places: tuple[Place, ...], axes: Any) -> None:
    at = np.array([p.site.position for p in places], dtype=float)
    axis = int(np.argmax(np.ptp(at, axis=0)))
    with np.errstate(divide="ignore"):
        relative = np.log([p.probability for p in places]) - np.log(max(p.probability for p in places))
    for i, channel in enumerate(sorted({p.channel for p in places})):
        own: dict[float, float] = {}
        for j, p in enumerate(places):
            if p.channel == channel:
                own[at[j, axis]] = max(own.get(at[j, axis], -np.inf), relative[j])
        if max(own.values()) < _DEEP:
            continue
        x = sorted(own)
        y = np.maximum([own[each] for each in x], 1.5 * _DEEP)
        axes.plot(
            x, y, _STYLES[i % len(_STYLES)], marker=".", markersize=4, linewidth=1.2, label=channel, color=f"C{i}"
        )
    axes.axhspan(_TIE, 0, color="0.88", zorder=0, label="tie")
    axes.set_ylim(_DEEP, 1)
    axes.set_ylabel("ln P over that of the best")
    axes.set_xlabel(f"{'xyz'[axis]}, m")
    axes.legend(title="channel", loc="center left", bbox_to_anchor=(1.01, 0.5))


def _label(place: Place) -> str:
    return f"{place.site.kind} {' '.join(map(str, place.site.ids))}\n{place.channel}"


PLOT = Plot("places", 20, "Where one force could make all measured shapes", draw)
