"""Nodes of shells whose rotations are held: how the shells stand there, by which rotations follow from what their faces move."""

import numpy as np

from mouse_cli.importing.cards import Faults, Line
from mouse_cli.importing.model import Clamp, Group, InputModel

HELP = "hold translations of two rows of nodes, or model the clamp by solids"
_ALONG = 1e-6  # of a unit normal: what it may have across a global axis


def clamped(model: InputModel, lines: dict[int, Line], faults: Faults) -> dict[int, Clamp]:
    """How shells stand at the nodes of `lines`; refused where they have no one thickness, or no one normal along a global axis."""
    found: dict[int, list[tuple[float, np.ndarray]]] = {node: [] for node in lines}
    for group in model.groups if lines else ():
        for e in group.elements:
            kind, nodes = model.elements[e]
            for node in found.keys() & set(nodes) if kind.startswith("S") and not kind.startswith("SPRING") else ():
                found[node].append((_thickness(group), normal(model, kind, nodes)))
    clamps, told = {}, set()
    for node, each in found.items():
        thick, normals = np.array([t for t, _ in each]), np.array([n for _, n in each])
        axis = int(np.argmax(np.abs(normals[0])))
        sign = np.sign(normals[0, axis])
        if np.ptp(thick) == 0 and thick[0] and np.allclose(normals, sign * np.eye(3)[axis], rtol=0, atol=_ALONG):
            clamps[node] = Clamp(axis, float(sign * thick[0] / 2))
        elif id(lines[node]) not in told:
            told.add(id(lines[node]))
            why = (
                "where shells meet, or change their thickness"
                if len(each) > 1
                else "of a laminate or a shell that is oblique"
            )
            message = (
                f"rotations of node {node} are held, {why}: CalculiX makes solids of shells, and stiffens them there"
            )
            faults.add("MD273", message, lines[node].span, HELP)
    return clamps


def _thickness(group: Group) -> float:
    """Of its shells; 0 for a laminate, and for shells that are off their nodes."""
    plain = group.shell and not group.owner.options.keys() & {"OFFSET", "NODAL THICKNESS"}
    return float(group.owner.lines[0].words[0]) if plain else 0.0


def normal(model: InputModel, kind: str, nodes: tuple[int, ...]) -> np.ndarray:
    """Unit normal (3,) of a flat shell, by its corners."""
    corners = [model.nodes[n] for n in nodes[: 3 if kind in ("S3", "S6") else 4]]
    normal = np.cross(corners[1] - corners[0], corners[-1] - corners[0])
    return normal / max(float(np.linalg.norm(normal)), 1e-300)
