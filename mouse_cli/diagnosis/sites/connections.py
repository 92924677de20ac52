"""Connections by kind: ends of beams at the columns that they meet; corners of a run of pipes or bars in space."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import STRAIGHT


@dataclass(frozen=True)
class Connections:
    """ends (c, 2): bar and 0 or 1; text: which they are."""

    ends: np.ndarray
    text: str


def connections(model: Reduced) -> list[Connections]:
    """All joints of beams and columns, then those of each direction and of each section of beams, where there are several; and all
    corners in space where two bars alone meet, as elbows are, which turn about both axes at the end of either bar.

    Columns are what stands on supports, and all that is parallel to them. A beam turns in the plane of the column.
    """
    bars = model.bars
    if bars is None or model.motion is None:
        return []
    found, kinds = _ends(model, bars), []
    if len(found) > 1:
        kinds = [Connections(found, "joints of beams and columns")]
        alike = ("along", _directions(bars, found[:, 0])), ("like", np.round(np.log(bars.EI[found[:, 0]]), 6))
    for text, label in alike if kinds else ():
        values = np.unique(label)
        for value in values if len(values) > 1 else ():
            own = found[label == value]
            if len(own) > 1:
                kinds.append(Connections(own, f"joints of beams {text} {_named(bars, int(own[0, 0]), text)}"))
    corners = _corners(model, bars)
    return kinds + ([Connections(corners, "corners of two bars")] if len(corners) else [])


def _corners(model: Reduced, bars: Bars) -> np.ndarray:
    """Ends (c, 2) of bars in space at corners, of which there are several, where two alone meet, neither held nor released."""
    mesh = model.problem.mesh
    joined = np.concatenate([each.nodes.ravel() for each in mesh.elements if each.nodes.shape[1] == 2])
    degree = np.bincount(joined, minlength=len(mesh.coordinates))
    degree[mesh.standing[:, 0]] = 0
    at: dict[int, list[tuple[int, int]]] = {}
    for bar in range(len(bars)):
        for end in (0, 1):
            if degree[bars.nodes[bar, end]] == 2 and not bars.released[bar]:
                at.setdefault(int(bars.nodes[bar, end]), []).append((bar, end))
    turning = [own for own in at.values() if len(own) == 4 and _angled(bars, [bar for bar, _ in own])]
    several = turning if len(turning) > 1 else []
    return np.array(sorted(end for own in several for end in own), int).reshape(-1, 2)


def _angled(bars: Bars, own: list[int]) -> bool:
    """Whether not all bars `own` are along one line."""
    return bool((np.abs(bars.axis[own] @ bars.axis[own[0]]) <= STRAIGHT).any())


def _named(bars: Bars, bar: int, text: str) -> str:
    """What the beams of a kind have in common."""
    if text == "along":
        return "({})".format(", ".join(f"{x + 0.0:.2f}" for x in bars.axis[bar]))
    return f"element {bars.ids[bar]}"


def _ends(model: Reduced, bars: Bars) -> np.ndarray:
    """Ends (c, 2) of beams at columns, where neither is held nor released."""
    held = np.unique(model.problem.mesh.standing[:, 0])
    standing = bars.axis[np.isin(bars.nodes, held).any(axis=1)]
    if not len(standing):
        return np.zeros((0, 2), int)
    column = (np.abs(bars.axis @ standing.T) > STRAIGHT).any(axis=1)
    of_columns = np.setdiff1d(bars.nodes[column], held)
    best: dict[tuple[int, int], int] = {}
    for bar in np.flatnonzero(~column & ~bars.released).tolist():
        element = int(bars.set[bar]), int(bars.member[bar])
        other = best.get(element, bar)
        best[element] = bar if _upright(bars, bar, standing) >= _upright(bars, other, standing) else other
    chosen = [(bar, end) for bar in best.values() for end in (0, 1) if bars.nodes[bar, end] in of_columns]
    return np.array(sorted(chosen), int).reshape(-1, 2)


def _upright(bars: Bars, bar: int, standing: np.ndarray) -> float:
    """How much a beam bends in the direction of the columns."""
    return float(np.abs(standing @ bars.across[bar]).max())


def _directions(bars: Bars, own: np.ndarray) -> np.ndarray:
    """Number (c,) of the first of the bars `own` (c,) that each is parallel to."""
    return np.argmax(np.abs(bars.axis[own] @ bars.axis[own].T) > STRAIGHT, axis=1)
