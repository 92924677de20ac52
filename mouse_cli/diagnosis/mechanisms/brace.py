"""A spring between two places that nothing joins in the model: a brace, a cable, a strut."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_entries
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.pairs import ALONG, chosen, site_of
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_SIZES = 4  # to begin from


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + k / (1 + k R) b'b, b the elongation between two nodes, or the relative motion of two masses of a row."""
    pairs = chosen(model)
    if not len(pairs):
        return []
    scale = lowest(model) * total_mass(model)
    k = Unknown("stiffness", "N/m", 1e-3 * scale, 1e3 * scale)
    left = pairs.left(model.eigenvalues)
    return [
        replace(_recipe(candidate, k, key, (b, R), site_of(model, key), float(prior)), starts=_starts(model, key))
        for key, b, R, prior in zip(pairs.keys, pairs.rows, left, pairs.log_prior, strict=True)
    ]


def _starts(model: Reduced, key: np.ndarray) -> tuple[np.ndarray, ...]:
    """The stiffness that the screening of many pairs found for this one."""
    k = (model.ties or {}).get(tuple(key.tolist()), np.nan)
    return (np.array([k]),) if np.isfinite(k) else ()


def _recipe(
    candidate: Candidate, k: Unknown, key: np.ndarray, along: tuple[np.ndarray, float], site: Site, log_prior: float
) -> Recipe:
    """along: b (r,), and R, see `Pairs.left`."""
    b, R = along

    def change(values: np.ndarray) -> Change:
        return Change(K=values[0] / (1 + values[0] * R) * np.outer(b, b))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        return _with_spring(problem, key, site, values[0])

    return Recipe(
        candidate, (k,), change, steps(k, _SIZES)[:, None], lambda values: site, log_prior=log_prior, extend=extend
    )


def _with_spring(problem: Problem, key: np.ndarray, site: Site, k: float) -> Problem:
    name = f"spring {site.text}"
    one, other, direction = key.tolist()
    if of_matrices(problem):
        spring = np.array([one, one, other]), np.array([one, other, other]), np.array([1.0, -1.0, 1.0])
        return with_entries(problem, found(name, k, "N/m"), K=spring)
    edit = Edit(problem)
    nodes = [edit.index(number) for number in site.ids]
    along, options = "TX", {}
    if direction == ALONG:
        x = edit.coordinates[nodes[1]] - edit.coordinates[nodes[0]]
        options = {"axes": [x.tolist(), np.eye(3)[np.argmin(np.abs(x))].tolist()]}
    else:
        along = DIRECTIONS[direction]
    edit.bind(name, edit.add("spring", [nodes], {along: k}, options), (along,), unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "brace",
    "a spring between two points",
    "brace",
    "a brace, cable, strut or tie that joins two points which nothing joins in the model: K + k b'b, b their elongation along the "
    "line between them; floors of a row of storeys, or masses of a chain, that are not neighbours: their relative motion",
    recipes,
)
