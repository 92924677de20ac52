"""Probability of each place where one force could make all measured shapes."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis, Place
from mouse_cli.plots import AFTER, Plot

_MOST = 25  # bars, where places have no positions in a row
_STYLES = ("-", "--", ":", "-.")


def draw(found: Diagnosis, axes: Any) -> bool:
    """A curve for each channel along the longest direction of the structure; bars where there is no geometry."""
    location = found.location
    if location is None or not location.places:
        return False
    places = location.places
    if all(p.site.position is not None for p in places) and len(places) > 1:
        _along(places, axes)
    else:
        shown = places[:_MOST]
        axes.bar([_label(p) for p in shown], [p.probability for p in shown], color=AFTER)
        axes.tick_params(axis="x", labelrotation=90 if len(shown) > 6 else 0)
        axes.grid(axis="x", visible=False)
    axes.set_ylabel("probability")
    axes.set_ylim(bottom=0)
    return True


def _along(places: tuple[Place, ...], axes: Any) -> None:
    at = np.array([p.site.position for p in places], dtype=float)
    axis = int(np.argmax(np.ptp(at, axis=0)))
    for i, channel in enumerate(sorted({p.channel for p in places})):
        own = sorted((at[j, axis], p.probability) for j, p in enumerate(places) if p.channel == channel)
        x, y = zip(*own, strict=True)
        style, width = _STYLES[i % len(_STYLES)], 1.4
        axes.plot(x, y, style, marker=".", markersize=4, linewidth=width, label=channel, color=f"C{i}")
    axes.set_xlabel(f"{'xyz'[axis]}, m")
    axes.legend(title="channel")


def _label(place: Place) -> str:
    return f"{place.site.kind} {' '.join(map(str, place.site.ids))}\n{place.channel}"


PLOT = Plot("places", 20, "Where one force could make all measured shapes", draw)
