"""Masses on rigid arms: the end of an arm a moves as u + theta x a when its node moves by u and turns by theta.

It moves in the directions that the deck keeps, as any node does: in a model of bending alone, no arm across the beam is felt.
"""

import numpy as np

from mouse_cli.diagnosis.effects.change import Unknown
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import span
from mouse_cli.diagnosis.sites.attached import Attached, attached
from mouse_cli.diagnosis.sites.ends import ends, laden
from mouse_cli.diagnosis.sites.points import wanted
from mouse_cli.model.mesh import ElementSet, RigidLink

_MOST = 40  # nodes that are looked at
_LONGEST = 0.3  # of the structure
_BEGIN = (0.1, 0.4)  # of the longest, where a search begins
_STILL = 1e-6  # of the largest translation: what turning by a rad adds to that, below which no arm is felt
_AXES = "XYZ"


def arms(model: Reduced, node: int) -> tuple[tuple[Unknown, ...], np.ndarray, list[int]]:
    """Components of an arm that matter at a node (index), arms (g, c) to begin from, and the axes (c,) of the components.

    None matters where the node does not turn.
    """
    used = slice(0, model.low_modes(2))
    rows, length = model.node(node)[:, used], _LONGEST * span(model)
    added = [at_end(model, rows, axis) - rows[:3] for axis in np.eye(3)]
    size = [np.abs(each).max(initial=0.0) * length for each in added]
    axes = [d for d in range(3) if size[d] > _STILL * np.abs(rows[:3]).max(initial=0.0)]
    unknowns = tuple(Unknown(f"arm along {_AXES[d]}", "m", -length, length, log=False) for d in axes)
    signs = np.concatenate([np.eye(len(axes)), -np.eye(len(axes))])
    return unknowns, np.concatenate([share * length * signs for share in _BEGIN]), axes


def turning(model: Reduced) -> tuple[list[tuple[int, Attached]], int]:
    """Nodes that turn in the measured modes, those that turn most, and of how many; ends of members and point masses first."""
    if model.motion is None:
        return [], 0
    mesh, keep = model.problem.mesh, wanted(model)
    first = {*ends(mesh).tolist(), *laden(mesh).tolist()}
    every = np.unique(np.concatenate([np.array(sorted(first), int)] + [each.nodes.ravel() for each in mesh.elements]))
    found = [node for node in every.tolist() if (keep is None or keep[node]) and arms(model, node)[0]]
    count = model.low_modes(2)
    turned = {node: np.abs(model.node(node)[3:, :count]).max() for node in found}
    chosen = sorted(sorted(found, key=lambda node: (node not in first, -turned[node]))[:_MOST])
    return list(zip(chosen, attached(model, chosen), strict=True)), len(found)


def arm(values: np.ndarray, axes: list[int]) -> np.ndarray:
    """The arm (3,) of components `values` (c,)."""
    found = np.zeros(3)
    found[axes] = values
    return found


def at_end(model: Reduced, rows: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Motion (3, r) of the end of an arm (3,) from that (6, r) of its node."""
    x, y, z = vector
    turned = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])  # times a vector: its product with that of the arm
    turned[[d for d in range(3) if d not in model.problem.mesh.directions]] = 0.0
    return rows[:3] + turned @ rows[3:]


def offset(members: ElementSet) -> np.ndarray:
    """The vector (3,) from their nodes to the point masses of a set."""
    given = members.options.get("offset")
    return np.zeros(3) if given is None else np.asarray(given, float)


def with_arm(edit: Edit, node: int, vector: np.ndarray) -> int:
    """A new node (index) at the end of a rigid arm from a node."""
    end = edit.node(edit.coordinates[node] + vector)
    edit.links.append(RigidLink(node, end))
    return end
