"""The `structure:` of a deck that is written: ranges and lines where the numbers allow, tables beside the deck when large."""

from typing import Any

import numpy as np

from mouse_cli.formats.yaml_deck.ids import ranges
from mouse_cli.formats.yaml_deck.keys.structure import PLANES, SECTIONS
from mouse_cli.formats.yaml_deck.text import flow, real, word, wrapped
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.mesh import ElementSet, Mesh

LARGEST_INLINE = 500  # nodes off lines, or elements one by one, that stand in the deck itself
Tables = dict[str, Any]  # text of the files beside the deck, by name
_MATERIAL = tuple(SECTIONS["material"].keys)


def structure(mesh: Mesh, stem: str, tables: Tables, labels: tuple[str, ...] = ()) -> list[str]:
    """The lines of `structure:`; labels: of the degrees of freedom that serve as nodes, when the mesh has none of its own."""
    lines = ["  structure:"]
    if not labels:
        lines += _nodes(mesh, stem, tables)
    named = _named(mesh)
    for key in ("materials", "sections"):
        if named[key]:
            lines.append(f"    {key}:")
        lines += [f"      {word(name)}: {_mapping(values)}" for name, values in named[key].items()]
    lines.append("    elements:")
    for i, members in enumerate(mesh.elements, 1):
        lines += _elements(mesh, members, named, f"{stem}_elements{i}.csv", tables, labels)
    gravity = [] if mesh.gravity is None else [f"    gravity: {_vector(mesh.gravity)}"]
    rest = _supports(mesh) + _links(mesh) + ([] if labels else _directions(mesh))
    return lines + rest + gravity + _generic(mesh)


def _mapping(values: dict[str, float]) -> str:
    return "{" + ", ".join(f"{key}: {real(value)}" for key, value in values.items()) + "}"


def _vector(values: Any) -> str:
    return flow(real(float(v)) for v in values)


def _nodes(mesh: Mesh, stem: str, tables: Tables) -> list[str]:
    ids, xyz = mesh.node_ids, mesh.coordinates
    blocks = _runs(ids, xyz)
    if sum(last == first for first, last in blocks) > LARGEST_INLINE:
        name = f"{stem}_nodes.csv"
        rows = (",".join([str(i), *map(repr, place)]) for i, place in zip(ids.tolist(), xyz.tolist(), strict=True))
        tables[name] = "id,x,y,z\n" + "\n".join(rows) + "\n"
        return [f"    nodes: {{file: {word(name)}}}"]
    lines = ["    nodes:"]
    for first, last in blocks:
        if first == last:
            lines.append(f"      - {{{ids[first]}: {_vector(xyz[first])}}}")
        else:
            ends = f"start: {_vector(xyz[first])}, end: {_vector(xyz[last])}"
            lines.append(f"      - {{line: {{from: {ids[first]}, to: {ids[last]}, {ends}}}}}")
    return lines


def _runs(ids: np.ndarray, xyz: np.ndarray) -> list[tuple[int, int]]:
    """(first, last) of each run of nodes that a line reproduces to the last digit; single nodes else."""
    step = np.diff(xyz, axis=0)
    close = np.isclose(step[1:], step[:-1], rtol=1e-9, atol=1e-12 * (np.abs(xyz).max(initial=0.0))).all(axis=1)
    onward = close & (np.diff(ids)[1:] == 1) & (np.diff(ids)[:-1] == 1)  # nodes i, i + 1, i + 2 in line
    found, i = [], 0
    while i < len(ids):
        stop = np.flatnonzero(~onward[i:])
        last = min(i + 1 + (int(stop[0]) if len(stop) else len(onward) - i), len(ids) - 1)
        if last - i >= 2 and np.array_equal(_line(xyz[i], xyz[last], last - i + 1), xyz[i : last + 1]):
            found.append((i, last))
            i = last + 1
        else:
            found.append((i, i))
            i += 1
    return found


def _line(start: np.ndarray, end: np.ndarray, count: int) -> np.ndarray:
    share = np.linspace(0.0, 1.0, count)[:, None]
    return start * (1 - share) + end * share


def _named(mesh: Mesh) -> dict[str, dict[str, dict[str, float]]]:
    """Materials and sections by name, as far as all elements that name them agree."""
    found: dict[str, dict[str, dict[str, float]]] = {"materials": {}, "sections": {}}
    for members in mesh.elements:
        for name, source in members.origin.items():
            table = found["materials" if name in _MATERIAL else "sections"].setdefault(source, {})
            table.setdefault(name, float(members.properties[name][0]))
    return found


