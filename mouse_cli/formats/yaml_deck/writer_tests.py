"""The test of a Problem as YAML that reads back as the same test; recordings and functions stay in their files."""

import os
import re

import numpy as np

from mouse_cli._errors import WrittenError
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.hold_out import hold_out_lines
from mouse_cli.formats.yaml_deck.nodes import PLAIN, Node, compose, is_null
from mouse_cli.formats.yaml_deck.text import flow, maybe, real, word, wrapped
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

_NODE_LABEL = re.compile(r"[0-9]+[TR][XYZ]", re.ASCII)


def test_lines(problem: Problem, folder: str | None = None) -> list[str]:
    """The section `test:`, nothing for a deck without one; folder: of the new deck, None for that of the old one."""
    held, records = problem.hold_out, Written(problem, folder)
    test = problem.test if held is None else held.whole
    if test is None and not records.test:
        return []
    items, named = _rows(test, problem.structure.labels) if test is not None else ([], [])
    named += records.sensors(set(test.sensors) if test is not None else set())
    lines = ["", "test:", *(["  sensors:", *(f"    - {sensor}" for sensor in named)] if named else [])]
    lines += _modes(test, items) if test is not None else []
    kept = [] if held is None else hold_out_lines(held, items, problem.structure.geometry)
    kept += records.held()
    return [*lines, *records.lines(), *(["  hold_out:"] if kept else []), *kept]


def _modes(test: ModalTest, items: list[str]) -> list[str]:
    lines = ["  modes:", f"    number: {flow(map(str, test.number))}"]
    lines.append(f"    frequency: {wrapped(map(maybe, test.frequency_hz), 4)}  # Hz")
    lines.append(f"    frequency_sd: {wrapped(map(maybe, test.frequency_sd_hz), 4)}  # Hz")
    if test.s:
        lines.append(f"    dofs: {wrapped(items, 4)}")
        lines += _grid("shapes", test.shapes, "one row for each of dofs, one column for each mode")
        lines += _grid("shape_sd", test.shape_sd, "standard deviations of shapes")
    return [*lines, f"    scale: {test.scale}"]


def _rows(test: ModalTest, labels: tuple[str, ...]) -> tuple[list[str], list[str]]:
    """The items of `dofs`, and the sensors of their own that some of them name."""
    if test.sensing is None and not test.sensors:
        return [_label(labels, dof) if _is_node_label(labels, dof) else str(dof + 1) for dof in test.dofs], []
    items, sensors = [], []
    for name, (dofs, weights) in zip(test.sensors, _readings(test), strict=True):
        held = [each for each in test.held if each.sensor == name]
        read = [(_label(labels, dof), weight) for dof, weight in zip(dofs, weights, strict=True)]
        read += [(each.label, each.weight) for each in held]
        if len(read) == 1 and name == (_spelled(*read[0]) if held else _plain(labels, dofs, weights)):
            items.append(name)
            continue
        shares = ", ".join(f"{label}: {real(weight)}" for label, weight in read)
        items.append(_quoted(name))
        sensors.append(f"{{name: {_quoted(name)}, weights: {{{shares}}}}}")
    return items, sensors


def _readings(test: ModalTest) -> list[tuple[np.ndarray, np.ndarray]]:
    """What each sensor reads: degrees of freedom, from 0, and weights."""
    if test.sensing is None:
        return [(np.array([dof]), np.ones(1)) for dof in test.dofs]
    rows = test.sensing if is_sparse(test.sensing) else np.asarray(test.sensing)
    found = []
    for i in range(test.s):
        row = rows[[i]]
        row = row.toarray()[0] if is_sparse(row) else row[0]
        dofs = np.flatnonzero(row)
        found.append((dofs, row[dofs]))
    return found


def _is_node_label(labels: tuple[str, ...], dof: int) -> bool:
    return _NODE_LABEL.fullmatch(labels[dof]) is not None


def _label(labels: tuple[str, ...], dof: int) -> str:
    """The label of a structure's degree of freedom, else its number: other labels may look like numbers."""
    return labels[dof] if _is_node_label(labels, dof) else str(dof + 1)


