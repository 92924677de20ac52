"""A spring between two places that nothing joins in the model: a brace, a cable, a strut; or two that cross in one panel."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.diagonals import with_diagonals
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_entries
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.pairs import ALONG, chosen, left_together, pairs, site_of
from mouse_cli.diagnosis.sites.panels import crossed, panel
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_SIZES = 4  # to begin from
_CROSSED = 0.3  # prior probability that it is two diagonals that cross


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + b'(1/k + R)^-1 b, b the elongation between two nodes, or the relative motion of two masses of a row; or b (2, r) of two
    diagonals of one panel that are alike.
    """
    every = pairs(model)
    if not len(every):
        return []
    one, two = chosen(model, every), crossed(model, every)
    scale = lowest(model) * total_mass(model)
    k = Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale)
    left = one.left(model.eigenvalues)[:, None, None]
    share, each = np.log([1 - _CROSSED, _CROSSED] if len(two) else [1.0, 1.0]), every.log_prior[two].mean(axis=1)
    alone = [
        replace(
            _recipe(candidate, k, key[None], (b[None], R), site_of(model, key), float(prior)),
            starts=_starts(model, key),
        )
        for key, b, R, prior in zip(one.keys, one.rows, left, one.log_prior + share[0], strict=True)
    ]
    both = zip(every.keys[two], every.rows[two], left_together(model, every, two), strict=True)
    return alone + [
        _recipe(candidate, k, keys, (b, R), panel(model.problem.mesh, keys), float(prior))
        for (keys, b, R), prior in zip(both, each - np.logaddexp.reduce(each) + share[1], strict=True)
    ]


def _starts(model: Reduced, key: np.ndarray) -> tuple[np.ndarray, ...]:
    """The stiffness that the screening of many pairs found for this one."""
    k = (model.ties or {}).get(tuple(key.tolist()), np.nan)
    return (np.array([k]),) if np.isfinite(k) else ()


def _recipe(
    candidate: Candidate,
    k: Unknown,
    keys: np.ndarray,
    along: tuple[np.ndarray, np.ndarray],
    site: Site,
    log_prior: float,
) -> Recipe:
    """keys (s, 3): springs of one stiffness. along: b (s, r), and R (s, s), see `Pairs.left`."""
    b, R = along
    change = lambda values: Change(K=b.T @ np.linalg.solve(np.eye(len(b)) / values[0] + R, b))
    extend = lambda problem, values: _with_springs(problem, keys, site, values[0])
    return Recipe(
        candidate, (k,), change, steps(k, _SIZES)[:, None], lambda values: site, log_prior=log_prior, extend=extend
    )


def _with_springs(problem: Problem, keys: np.ndarray, site: Site, k: float) -> Problem:
    name = f"spring {site.text}"
    one, other, direction = keys[0].tolist()
    if of_matrices(problem):
        spring = np.array([one, one, other]), np.array([one, other, other]), np.array([1.0, -1.0, 1.0])
        return with_entries(problem, found(name, k, "N/m"), K=spring)
    nodes = np.array(site.ids).reshape(-1, 2)
    if direction == ALONG:
        return with_diagonals(problem, nodes, name, np.full(len(nodes), k))
    edit = Edit(problem)
    own = edit.add("spring", [[edit.index(int(n)) for n in nodes[0]]], {DIRECTIONS[direction]: k})
    edit.bind(name, own, (DIRECTIONS[direction],), unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "brace",
    "a spring between two points",
    "brace",
    "a brace, cable, strut or tie that joins two points which nothing joins in the model (ends of members, point masses, or places "
    "within members that meet in a corner): K + k b'b, b their elongation along the line between them; two alike that cross in one "
    "panel of a frame; floors of a row of storeys, or masses of a chain, that are not neighbours: their relative motion",
    recipes,
)
