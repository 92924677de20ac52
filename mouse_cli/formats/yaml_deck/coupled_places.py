"""Places of substructures: names in a deck become degrees of freedom of a model, or responses and forces that were measured."""

from dataclasses import replace
from difflib import get_close_matches

import numpy as np

from mouse_cli.formats.own_names import own_sensor
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.model.coupling import Point, Substructure
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.problem import Problem

MISSING = -1


class Places:
    """The places of all substructures that are named so far; each name stands once."""

    def __init__(self, document: Document, parts: list[Substructure]):
        self.document, self.parts = document, parts
        self._number = {part.name: i for i, part in enumerate(parts)}
        self._found: list[dict[str, object]] = [{} for _ in parts]
        self._known = [_measured(part.frf) if part.measured else _modelled(part.problem) for part in parts]

    def point(self, node: Node, what: str) -> Point | None:
        """One place; None after an error."""
        found = self.points(node, what)
        if found is not None and len(found) != 1:
            return yaml_values.mistyped(self.document, node, what, KINDS["point"].words)
        return found[0] if found else None

    def points(self, node: Node, what: str) -> list[Point] | None:
        """{substructure: places, ...} in their order; of a single substructure also the places alone. None after an error."""
        if not yaml_values.is_mapping(node):
            if len(self.parts) == 1:
                return self._of(0, node, what)
            return yaml_values.mistyped(self.document, node, what, KINDS["points"].words)
        found: list[Point] = []
        for key, value in node.value:
            which = self.substructure(key, what)
            own = None if which is None else self._of(which, value, what)
            if own is None:
                return None
            found += own
        return found

    def pairs(self, node: Node, what: str) -> list[tuple[Point, Point]] | None:
        """The pairs of one item of `interfaces`: two substructures with as many places each. None after an error."""
        if not yaml_values.is_mapping(node) or len(node.value) != 2:
            words = "{substructure: degrees of freedom, substructure: degrees of freedom}"
            return yaml_values.mistyped(self.document, node, what, words)
        sides = []
        for key, value in node.value:
            which = self.substructure(key, what)
            sides.append(None if which is None else self._of(which, value, what))
        if None in sides:
            return None
        if len(sides[0]) != len(sides[1]):
            counts = " and ".join(
                f"{len(side)} of {key.value}" for side, (key, _) in zip(sides, node.value, strict=True)
            )
            message = f"{what} joins {counts}; the two lists go pair by pair"
            return self.document.error("MD702", node, message, "name equally many degrees of freedom on both sides")
        return list(zip(*sides, strict=True))

    def substructure(self, node: Node, what: str) -> int | None:
        """The substructure (from 0) that a key names."""
        name = yaml_values.text(self.document, node, f"a name in {what}")
        if name is None or name in self._number:
            return self._number.get(name)
        near = get_close_matches(name, self._number, 1)
        help = f"write '{near[0]}'" if near else f"the substructures are {', '.join(self._number)}"
        return self.document.error("MD701", node, f"{what} names '{name[:40]}', which is no substructure", help)

    def _of(self, which: int, node: Node, what: str) -> list[Point] | None:
        nodes = node.value if yaml_values.is_list(node) else [node]
        found = [self._one(which, item, what) for item in nodes]
        return None if None in found or not found else found

    def _one(self, which: int, node: Node, what: str) -> Point | None:
        name = yaml_values.text(
            self.document, node, f"a degree of freedom in {what}", "a degree of freedom, by number or by label"
        )
        if name is None:
            return None
        places = self._found[which]
        if name not in places:
            value = _looked_up(name, self._known[which])
            if value is None:
                return self._unknown(which, node, name, what)
            places[name] = value
        return Point(which, list(places).index(name))

    def _unknown(self, which: int, node: Node, name: str, what: str) -> None:
        part, known = self.parts[which], list(self._known[which])
        near = get_close_matches(name, known, 3) or known[:12]
        of = part.name or "the model"
        why = f"of which {of} has no function" if part.measured else f"which is no degree of freedom of {of}"
        note = f"there are {', '.join(near)}{' ...' if len(known) > len(near) else ''}"
        message = f"{what} names '{name[:40]}', {why}"
        self.document.error("MD703", node, message, "name a degree of freedom that is there", note)

    def filled(self) -> tuple[Substructure, ...]:
        """The substructures with the places that were named."""
        return tuple(
            _with_measured(part, places) if part.measured else _with_modelled(part, places)
            for part, places in zip(self.parts, self._found, strict=True)
        )


def _looked_up(name: str, known: dict[str, object]) -> object | None:
    """What a name stands for; `12-TY` is 12TY read backwards."""
    if name in known:
        return known[name]
    own = own_sensor(name)
    label, sign = next(iter(own.weights.items())) if own is not None else ("", 1.0)
    found = known.get(label)
    if found is None:
        return None
    return [(dof, sign * weight) for dof, weight in found] if isinstance(found, list) else (*found[:2], sign * found[2])


def _modelled(problem: Problem) -> dict[str, list[tuple[int, float]]]:
    """Weights of every name of a model: its labels, numbers of a model without nodes, named sensors of its modal test."""
    labels = problem.structure.labels
    known: dict[str, list] = {label: [(i, 1.0)] for i, label in enumerate(labels)}
    if problem.structure.geometry is None:
        known = {str(i): [(i - 1, 1.0)] for i in range(1, problem.structure.n + 1)} | known
    test = problem.test
    if test is not None and test.sensing is not None and test.sensors:
        rows = test.sensing.toarray() if hasattr(test.sensing, "toarray") else np.asarray(test.sensing)
        for name, row in zip(test.sensors, rows, strict=True):
            known.setdefault(name, [(int(i), float(row[i])) for i in np.flatnonzero(row)])
    return known


def _measured(frf: FrfTest) -> dict[str, tuple[int, int, float]]:
    """Number of the response and of the force of every name, MISSING where there is none, and sign 1."""
    responses, forces = ({name: i for i, name in enumerate(side)} for side in (frf.output_names, frf.input_names))
    names = dict.fromkeys([*responses, *forces])
    return {name: (responses.get(name, MISSING), forces.get(name, MISSING), 1.0) for name in names}


def _with_modelled(part: Substructure, places: dict[str, list]) -> Substructure:
    from scipy.sparse import coo_array

    n = part.problem.structure.n
    entries = [(row, dof, weight) for row, found in enumerate(places.values()) for dof, weight in found]
    row, col, value = (np.array(column) for column in zip(*entries, strict=True)) if entries else ([], [], [])
    weights = coo_array(
        (np.asarray(value, float), (np.asarray(row, int), np.asarray(col, int))), shape=(len(places), n)
    ).tocsr()
    return replace(part, places=tuple(places), weights=weights)


def _with_measured(part: Substructure, places: dict[str, tuple]) -> Substructure:
    table = np.array(list(places.values())).reshape(-1, 3)
    return replace(
        part, places=tuple(places), responses=table[:, 0].astype(int), forces=table[:, 1].astype(int), signs=table[:, 2]
    )
