"""Documents as tables with names: one for each list of objects, each set of parallel lists, each matrix; the rest is one row."""

from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass, field
from typing import Any

SUMMARY = "summary"  # name of the table of one row
# Lists in objects that become columns of their own
_OF_PARAMETERS, _OF_DOFS = ("theta",), ("shape", "shape_sd", "test")
_KEPT = ("ids", "position")  # lists that stay what they are: of a place
_BY_PARAMETERS, _BY_MODES = ("covariance", "prior_covariance"), ("covariance_hz2", "auto_mac_test")  # square matrices


@dataclass
class Table:
    """Columns of equal length by name; index: names of the rows where they are those of a matrix."""

    columns: dict[Any, list[Any]] = field(default_factory=dict)
    index: list[Any] | None = None

    def append(self, row: dict[str, Any]) -> None:
        """One row more; what it lacks, or what earlier ones lacked, is None."""
        length = len(next(iter(self.columns.values()), ()))
        for name in row:
            self.columns.setdefault(name, [None] * length)
        for name, column in self.columns.items():
            column.append(row.get(name))


def tables(document: dict[str, Any]) -> dict[str, Table]:
    """All tables of a document, by the path of what they hold, such as `location.places`; SUMMARY first.

    A list of objects has one row an object; what an object holds of objects has the columns `site.text`, and a list of
    objects in it is a table of its own, whose first column is the number of the row above, from 0.
    """
    labels = _Labels(document)
    summary: dict[str, Any] = {}
    found: dict[str, Table] = {SUMMARY: Table()}
    _collect("", document, labels, found, summary)
    found[SUMMARY].append(summary)
    return found


class _Labels:
    """Names of parameters, modes and degrees of freedom of a document."""

    def __init__(self, document: dict[str, Any]):
        self.parameters = [each.get("name") for each in _objects(document.get("parameters"))]
        self.modes = [each.get("mode") for each in _objects(document.get("modes"))]
        self.dofs = document.get("dofs") or []

    def within(self, part: dict[str, Any]) -> "_Labels":
        """The same in a part that may have degrees of freedom of its own."""
        if not isinstance(part.get("dofs"), list):
            return self
        found = copy(self)
        found.dofs = part["dofs"]
        return found

    def of_list(self, key: str, length: int) -> list[Any] | None:
        """Names for the entries of a list in an object; None where it stays a list."""
        names = self.parameters if key in _OF_PARAMETERS else self.dofs if key in _OF_DOFS else []
        return names if names and len(names) == length else None

    def of_square(self, key: str, length: int) -> list[Any]:
        """Names for the rows and columns of a square matrix."""
        names = self.parameters if key in _BY_PARAMETERS else self.modes if key in _BY_MODES else []
        return names if len(names) == length else list(range(length))


def _objects(value: Any) -> list[dict[str, Any]]:
    """The entries of a list of objects; none of anything else."""
    return value if isinstance(value, list) and value and all(isinstance(each, dict) for each in value) else []


def _collect(
    path: str, part: dict[str, Any], labels: _Labels, found: dict[str, Table], summary: dict[str, Any]
) -> None:
    """The tables of an object that is no entry of a list; what is single goes to the summary."""
    labels = labels.within(part)
    for key, value in part.items():
        name = f"{path}.{key}".lstrip(".")
        if isinstance(value, dict):
            _collect(name, value, labels, found, summary)
        elif not isinstance(value, list) or key in _KEPT:
            summary[name] = value
        elif _objects(value):
            _rows(name, value, {}, labels, found)
        elif value and all(isinstance(row, list) for row in value) and any(value):
            found[name] = _matrix(key, value, labels)
        elif value:
            table = found.get(path)
            fits = table is not None and table.index is None and len(next(iter(table.columns.values()))) == len(value)
            found.setdefault(path if path and (table is None or fits) else name, Table()).columns[key] = value


def _rows(
    name: str, entries: list[dict[str, Any]], above: dict[str, int], labels: _Labels, found: dict[str, Table]
) -> None:
    """The entries of a list of objects as rows, and lists of objects in them as tables of their own."""
    table = found.setdefault(name, Table())
    for entry in entries:
        number = len(next(iter(table.columns.values()), ()))
        table.append({**above, **dict(_cells("", entry, labels))})
        for key, below in _lists("", entry):
            _rows(f"{name}.{key}", below, {name.rpartition(".")[2]: number}, labels, found)
    for key in {key for entry in entries for key, _ in _lists("", entry)}:
        table.columns.pop(key, None)  # of entries that have none of them


def _cells(path: str, entry: dict[str, Any], labels: _Labels) -> Iterator[tuple[str, Any]]:
    """Columns and values of a row."""
    for key, value in entry.items():
        name = f"{path}.{key}".lstrip(".")
        if isinstance(value, dict):
            yield from _cells(name, value, labels)
        elif isinstance(value, list) and (names := labels.of_list(key, len(value))):
            yield from ((f"{name}.{each}", one) for each, one in zip(names, value, strict=True))
        elif not _objects(value):
            yield name, value


def _lists(path: str, entry: dict[str, Any]) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """Lists of objects within an object."""
    for key, value in entry.items():
        name = f"{path}.{key}".lstrip(".")
        if isinstance(value, dict):
            yield from _lists(name, value)
        elif _objects(value):
            yield name, value


def _matrix(key: str, rows: list[list[Any]], labels: _Labels) -> Table:
    width = max(len(row) for row in rows)
    square = width == len(rows)
    names = labels.of_square(key, width) if square else list(range(width))
    columns = {name: [row[i] if i < len(row) else None for row in rows] for i, name in enumerate(names)}
    return Table(columns, list(names) if square else list(range(len(rows))))
