"""A spring from a place to the ground in a direction that is no axis: a guy, a strut, an inclined bearing."""

from itertools import product

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import Points, all_motions
from mouse_cli.diagnosis.sites.reasons import translations
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_MOVES = 0.02  # share of the largest motion in a measured mode below which a direction at a place takes no part
_SIZES = 3  # stiffnesses to begin from
_AZIMUTH = Unknown(
    "azimuth", "rad", -0.5 * np.pi, 0.5 * np.pi, log=False
)  # half of the directions: a spring has two ends
_ELEVATION = Unknown("elevation", "rad", -0.5 * np.pi, 0.5 * np.pi, log=False)


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k b'b, b = n'T for the motion T of a place: along a line or at a node, where it moves along more than one axis."""
    if model.motion is None:
        return []
    count = model.low_modes(2)
    points = [each for each in all_motions(model) if len(each.dofs) > 1]
    size = [np.max([np.abs(p.motion(at)[:, :count]).max(axis=1) for at in p.starts], axis=0) for p in points]
    least = _MOVES * max((own.max() for own in size), default=0.0)
    found = [(p, tuple(np.flatnonzero(own > least).tolist())) for p, own in zip(points, size, strict=True)]
    return [_recipe(model, candidate, point, axes) for point, axes in found if len(axes) > 1]


def along(values: np.ndarray, axes: tuple[int, ...], count: int = 3) -> np.ndarray:
    """Unit vector (count,) of azimuth and elevation (2,), or of the first alone where a place moves along two `axes`.

    >>> abs(along(np.array([np.pi / 2, 0.0]), (0, 1, 2))).round(3).tolist()
    [0.0, 1.0, 0.0]
    """
    level, n = np.cos(values[1]) if len(axes) > 2 else 1.0, np.zeros(count)
    n[axes[0]], n[axes[1]] = level * np.cos(values[0]), level * np.sin(values[0])
    if len(axes) > 2:
        n[axes[2]] = np.sin(values[1])
    return n


def _starts(axes: tuple[int, ...]) -> np.ndarray:
    """Angles (g, 1 or 2) of directions half-way between all axes, one of each and its opposite."""
    n = np.array([(1.0, *rest) for rest in product((-1, 1), repeat=len(axes) - 1)])
    azimuth = np.arctan2(n[:, 1], n[:, 0])
    if len(axes) < 3:
        return azimuth[:, None]
    return np.column_stack([azimuth, np.arctan2(n[:, 2], np.hypot(n[:, 0], n[:, 1]))])


def _recipe(model: Reduced, candidate: Candidate, point: Points, axes: tuple[int, ...]) -> Recipe:
    """axes: numbers of `point.dofs`."""
    scale, t = lowest(model) * total_mass(model), len(axes)
    sizes = (Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale), *(_AZIMUTH, _ELEVATION)[: t - 1])

    def direction(values: np.ndarray) -> np.ndarray:
        n = np.zeros(3)
        n[list(point.dofs)] = along(values[1:], axes, len(point.dofs))
        return n

    def site(values: np.ndarray) -> Site:
        here, n = point.site(values[t:]), np.round(direction(values), 2)
        n = n * np.sign(n[n != 0][0])  # a direction and its opposite are one line
        return Site(here.kind, here.ids, here.position, f"{here.text}, along ({', '.join(f'{x + 0.0:.2f}' for x in n)})")

    def change(values: np.ndarray) -> Change:
        b = along(values[1:], axes, len(point.dofs)) @ point.motion(values[t:])
        return Change(K=values[0] * np.outer(b, b))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit, n = Edit(problem), direction(values)
        options = {"axes": [n.tolist(), np.eye(3)[int(np.argmin(np.abs(n)))].tolist()]}
        spring = edit.add("spring", [[node_at(edit, point.site(values[t:]))]], {"TX": values[0]}, options)
        edit.bind(f"spring to the ground at {site(values).text}", spring, ("TX",), unit="N/m")
        return edit.done()

    each = product(steps(sizes[0], _SIZES), _starts(axes), point.starts)
    grid = np.array([np.concatenate([[k], angles, at]) for k, angles, at in each])
    unknowns, log_prior = (*sizes, *point.unknown), float(np.log(point.share))
    return Recipe(candidate, unknowns, change, grid, site, log_prior=log_prior, extend=extend, linear=0)


CANDIDATE = Candidate(
    "inclined-spring",
    "an inclined spring to the ground",
    "ground-spring",
    "a guy, a strut or an inclined bearing that ties a place to the surroundings along no axis: K + k b'b, b = n'T for the "
    "translations T of the place and a unit vector n",
    recipes,
    translations,
)
