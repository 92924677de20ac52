"""A joint of bars that turns in bending, where bars meet or, as a splice does, anywhere along a line of them."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.effects.hinges import hinged, lines, places, with_hinge
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_MOST = 60  # joints that are looked at: those that bend most in the lowest modes
_SAME = 1e-6  # of directions
_SPLICE = 0.5  # prior probability that a joint is a splice along a line, where bars meet too
_PINNED, _RIGID = 0.5, 3e3  # stiffness over EI / L
_STARTS = 3  # stiffnesses to begin from
_ROOT = 0.01  # of the length of a line, about half the height of a slender section, up to which a splice is at its end
_STEP = 1.3  # ratio of stiffnesses or masses from which on a straight line changes its section, and does not taper


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F + c [1, eta]'[1, eta] in each plane: eta = +-1 at each end of a bar where others begin, any eta of a splice."""
    if model.bars is None:
        return []
    found = [_corners(model, candidate), _splices(model, candidate)]
    share = np.log([1 - _SPLICE, _SPLICE] if all(found) else [1.0, 1.0])
    return [
        replace(one, log_prior=one.log_prior + float(own))
        for own, some in zip(share, found, strict=True)
        for one in some
    ]


def _corners(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """Those of bars that meet."""
    bars = model.bars
    ends = _ends(bars)
    modes = slice(0, min(model.r, int(model.data.test.number.max()) + 1))
    bent = [np.abs(_moment(bars, bar, end, modes)).max() for bar, end in ends]
    chosen = [ends[i] for i in sorted(np.argsort(bent)[::-1][:_MOST])]
    return [_recipe(model, candidate, bar, end, len(ends)) for bar, end in chosen]


def _splices(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """Those along lines of bars."""
    bars = model.bars
    if not lines(model):
        return []
    k = _stiffness(max(float(bars.EI[line.members].max() / line.length) for line in lines(model)))

    def added(bar: int, share: float, values: np.ndarray) -> np.ndarray:
        b = np.array([1.0, 2 * share - 1, 0.0])
        return np.outer(b, b) / values[0]

    def extend(problem: Problem, bar: int, share: float, values: np.ndarray) -> Problem:
        return with_hinge(problem, bars, bar, share, f"splice in {bars.site(bar, share).text}", values[0])

    made = places(model, candidate, (k,), added, steps(k, _STARTS), extend)
    return [replace(one, limit=_root(model, line)) for one, line in zip(made, lines(model), strict=True)]


def _root(model: Reduced, line: Line) -> Callable[[np.ndarray], str]:
    """`support` of a splice at an end that is held against turning: that end is then a flexible support."""
    held = {node for node, direction in model.problem.mesh.supports.tolist() if direction >= 3}
    nodes = model.bars.nodes[line.members[[0, -1]], [0, 1]].tolist()
    ends = [s for s, node in zip((0.0, line.length), nodes, strict=True) if node in held]

    def limit(values: np.ndarray) -> str:
        return "support" if any(abs(values[-1] - s) < _ROOT * line.length for s in ends) else ""

    return limit


def _stiffness(scale: float) -> Unknown:
    """That of a joint in a line of bending stiffness over length `scale`: from what counts as pinned to as good as rigid.

    Eurocode 3 (EN 1993-1-8, 5.2.2) calls a joint pinned below 0.5 of the EI / L of its beam, rigid above 8 to 25.
    """
    return Unknown("stiffness of the joint", "N m/rad", _PINNED * scale, _RIGID * scale)


def _moment(bars: Bars, bar: int, end: int, modes: slice) -> np.ndarray:
    """Bending moment of the modes at an end."""
    return np.array([1.0, 2.0 * end - 1, 0.0]) @ bars.rigid(np.array([bar]))[0] @ bars.strain[bar][:, modes]


def _ends(bars: Bars) -> list[tuple[int, int]]:
    """Ends of bars (bar, 0 or 1) at nodes where not just one uniform line passes; of two that turn about one axis, one."""
    at: dict[int, list[tuple[int, int]]] = {}
    for bar in range(len(bars)):
        for end in (0, 1):
            at.setdefault(int(bars.nodes[bar, end]), []).append((bar, end))
    found = []
    for ends in at.values():
        elements = {(int(bars.set[b]), int(bars.member[b])) for b, _ in ends}
        if len(elements) < 2 or (len(elements) == 2 and _passes(bars, ends)):
            continue
        found += _different(bars, ends) if len(elements) == 2 else ends
    return found


def _passes(bars: Bars, ends: list[tuple[int, int]]) -> bool:
    """Whether two bars continue one another without a step in their section."""
    return all(
        any(
            bars.line[b] == bars.line[c]
            and all(v[b] < _STEP * v[c] and v[c] < _STEP * v[b] for v in (bars.EI, bars.line_mass + 1e-300))
            for c, _ in ends
            if c != b
        )
        for b, _ in ends
    )


def _different(bars: Bars, ends: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Ends that turn about different axes, for a hinge between two bars is one, whichever of them it is put to."""
    found, axes = [], []
    for bar, end in ends:
        axis = np.cross(bars.axis[bar], bars.across[bar])
        if not any(abs(axis @ other) > 1 - _SAME for other in axes):
            found.append((bar, end)), axes.append(axis)
    return found


def _recipe(model: Reduced, candidate: Candidate, bar: int, end: int, count: int) -> Recipe:
    bars = model.bars
    line = bars.lines[bars.line[bar]]
    k = _stiffness(bars.EI[bar] / line.length)
    b = np.array([1.0, 2.0 * end - 1, 0.0])
    node = int(model.problem.mesh.node_ids[bars.nodes[bar, end]])
    position = bars.point(bar, float(end))
    site = Site("node", (node,), position, f"element {bars.ids[bar]} at node {node}, local {'yz'[bars.plane[bar]]}")

    def change(values: np.ndarray) -> Change:
        return hinged(bars, bar, float(end), np.outer(b, b) / values[0])

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return with_hinge(problem, bars, bar, float(end), f"joint of {site.text}", values[0])

    log_prior = -float(np.log(count))
    return Recipe(candidate, (k,), change, steps(k, _STARTS)[:, None], lambda values: site, 0, log_prior, extend)


CANDIDATE = Candidate(
    "joint",
    "a flexible joint",
    "local-stiffness",
    "a connection of bars (bolts, weld, corner, or a splice anywhere along them) that the model takes as rigid and that rotates in "
    "proportion to the moment",
    recipes,
    bars,
)
