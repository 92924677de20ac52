"""The deck with a foundation that moves as one body, or below storeys that turn with it."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.sites.bases import SWAYING, Axis, Base
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import RigidLink
from mouse_cli.model.problem import Problem


def joined(problem: Problem, base: Base, directions: list[int], values: np.ndarray) -> Problem:
    """All supports joined to one node, which springs (N/m, N m/rad) hold in `directions`, supports in all others."""
    edit = Edit(problem)
    kept = problem.mesh.directions
    nodes = [edit.index(number) for number in base.numbers]
    middle = next((link.independent for link in edit.links if link.dependent == nodes[-1]), None)
    if middle is None:
        middle = edit.node(np.array(base.centre))
        for node in nodes:
            held = tuple(sorted(d for n, d in edit.supports if n == node and d in kept))
            edit.links.append(RigidLink(middle, node, held))
        edit.supports = [each for each in edit.supports if each[0] not in nodes] + [(middle, d) for d in range(6)]
    for d, value in zip(directions, values, strict=True):
        _spring(edit, middle, d, value)
    return edit.done()


def _spring(edit: Edit, node: int, direction: int, value: float) -> None:
    """A spring in place of a support."""
    name, unit = DIRECTIONS[direction], "N m/rad" if direction > 2 else "N/m"
    edit.supports = [each for each in edit.supports if each != (node, direction)]
    edit.bind(f"stiffness of the foundation, {name}", edit.add("spring", [[node]], {name: value}), (name,), unit=unit)


def on_joints(problem: Problem, axis: Axis, number: int, values: np.ndarray) -> Problem:
    """Storeys as joints between floors that all turn with the base, a spring (N m/rad) and the inertia (kg m2) there."""
    edit = Edit(problem)
    node, floors = edit.index(number), set()
    for s, own in enumerate(edit.sets):
        if own.type in SWAYING:
            properties = {name: value for name, value in own.properties.items() if name in DIRECTIONS}
            edit.sets[s] = replace(own, type="joint", properties=properties)
            floors |= set(own.nodes.ravel().tolist()) - {node}
    edit.directions = tuple(sorted({*edit.directions, axis.rotation}))
    edit.links += [RigidLink(node, floor, (axis.rotation,)) for floor in sorted(floors)]
    _spring(edit, node, axis.rotation, values[0])
    name = "J" + "xyz"[axis.rotation - 3]
    inertia = edit.add("mass", [[node]], {"mass": 0.0, name: values[1]})
    edit.bind("rotary inertia of floors and foundation", inertia, (name,), unit="kg m2")
    return edit.done()
