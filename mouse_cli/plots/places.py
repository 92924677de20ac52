"""Probability of each place where one force could make all measured shapes."""

from typing import Any

import numpy as np

from mouse_cli.model.diagnosis import Diagnosis, Place
from mouse_cli.plots import AFTER, Plot
from mouse_cli.plots._line import along, lying
from mouse_cli.report.sections._diagnosis_wording import place

_MOST = 15  # bars, where places are not in one line
_DEEP, _TIE = -20.0, -3.0  # ln of the probability over that of the best: the least that is shown, and what is a tie
_STYLES = ("-", "--", ":", "-.")


def draw(found: Diagnosis, axes: Any) -> bool:
    """ln P over that of the best for each channel along the longest direction; bars of P where it is no line."""
    location = found.location
    if location is None or not location.places:
        return False
    places = location.places
    row = along([p.site for p in places])
    if row is not None:
        _along(places, row[0], axes)
        axes.set_xlabel(f"{row[1]}, {found.problem.units.of('m')}")
        return True
    shown = places[:_MOST]
    lying(axes, [f"{place(p.site)}, {p.channel}" for p in shown], [p.probability for p in shown], AFTER)
    axes.set_xlabel("probability")
    return True


def _along(places: tuple[Place, ...], at: np.ndarray, axes: Any) -> None:
    """at (j,): of each place along the structure."""
    with np.errstate(divide="ignore"):
        relative = np.log([p.probability for p in places]) - np.log(max(p.probability for p in places))
    for i, channel in enumerate(sorted({p.channel for p in places})):
        own: dict[float, float] = {}
        for j, p in enumerate(places):
            if p.channel == channel:
                own[at[j]] = max(own.get(at[j], -np.inf), relative[j])
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
    axes.legend(title="channel", loc="center left", bbox_to_anchor=(1.01, 0.5))


PLOT = Plot("places", 20, "Where one force could make all measured shapes", draw)
