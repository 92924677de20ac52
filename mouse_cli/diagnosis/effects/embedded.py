"""Ends of beams that are clamped in an elastic wall: the beam goes on in it, on an elastic bed.

A half-infinite beam on a bed, b^4 = bed / (4 EI), resists at its end by 4 EI b^3 across, 2 EI b in turning and 2 EI b^2 of both
(Hetenyi, Beams on Elastic Foundation, 1946, ch. 2). With a = 1 / b that is two springs k = 2 EI / a^3 across the beam, one at its
clamped end, one at a rigid arm a behind it. Both motions come of one length: a clamp that turns alone leaves what it gives across.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from mouse_cli.diagnosis.effects.arms import with_arm
from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.released import Followed, followed, free_model, label, static
from mouse_cli.diagnosis.effects.support_sets import support_site
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_LENGTHS = 2e-3, 0.12  # of the member's length: that of the wall in which it is held
_MOST = 24  # clamped ends that are looked at, in the order of the deck
_ALONG = 0.999  # component of a unit vector along an axis of the deck


@dataclass(frozen=True)
class Plane:
    """In which an end bends: directions across and about, sign of d(across)/d(along) by a turn, and EI (N m2)."""

    across: int
    about: int
    sense: float
    EI: float


@dataclass(frozen=True)
class End:
    """A node (index) that clamps one beam: unit vector into the beam, length of the member in m, and its planes."""

    node: int
    inward: np.ndarray
    length: float
    planes: tuple[Plane, ...]

    @property
    def held(self) -> list[tuple[int, int]]:
        """Supports (node, direction) that are flexible."""
        return [(self.node, d) for plane in self.planes for d in (plane.across, plane.about)]


def embedded(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """A recipe for each clamped end of a beam along an axis of the deck."""
    if model.bars is None or model.problem.held is not None:
        return []
    free, name = free_model(model), partial(label, model.problem)
    found = [end for end in _ends(model) if all(name(*each) in free.place for each in end.held)][:_MOST]
    if not found:
        return []
    s = np.array([free.place[name(*each)] for end in found for each in end.held])
    moved = followed(model, free, static(model, free, s, np.eye(len(s))))
    first = np.cumsum([0, *(len(end.held) for end in found)])
    return [
        _recipe(model, candidate, end, moved.part(list(range(i, i + len(end.held))), model.r), len(found))
        for i, end in zip(first.tolist(), found, strict=False)
    ]


def _ends(model: Reduced) -> list[End]:
    """Clamped ends of single beams."""
    mesh, bars = model.problem.mesh, model.bars
    held = {(int(node), int(d)) for node, d in mesh.supports.tolist() if d in mesh.directions}
    count = np.bincount(np.concatenate([each.nodes.ravel() for each in mesh.elements]), minlength=len(mesh.node_ids))
    found = []
    for node in sorted({node for node, _ in held}):
        own = np.flatnonzero((bars.nodes == node).any(axis=1))
        if len(own) and count[node] == 1:
            first = bars.nodes[own[0], 0] == node
            inward = bars.axis[own[0]] * (1 if first else -1)
            planes = tuple(p for i in own.tolist() if (p := _plane(bars, i, inward)) is not None)
            length = float(bars.length[bars.line == bars.line[own[0]]].sum())
            end = End(node, inward, length, planes)
            if planes and set(end.held) <= held:
                found.append(end)
    return found


def _plane(bars: Bars, i: int, inward: np.ndarray) -> Plane | None:
    """That of a bar, where it and what is across it are along axes of the deck."""
    across, about = bars.across[i], np.cross(inward, bars.across[i])
    d, turn = int(np.argmax(np.abs(across))), int(np.argmax(np.abs(about)))
    if min(abs(across[d]), abs(about[turn])) < _ALONG:
        return None
    return Plane(d, 3 + turn, float(np.sign(across[d]) * np.sign(about[turn])), float(bars.EI[i]))


def _recipe(model: Reduced, candidate: Candidate, end: End, moved: Followed, count: int) -> Recipe:
    a = Unknown("length in the wall", "m", *(share * end.length for share in _LENGTHS))
    support = support_site(model.problem, end.held)

    def change(values: np.ndarray) -> Change:
        found = moved.on_springs(np.zeros(len(end.held)))
        for i, plane in enumerate(end.planes):
            arm = np.array([1.0, -plane.sense * values[0]])  # across, a behind the end
            own = slice(model.r + 2 * i, model.r + 2 * i + 2)
            found.K[own, own] += _spring(plane, values[0]) * (np.outer(arm, arm) + np.diag([1.0, 0.0]))
        return found

    extend = lambda problem, values: _in_a_wall(problem, model.problem, end, float(values[0]))
    grid, prior = steps(a, 8)[:, None], -float(np.log(count))
    return Recipe(
        candidate, (a,), change, grid, lambda values: support, len(end.held), log_prior=prior, extend=extend, carried=moved.carried
    )  # fmt: skip


def _spring(plane: Plane, a: float) -> float:
    """2 EI / a^3, N/m."""
    return 2 * plane.EI / a**3


def _in_a_wall(problem: Problem, known: Problem, end: End, a: float) -> Problem:
    """The deck with two springs in each plane in place of the clamp, one of them on an arm."""
    edit = Edit(problem)
    node = edit.index(int(known.mesh.node_ids[end.node]))
    gone = {(node, d) for _, d in end.held}
    edit.supports = [each for each in edit.supports if each not in gone]
    behind = with_arm(edit, node, -a * end.inward)
    text = support_site(known, end.held).text
    for plane in end.planes:
        springs = edit.add("spring", [[node], [behind]], {DIRECTIONS[plane.across]: _spring(plane, a)})
        edit.bind(f"wall at {text}, {DIRECTIONS[plane.across]}", springs, (DIRECTIONS[plane.across],), unit="N/m")
    return edit.done()
