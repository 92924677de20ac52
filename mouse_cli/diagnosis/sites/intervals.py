"""A part of a line of bars between two places, neither of which need be an end of it."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.effects.change import Unknown, steps
from mouse_cli.diagnosis.sites.lines import Line, elements
from mouse_cli.diagnosis.sites.stretches import covered
from mouse_cli.model.diagnosis import Site

# Of the line: what is narrower acts at a point; what is wider on one that is all of the structure, on all of it
_NARROWEST, _WIDEST = 0.1, 0.95
_WHOLE = 0.995  # share from which on it is reported as all of it
_WIDTHS, _PLACES = 2, 4  # to begin from


@dataclass(frozen=True)
class Interval:
    """Of `line`, by two unknowns: the covered share of its length, and how much of what is left is before it: 0 at one end, 1 at
    the other. So the interval never leaves the line, and where it reaches an end either unknown still moves the other end.
    """

    line: Line

    @property
    def unknowns(self) -> tuple[Unknown, Unknown]:
        """Both, with their ranges."""
        covered = Unknown("covered share of the length", "1", _NARROWEST, widest(self.line), log=False)
        return covered, Unknown("share before it of what is not covered", "1", 0.0, 1.0, log=False)

    @property
    def grid(self) -> tuple[np.ndarray, np.ndarray]:
        """Values of both to begin from."""
        covered, before = self.unknowns
        return steps(covered, _WIDTHS), steps(before, _PLACES)

    def ends(self, share: float, before: float) -> tuple[float, float]:
        """Distances (m) of both ends along the line."""
        first = before * (1 - share) * self.line.length
        return float(first), float(first + share * self.line.length)

    def points(self, share: float, before: float) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates (3,) of both ends."""
        first, last = self.ends(share, before)
        return np.array(self.line.bars.point(*self.line.at(first))), np.array(self.line.bars.point(*self.line.at(last)))

    def site(self, share: float, before: float, more: str = "") -> Site:
        """Its elements, where its middle is, and it in words, with `more` behind."""
        first, last = self.ends(share, before)
        (a, b), L = self.line.bars.ids[self.line.members[[0, -1]]], self.line.length
        where = f"{first / L:.2f} to {last / L:.2f} of the length from the end at element {a} towards element {b}"
        where = _whole(self.line) if share > _WHOLE else where
        return _between(self.line, first, last, where + more)


def _whole(line: Line) -> str:
    """All of a line in words."""
    return elements(tuple(np.unique(line.bars.ids[line.members]).tolist()))


def widest(line: Line) -> float:
    """Share of a line that may be covered: all of one of several."""
    own, every = (np.unique(ids) for ids in (line.bars.ids[line.members], line.bars.ids))
    return 1.0 if len(own) < len(every) else _WIDEST


def from_end(line: Line, share: float, back: bool, more: str = "") -> Site:
    """Likewise a share of a line from its beginning on, or (`back`) from its end."""
    a, b = line.bars.ids[line.members[[-1, 0] if back else [0, -1]]]
    first = (1 - share) * line.length if back else 0.0
    where = f"{share:.2f} of the length from the end at element {a} towards element {b}"
    where = _whole(line) if share > _WHOLE else where
    return _between(line, first, first + share * line.length, where + more)


def _between(line: Line, first: float, last: float, where: str) -> Site:
    touched, _, _ = covered(line, first, last)
    ids = np.unique(line.bars.ids[touched]).tolist()
    return Site("element", tuple(ids), line.site((first + last) / 2).position, where)
