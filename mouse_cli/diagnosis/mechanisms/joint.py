"""A joint of bars that turns in bending, about one axis or both, where bars meet or, as a splice does, along a line of them.

In space it may twist too.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, steps, summed
from mouse_cli.diagnosis.effects.hinges import hinged, joint_stiffness, lines, places, with_joint
from mouse_cli.diagnosis.effects.twisted import Torsion, torsion, twisted
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.lines import ABOUT, Line
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.groups import enumerated
from mouse_cli.model.problem import Problem

_MOST = 60  # joints that are looked at: those that bend most in the lowest modes
_SAME = 1e-6  # of directions
_SPLICE = 0.5  # prior probability that a joint is a splice along a line, where bars meet too
_BOTH, _TWISTS = 0.5, 0.2  # prior probability that a joint in space turns about both axes, and that it twists as well
_STARTS, _ALIKE = 3, 4  # stiffnesses to begin from; of a splice about several axes, about all alike
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
    """Those of bars that meet: about one axis, in space about both, and about all three; each has a stiffness of its own."""
    bars = model.bars
    ends = _ends(bars)
    one = [((bar,), end) for bar, end in ends]
    own = dict.fromkeys((int(bars.set[bar]), int(bars.member[bar]), end) for bar, end in ends)
    both = [(tuple(planes), end) for *element, end in own if len(planes := bars.twins[tuple(element)]) > 1]
    twisting = torsion(model, sorted({planes[0] for planes, _ in both}))
    every = [(planes, end) for planes, end in both if planes[0] in twisting]
    kinds = [(one, 1 - _BOTH, False), (both, _BOTH - (_TWISTS if every else 0.0), False), (every, _TWISTS, True)]
    total, modes = sum(share for some, share, _ in kinds if some) or 1.0, slice(0, model.low_modes())
    found = []
    for some, share, twists in kinds:
        bent = [max(np.abs(_moment(bars, bar, end, modes)).max() for bar in planes) for planes, end in some]
        chosen = [some[i] for i in sorted(np.argsort(bent)[::-1][:_MOST])]
        prior = float(np.log(share / total / max(len(some), 1)))
        found += [_recipe(model, candidate, *each, prior, twisting[each[0][0]] if twists else None) for each in chosen]
    return found


def _splices(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """Those along lines of bars, about one axis; in space about both, and about all three; each with a stiffness of its own."""
    bars, found = model.bars, lines(model)
    if not found:
        return []
    twins = lambda bar: bars.twins[int(bars.set[bar]), int(bars.member[bar])]
    space = [line for line in found if bars.plane[line.members[0]] == 0 and len(twins(line.members[0])) > 1]
    twisting = torsion(model, sorted({int(bar) for line in space for bar in line.members}))
    every = [line for line in space if all(int(bar) in twisting for bar in line.members)]
    one = _spliced(model, candidate, found, lambda bar: [bar])
    both = _spliced(model, candidate, space, twins)
    all_three = _spliced(model, candidate, every, twins, twisting)
    kinds = [(one, 1 - _BOTH), (both, _BOTH - (_TWISTS if every else 0.0)), (all_three, _TWISTS)]
    total = sum(share for some, share in kinds if some)
    return [replace(each, log_prior=each.log_prior + float(np.log(own / total))) for some, own in kinds for each in some]


def _spliced(
    model: Reduced,
    candidate: Candidate,
    chosen: list[Line],
    planes: Callable[[int], list[int]],
    twisting: dict[int, Torsion] | None = None,
) -> list[Recipe]:
    """planes: of a bar, those of its element in which it turns. twisting: torsion of the bars, of splices that twist too."""
    if not chosen:
        return []
    bars = model.bars
    k = joint_stiffness(model, max(float(bars.EI[line.members].max() / line.length) for line in chosen))
    axes = [*ABOUT[: len(planes(chosen[0].members[0]))], *(["local x"] if twisting else [])]
    names = [k.name] if len(axes) == 1 else [f"{k.name} about {axis}" for axis in axes]

    def does(bar: int, share: float, values: np.ndarray) -> Change:
        b = np.array([1.0, 2 * share - 1, 0.0])
        turns = zip(planes(bar), values, strict=False)
        turning = summed([hinged(bars, each, share, np.outer(b, b) / value) for each, value in turns])
        return twisted(turning, bars, bar, share, twisting[bar], values[-1]) if twisting else turning

    def extend(problem: Problem, bar: int, share: float, values: np.ndarray) -> Problem:
        own = planes(bar)
        about = [f", about {ABOUT[bars.plane[each]]}" if len(own) > 1 else "" for each in own]
        about += [", about local x"] if twisting else []
        named = [f"splice in {bars.site(bar, share).text}{each}" for each in about]
        return with_joint(problem, bars, own, share, named, values)

    starts = np.column_stack([steps(k, _STARTS if len(axes) == 1 else _ALIKE)] * len(axes))
    sizes = tuple(replace(k, name=name) for name in names)
    about = f"about {enumerated(axes)}" if len(axes) > 1 else ""
    made = places(model, candidate, sizes, does, starts, extend, chosen, about)
    return [replace(one, limit=_root(model, line)) for one, line in zip(made, chosen, strict=True)]


def _root(model: Reduced, line: Line) -> Callable[[np.ndarray], str]:
    """`support` of a splice at an end that is held against turning: that end is then a flexible support."""
    held = {node for node, direction in model.problem.mesh.standing.tolist() if direction >= 3}
    nodes = model.bars.nodes[line.members[[0, -1]], [0, 1]].tolist()
    ends = [s for s, node in zip((0.0, line.length), nodes, strict=True) if node in held]
    limit = lambda values: "support" if any(abs(values[-1] - s) < _ROOT * line.length for s in ends) else ""
    return limit


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


def _recipe(
    model: Reduced, candidate: Candidate, planes: tuple[int, ...], end: int, log_prior: float, own: Torsion | None
) -> Recipe:
    """planes: the bars of one element, of the planes in which it turns against the rest; own: its torsion, if it twists too."""
    bars, first = model.bars, planes[0]
    node = int(model.problem.mesh.node_ids[bars.nodes[first, end]])
    axes = [ABOUT[bars.plane[bar]] for bar in planes] + (["local x"] if own else [])
    site = Site(
        "node",
        (node,),
        bars.point(first, float(end)),
        f"element {bars.ids[first]} at node {node}, about {enumerated(axes)}",
    )
    several = len(axes) > 1
    scales = [bars.EI[bar] / bars.lines[bars.line[bar]].length for bar in planes] + ([own.GJ] if own else [])
    k = [joint_stiffness(model, scale) for scale in scales]
    k = [
        replace(each, name=f"{each.name} about {axis}" if several else each.name) for each, axis in zip(k, axes, strict=True)
    ]
    b = np.array([1.0, 2.0 * end - 1, 0.0])

    def change(values: np.ndarray) -> Change:
        turns = zip(planes, values, strict=False)
        turning = summed([hinged(bars, bar, float(end), np.outer(b, b) / value) for bar, value in turns])
        return twisted(turning, bars, first, float(end), own, values[-1]) if own else turning

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        named = [f"joint of element {bars.ids[first]} at node {node}, about {axis}" for axis in axes]
        return with_joint(problem, bars, list(planes), float(end), named, values)

    grid = np.column_stack([steps(each, _STARTS) for each in k])
    return Recipe(candidate, tuple(k), change, grid, lambda values: site, 0, log_prior, extend)


CANDIDATE = Candidate(
    "joint",
    "a flexible joint",
    "local-stiffness",
    "a connection of bars (bolts, weld, corner, or a splice anywhere along them) that the model takes as rigid and that rotates in "
    "proportion to the moment, about one axis or both, and in space about all three",
    recipes,
    bars,
)