def _plain(labels: tuple[str, ...], dofs: np.ndarray, weights: np.ndarray) -> str:
    """How a sensor that reads one degree of freedom, perhaps backwards, stands in `dofs`; else empty."""
    if len(dofs) != 1 or abs(weights[0]) != 1:
        return ""
    label = _label(labels, dofs[0])
    return label if weights[0] > 0 else _spelled(label, weights[0]) if _is_node_label(labels, dofs[0]) else ""


def _spelled(label: str, weight: float) -> str:
    """`12TY` or `12-TY` for a sensor that reads a direction of a node as it is, or backwards; else empty."""
    return {1.0: label, -1.0: f"{label[:-2]}-{label[-2:]}"}.get(float(weight), "")


def _quoted(name: str) -> str:
    """A name that cannot be taken for a number."""
    return f'"{name}"' if re.fullmatch(r"[-+.0-9eE]+", name) else word(name)


def _grid(key: str, values: np.ndarray, comment: str) -> list[str]:
    same = values.flat[0]
    if key == "shape_sd" and (values == same).all():
        return [f"    {key}: {real(same)}"]
    return [f"    {key}:  # {comment}", *(f"      - {flow(map(maybe, row))}" for row in values)]


HELD_KEYS = ("recordings", "segments", "frf", "lines")


def measured(problem: Problem) -> bool:
    """Whether the problem has recordings or functions, used or kept from fits."""
    return bool(problem.frf or problem.recordings or problem.held_records)


class Written:
    """The `test:` of the deck that a problem was read from, as far as it names recordings and functions.

    folder: of the new deck; None: that of the old one. Raises WrittenError for data that no deck names, or that lie elsewhere.
    """

    def __init__(self, problem: Problem, folder: str | None = None):
        self.problem, self.folder, self.test = problem, folder, {}
        if not measured(problem):
            return
        if problem.source.format == "yaml" and problem.source.lines:
            _, root = compose("\n".join(problem.source.lines), problem.source.path)
            self.test = yaml_values.keys_of(yaml_values.keys_of(root).get("test"))
        if not ("frf" in self.test or "recordings" in self.test):
            message = "the measured data of the problem were read from no deck; a deck can only name their files"
            raise WrittenError.of("MD616", message, help="write them with `mouse spectra`, and name the file")

    def lines(self) -> list[str]:
        """The lines of `frf:` and `recordings:`."""
        found = []
        for key in ("frf", "recordings"):
            if key in self.test:
                found += [f"  {key}:", *(f"    - {self._rendered(item)}" for item in self.test[key].value)]
        return found

    def sensors(self, known: set[str]) -> list[str]:
        """Definitions of sensors whose names are not `known`."""
        node = self.test.get("sensors")
        found = [] if node is None else [(yaml_values.keys_of(item), item) for item in node.value]
        return [self._rendered(item) for keys, item in found if keys["name"].value not in known]

    def held(self) -> list[str]:
        """Lines of `hold_out:` that concern them."""
        keys = yaml_values.keys_of(self.test.get("hold_out"))
        return [
            f"    {key}: {self._rendered(keys[key], 4)}" for key in HELD_KEYS if key in keys and not is_null(keys[key])
        ]

    def _rendered(self, node: Node, indent: int = 6, key: str = "") -> str:
        """A value on one line, or on several where it is a long list."""
        if yaml_values.is_mapping(node):
            items = [f"{_scalar(k)}: {self._rendered(v, indent, k.value)}" for k, v in node.value if not is_null(v)]
            return f"{{{', '.join(items)}}}"
        if yaml_values.is_list(node):
            return wrapped([self._rendered(item, indent) for item in node.value], indent)
        return word(self._moved(node.value)) if key == "file" else _scalar(node)

    def _moved(self, name: str) -> str:
        """The name of a file as the new deck must give it."""
        old = os.path.dirname(os.path.abspath(self.problem.source.path))
        if self.folder is None or os.path.realpath(self.folder or ".") == os.path.realpath(old):
            return name
        new = os.path.relpath(os.path.join(old, name), self.folder or ".")
        if new.startswith(".."):
            message = f"the deck names '{name}', which would not be below the folder of the new deck"
            help = f"write the deck to {os.path.relpath(old)}, where its recordings are, or copy them first"
            raise WrittenError.of("MD617", message, help=help)
        return new


def _scalar(node: Node) -> str:
    """A number as it was written, anything else as a word."""
    number = node.tag == PLAIN and yaml_values.as_number(node) is not None
    return node.value if number else word(node.value)