def _elements(
    mesh: Mesh, members: ElementSet, named: dict, file: str, tables: Tables, labels: tuple[str, ...]
) -> list[str]:
    """One entry; elements at degrees of freedom, which a deck names one by one, an entry each."""
    if labels:
        each = [flow(str(dof + 1) for dof in nodes) for nodes in members.nodes]
        return [_entry(members, np.array([i]), named, [f"dofs: {dofs}"], ()) for i, dofs in enumerate(each)]
    numbers, chain = mesh.node_ids[members.nodes], _chain(members.nodes)
    varying = [name for name, values in members.properties.items() if not (values == values[0]).all()]
    if len(members) > LARGEST_INLINE and (chain is None or varying):
        tables[file] = _table(members, numbers, varying)
        return [_entry(members, np.arange(len(members)), named, [f"file: {word(file)}"], tuple(varying))]
    nodes = ranges(mesh.node_ids[chain]) if chain is not None else wrapped((flow(map(str, row)) for row in numbers), 8)
    if chain is not None and not nodes.startswith("[") and "-" not in nodes:
        nodes = f"[{nodes}]"
    return [_entry(members, np.arange(len(members)), named, [f"nodes: {nodes}"], ())]


def _chain(nodes: np.ndarray) -> np.ndarray | None:
    """Nodes one after another, when the elements make a chain or stand at single nodes."""
    if nodes.shape[1] == 1:
        return nodes[:, 0]
    if nodes.shape[1] == 2 and (nodes[1:, 0] == nodes[:-1, 1]).all():
        return np.append(nodes[:, 0], nodes[-1, 1])
    return None


def _table(members: ElementSet, numbers: np.ndarray, varying: list[str]) -> str:
    head = ["id", *(f"node{i + 1}" for i in range(numbers.shape[1])), *varying]
    columns = [members.properties[name].tolist() for name in varying]
    rows = zip(members.ids.tolist(), *numbers.T.tolist(), *columns, strict=True)
    return "\n".join([",".join(head), *(",".join(map(repr, row)) for row in rows)]) + "\n"


def _entry(members: ElementSet, rows: np.ndarray, named: dict, where: list[str], filed: tuple[str, ...]) -> str:
    """An entry of `elements` for the members `rows`; `filed` properties stand in its table."""
    facts = [f"type: {members.type}", *where]
    if not where[0].startswith("file"):
        facts.insert(0, f"id: {ranges(members.ids[rows])}")
    taken: dict[str, str] = {}
    for name, source in members.origin.items():
        key = "material" if name in _MATERIAL else "section"
        if (
            taken.setdefault(key, source) == source
            and (members.properties[name] == named[f"{key}s"][source][name]).all()
        ):
            taken[name] = source
    facts += [f"{key}: {word(taken[key])}" for key in ("material", "section") if key in taken]
    for name, values in members.properties.items():
        if name not in filed and not (name in members.origin and name in taken):
            own = values[rows]
            same = (own == own[0]).all()
            facts.append(f"{name}: {real(own[0]) if same else wrapped(map(real, own), 8)}")
    facts += [f"{key}: {_option(value)}" for key, value in members.options.items() if value is not None]
    short = f"      - {{{', '.join(facts)}}}"
    if len(short) <= 110 and "\n" not in short:
        return short
    return "\n".join([f"      - {facts[0]}", *(f"        {fact}" for fact in facts[1:])])


def _option(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_option(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple | np.ndarray):
        return flow(map(_option, value))
    return word(value) if isinstance(value, str) else real(float(value))


def _directions(mesh: Mesh) -> list[str]:
    names = tuple(DIRECTIONS[d] for d in mesh.directions)
    plane = next((key for key, kept in PLANES.items() if kept == names), None)
    if names == DIRECTIONS:
        return []
    return [f"    plane: {plane}"] if plane else [f"    directions: {flow(names)}"]


def _generic(mesh: Mesh) -> list[str]:
    lines = []
    for group in mesh.generic:
        couplings = f", couplings: {flow(group.couplings)}" if group.couplings else ""
        lines.append(f"      - {{name: {word(group.name)}, elements: {ranges(group.elements)}{couplings}}}")
    return ["    generic:", *lines] if lines else []


def _supports(mesh: Mesh) -> list[str]:
    """Nodes that are held alike together."""
    held: dict[int, list[int]] = {}
    for node, direction in mesh.supports.tolist():
        held.setdefault(node, []).append(direction)
    alike: dict[tuple[int, ...], list[int]] = {}
    for node, along in held.items():
        alike.setdefault(tuple(sorted(along)), []).append(int(mesh.node_ids[node]))
    lines = []
    for along, numbers in alike.items():
        names = "all" if len(along) == len(DIRECTIONS) else flow(DIRECTIONS[d] for d in along)
        parts = ranges(np.sort(numbers)).strip("[]").split(", ")
        lines += [f"      {part}: {names}" for part in parts]
    return ["    supports:", *lines] if lines else []


def _links(mesh: Mesh) -> list[str]:
    lines, done = [], 0
    for i, link in enumerate(mesh.links, 1):
        following = mesh.links[i] if i < len(mesh.links) else None
        if following and (following.independent, following.directions) == (link.independent, link.directions):
            continue
        numbers = mesh.node_ids[[each.dependent for each in mesh.links[done:i]]]
        along = "" if len(link.directions) == 6 else f", directions: {flow(DIRECTIONS[d] for d in link.directions)}"
        lines.append(f"      - {{independent: {mesh.node_ids[link.independent]}, dependent: {ranges(numbers)}{along}}}")
        done = i
    return ["    rigid_links:", *lines] if lines else []
