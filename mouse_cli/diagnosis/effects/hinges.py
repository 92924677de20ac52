"""Places along bars where something is softer in bending."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE, Change, Recipe, Softening, Unknown
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import element_at, hinge
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.points import wanted
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam

_PINNED, _SOFTEST, _RIGID = 1e-2, 0.5, 3e3  # stiffness over EI / L; softest in coordinates that leave some out
_STARTS = 15  # places to begin from on a line
_INSIDE = 0.02  # of the way from an end of a bar to its middle, where no other bar is
_ENDS = 12  # ends of lines that a search in few coordinates knows to bend


def lines(model: Reduced) -> list[Line]:
    """Lines of bars that are worth looking at."""
    keep, bars = wanted(model), model.bars
    found = () if bars is None else bars.lines
    return [line for line in found if keep is None or keep[bars.nodes[line.members]].any()]


def ends(model: Reduced) -> np.ndarray:
    """Pairs of moments (c, r) by which ends of lines turn where others begin, those first that bear most; few at most."""
    bars = model.bars
    if bars is None:
        return np.zeros((0, model.r))
    chosen = [(line.members[0], -1.0) for line in bars.lines] + [(line.members[-1], 1.0) for line in bars.lines]
    b, eta = (np.array(part) for part in zip(*chosen, strict=True))
    yields = bars.rigid(b) @ bars.strain[b]
    moments = yields[:, 0] + eta[:, None] * yields[:, 1]
    count = model.low_modes()
    return moments[np.argsort(-np.abs(moments[:, :count]).max(axis=1), kind="stable")[:_ENDS]]


def places(
    model: Reduced,
    candidate: Candidate,
    sizes: tuple[Unknown, ...],
    does: Callable[[int, float, np.ndarray], Change],
    starts: np.ndarray,
    extend: Callable[[Problem, int, float, np.ndarray], Problem],
    chosen: list[Line],
    axes: str = "",
) -> list[Recipe]:
    """A recipe for each of the lines of bars `chosen`: what a hinge of `sizes` does at a share of a bar, does(bar, share, values).

    starts (g,) or (g, t): sizes to begin from, at every place.
    extend(problem, bar, share, values): the deck with that in it. axes: about which it turns, where these are several.
    """
    found = []
    total = sum(line.length for line in chosen)
    for line in chosen:
        where = Unknown(PLACE, "m", 0.0, line.length, log=False)
        at = line.starts(_STARTS, line.length / total)
        change = lambda values, line=line: does(*line.at(values[-1]), values[:-1])
        site = lambda values, line=line: _about(line.site(values[-1]), axes or line.about)
        extended = lambda problem, values, line=line: extend(problem, *line.at(values[-1]), values[:-1])
        prior = float(np.log(line.length / total))
        grid = np.hstack([np.repeat(starts.reshape(len(starts), -1), len(at), axis=0), np.tile(at, len(starts))[:, None]])
        recipe = Recipe(candidate, (*sizes, where), change, grid, site, log_prior=prior, extend=extended)
        found.append(replace(recipe, jumps={len(sizes): line.inner}))
    return found


def _about(site: Site, axes: str) -> Site:
    """A place with the axes about which it turns, where it may turn about several."""
    return replace(site, text=f"{site.text}, {axes}") if axes else site


def hinged(bars: Bars, bar: int, share: float, added: np.ndarray) -> Change:
    """What a hinge does at a share of a bar: `added` (3, 3) comes to its flexibility, and its shapes have a kink and a gap there.

    These are what its moments and force do at the hinge: `added` of the angle between the ends, and of the elongation.
    """
    own, strain, R = np.array([bar]), bars.strain[bar], None
    left = bars.rigid(own, added)
    lost = left - bars.whole[own]
    if bars.residual is not None:
        R = bars.residual[own]
        strain = np.linalg.solve(np.eye(3) + R[0] @ lost[0], strain)
    jumps = (added @ left[0])[[0, 2]] @ strain
    return Change(M=_jumped(bars, bar, share, jumps), softening=Softening(own, added[None], R, lost))


def _jumped(bars: Bars, bar: int, at: float, jumps: np.ndarray) -> np.ndarray:
    """Change of M (r, r) where a bar is kinked and parted at a share of its length, by an angle and a gap, `jumps` (2, r)."""
    length = float(bars.length[bar])
    bent, turning = beam.kinked(length, at)
    along, parting = beam.parted(length, at)
    if bars.released[bar] and (turned := _turned(bars, bar, at)).any():
        M_turned = beam.consistent(bars.length[[bar]])[0] @ turned
        bent, turning = bent + M_turned, turning + (2 * bent + M_turned) @ turned
    across = 0.5 * np.array([[turning], [parting]]) * jumps
    across[0] += bent @ bars.ends[bar]
    across[1] += along @ bars.axial[bar]
    half = (bars.line_mass[bar] * across).T @ jumps
    return half + half.T


def _turned(bars: Bars, bar: int, at: float) -> np.ndarray:
    """Motion (4,) of the ends of one bar that a unit angle at a share of its length makes: ends that are hinged turn."""
    kink = np.array([1.0, 2 * at - 1, 0.0])
    x = kink - bars.flexibility[bar] @ bars.whole[bar] @ kink
    return np.round([0.0, (x[1] - x[0]) / 2, 0.0, (x[0] + x[1]) / 2], 12)


def with_hinge(
    problem: Problem,
    bars: Bars,
    bar: int,
    share: float,
    name: str,
    turning: float,
    sliding: float = 0.0,
    parting: float = 0.0,
    off: float = 0.0,
) -> Problem:
    """The deck with a spring (N m/rad) at `share` of a bar, in its plane, and springs (N/m) across and along it if that is asked.

    off: distance from the axis of the point about which it turns.
    """
    edit = Edit(problem)
    spring, soft = hinge(edit, *end_of(edit, bars, bar, share), turning, sliding, parting, off)
    if len(soft) == 1:
        edit.bind(name, [spring], tuple(soft), unit="N m/rad")
    else:  # what is soft follows one factor
        edit.bind(name, [spring], tuple(soft), factor=1.0)
    return edit.done()


def with_joint(
    problem: Problem, bars: Bars, planes: list[int], share: float, names: list[str], turning: np.ndarray
) -> Problem:
    """The deck with springs `turning` (c,) at `share` of one element, one or two `planes` of which they let turn, and twist."""
    if len(planes) == 1:
        return with_hinge(problem, bars, planes[0], share, names[0], turning[0])
    edit = Edit(problem)
    springs = dict(zip(("turning", "other", "twisting"), turning.tolist(), strict=False))
    spring, soft = hinge(edit, *end_of(edit, bars, planes[0], share), **springs)
    for name, key in zip(names, soft, strict=True):
        edit.bind(name, [spring], (key,), unit="N m/rad")
    return edit.done()


def joint_stiffness(
    model: Reduced, scale: float, largest: float = 0.0, name: str = "stiffness of the joint"
) -> Unknown:
    """That of a joint in a line of bending stiffness over length `scale`: from what counts as pinned to as good as rigid.

    largest: the same of the stiffest, where several lines have joints of one stiffness, `scale` that of the softest.
    Eurocode 3 (EN 1993-1-8, 5.2.2) calls a joint pinned below 0.5 of the EI / L of its beam, rigid above 8 to 25; L is here that of
    a line, which may pass several beams.
    """
    softest = _PINNED if model.r == model.V.shape[0] else _SOFTEST
    return Unknown(name, "N m/rad", softest * scale, _RIGID * max(scale, largest))


def end_of(edit: Edit, bars: Bars, bar: int, share: float) -> tuple[tuple[int, int], int, np.ndarray]:
    """The beam that ends at `share` of a bar, split there, which of its ends that is, and the axes of the bar."""
    inside = bars.point(bar, share + _INSIDE * (0.5 - share))  # where bars go straight on, two of them end at one point
    element, _ = element_at(edit, np.array(inside), bars.axis[bar])
    start, end = (edit.coordinates[n] for n in edit.sets[element[0]].nodes[element[1]])
    there = (np.array(bars.point(bar, share)) - start) @ (end - start) / np.sum((end - start) ** 2)
    node = edit.split(element, float(np.clip(there, 0.0, 1.0)))
    element = edit.meeting(element, node)
    end = int(np.argmax(edit.sets[element[0]].nodes[element[1]] == node))
    axis, across = bars.axis[bar], bars.across[bar]
    return element, end, np.stack([axis, across, np.cross(axis, across)])
