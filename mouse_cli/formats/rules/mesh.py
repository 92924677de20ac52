"""Rules for structures: nodes, elements with their properties, and the parameters that are bound to these."""

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft, MeshDraft
from mouse_cli.formats.rules.entries import MOST
from mouse_cli.model.mesh import ElementSet
from mouse_cli.terms.elements import registry


def mesh(draft: Draft) -> None:
    """Everything that can be told before a model is made of it."""
    given = draft.mesh
    if given is None:
        return
    for i in np.flatnonzero(~np.isfinite(given.mesh.coordinates).all(axis=1))[:MOST]:
        number = given.mesh.node_ids[i]
        draft.error(
            "MD302",
            f"a coordinate of node {number} is not finite",
            given.node_place(int(i)),
            help="give a finite number",
        )
    for s, members in enumerate(given.mesh.elements):
        _values(draft, given, s, members)
        _forgotten(draft, given, s, members)
    _bound_once(draft, given)


def _values(draft: Draft, given: MeshDraft, s: int, members: ElementSet) -> None:
    """Properties are finite, and positive where they must be."""
    about = registry()[members.type].properties
    for name, values in members.properties.items():
        needed, unit = "finite", "" if about[name].unit == "1" else f" {about[name].unit}"
        wrong = ~np.isfinite(values)
        if about[name].positive:
            needed, wrong = "positive", wrong | ~(values > 0)
        if about[name].or_zero:
            needed, wrong = "positive or zero", wrong | ~(values >= 0)
        if (values >= about[name].below).any():
            needed, wrong = f"below {about[name].below:g}", wrong | (values >= about[name].below)
        source = members.origin.get(name)
        for i in np.flatnonzero(wrong)[: 1 if source else MOST]:
            held = f" (from {source})" if source else ""
            message = f"{name} of element {members.ids[i]} is {values[i]:.8g}{unit}{held}; it must be {needed}"
            draft.error("MD425", message, given.element_place(s, int(i)), help=f"give {name} that is {needed}")


def _forgotten(draft: Draft, given: MeshDraft, s: int, members: ElementSet) -> None:
    """Beams in space without a constant of their section: what it would resist is then left out of the model."""
    if members.type != "beam" or len(given.mesh.directions) < 6:
        return
    nothing = np.zeros(len(members))
    without = {name: members.properties.get(name, nothing) == 0 for name in ("Iy", "Iz", "J")}
    names = [name for name, lacking in without.items() if lacking.any()]
    if names:
        lacking = np.flatnonzero(np.logical_or.reduce([without[name] for name in names]))
        element = int(lacking[0])
        draft.warn(
            "MD426",
            f"beam {members.ids[element]} has {' and '.join(f'{n} = 0' for n in names)}; "
            f"{len(lacking)} such of these {len(members)} beams",
            given.element_place(s, element),
            help=f"give {' and '.join(names)}, or a shape of the section (tube, rectangle, ...); plane: XY if it moves in a plane",
        )


def _bound_once(draft: Draft, given: MeshDraft) -> None:
    """A property of an element is the value of one parameter; only factors may come on top of one another."""
    owner: dict[tuple[int, str], np.ndarray] = {}
    for binding in given.bindings:
        if binding.factor:
            continue
        members = given.mesh.elements[binding.set]
        taken = owner.setdefault((binding.set, binding.property), np.full(len(members), -1))
        twice = binding.members[(taken[binding.members] >= 0) & (taken[binding.members] != binding.parameter)]
        if len(twice):
            names = [p.name for p in draft.parameters]
            first, second = names[taken[twice[0]]], names[binding.parameter]
            message = f"{binding.property} of element {members.ids[twice[0]]} is the value of two parameters, {first} and {second}"
            place = draft.parameters[binding.parameter].span
            draft.error("MD415", message, place, help="give the element to one of them, or make one a factor: true")
        taken[binding.members] = binding.parameter


def fault_place(given: MeshDraft, nodes: tuple[int, ...], elements: tuple[int, ...]) -> Span:
    """Where the first element or node stands that a fault of the mesh names."""
    return given.of_element(elements[0]) if elements else given.of_node(nodes[0]) if nodes else given.span
