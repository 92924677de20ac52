"""The `test:` of a YAML deck: natural frequencies, mode shapes and their accuracies."""

import warnings

import numpy as np

from mouse_cli.formats import matrix_files
from mouse_cli.formats.draft import TestDraft, nowhere
from mouse_cli.formats.mode_files import ModeTable
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.files import named, read_kept
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.modes_file import chosen, mounted, of_file, own_sensors
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.sensors import listed, sensors
from mouse_cli.model.units import UNDECLARED, Units


class Grid:
    """Values (s, m) and their places."""

    def __init__(self, values: np.ndarray, where=lambda s, m: None):
        self.values, self.where = values, where


def modal_test(section: Section | None, units: Units = UNDECLARED) -> TestDraft | None:
    """The measured modes; units: of the deck. None when there are none, or after an error that leaves no list of frequencies."""
    if section is None:
        return None
    before, section.document.incomplete = section.document.incomplete, False  # gaps elsewhere are no gaps of the test
    try:
        return _measured(section, units)
    finally:
        section.document.incomplete |= before


def _measured(section: Section, units: Units) -> TestDraft | None:
    named, modes = sensors(section), section.section("modes")
    held = of_file(modes, units) if modes and "file" in modes else None
    frequency = held.frequency_hz if held else modes.value("frequency") if modes else None
    if frequency is None:
        return None
    m, nodes, scale = len(frequency), modes.nodes, modes.value("scale", "fitted")
    if not held and _with_decimal_commas(modes, frequency):
        return None
    if not m:
        return modes.document.error(
            "MD216", nodes["frequency"], f"{modes.what('frequency')} is empty", "give a frequency"
        )
    stated = held is not None and held.frequency_sd_hz is not None and "frequency_sd" not in modes
    sd = held.frequency_sd_hz if stated else frequency_sd(modes, frequency)
    number = modes.value("number", np.arange(1, m + 1))
    dofs = listed(modes.document, nodes["dofs"], modes.what("dofs"), named) if "dofs" in modes else named or None
    if held:
        dofs = own_sensors(modes, held) if dofs is None else mounted(modes, held, dofs)
    matching(modes, "number", len(number), m)
    shapes, shape_sd = _of_file(modes, held, dofs) if held else _shapes(modes, dofs, m)
    if modes.document.incomplete:
        return None
    where = modes.document.where
    return TestDraft(
        number,
        frequency,
        sd,
        np.zeros(len(dofs or ()), int),
        shapes.values,
        shape_sd.values,
        scale,
        where(nodes["number"].value) if "number" in modes else _where_each(modes, "frequency"),
        _where_each(modes, "frequency"),
        _where_each(modes, "frequency_sd"),
        _where_each(modes, "dofs"),
        shapes.where,
        shape_sd.where,
        tuple(dofs or ()),
    )


def _with_decimal_commas(modes: Section, frequency: np.ndarray) -> bool:
    """Whether the frequencies do not ascend because of a decimal comma; says so."""
    node = modes.nodes["frequency"]
    comma = yaml_values.decimal_comma(node)
    if not comma or not (np.diff(frequency[np.isfinite(frequency)]) < 0).any():
        return False
    modes.wrong("frequency", "MD228", f"has {len(frequency)} values that do not ascend", comma)
    return True


def _of_file(modes: Section, held: ModeTable, dofs: list[SensorDraft]) -> tuple[Grid, Grid]:
    """Shapes of a file at the sensors `dofs`, and their standard deviations."""
    rows = chosen(modes, held, dofs)
    if rows is None:
        return Grid(np.zeros((0, len(held.frequency_hz)))), Grid(np.zeros((0, len(held.frequency_hz))))
    span = modes.document.span(modes.nodes["file"])
    rows, stated = rows
    if stated is not None and "shape_sd" not in modes:
        return Grid(rows, lambda s, m: span), Grid(stated, lambda s, m: span)
    if not len(rows):
        return Grid(rows), Grid(rows)
    return Grid(rows, lambda s, m: span), _shape_sd(modes, rows) or Grid(np.full(rows.shape, np.nan))


def _where_each(modes: Section, key: str):
    """Places of the values of a list; of a single value for all, its place."""
    node = modes.nodes.get(key)
    if node is None:
        return nowhere
    return modes.document.where(node.value) if yaml_values.is_list(node) else lambda _: modes.document.span(node)


def matching(modes: Section, key: str, count: int, m: int) -> bool:
    """Whether a list has one value for each mode; says so where not."""
    if count != m:
        message = f"{modes.what(key)} has {count} values; {modes.what('frequency')} has {m}"
        modes.document.error("MD216", modes.nodes[key], message, f"give one value for each of the {m} modes")
    return count == m


def frequency_sd(modes: Section, frequency: np.ndarray) -> np.ndarray:
    """Standard deviations (m,) by the key frequency_sd, NaN where no frequency was measured and one value serves all."""
    node, document = modes.nodes.get("frequency_sd"), modes.document
    nothing = np.full(len(frequency), np.nan)
    if node is None:
        if not np.isnan(frequency).all():
            message = f"{modes.called} has no frequency_sd"
            document.error(
                "MD211",
                modes.nodes.get("frequency", modes.node),
                message,
                "give frequency_sd: a number in Hz, or a percentage",
            )
        return nothing
    what, words = modes.what("frequency_sd"), KINDS["sds"].words
    if not yaml_values.is_scalar(node):
        values = yaml_values.numbers(document, node, what, words, missing=True)
        if values is None or not matching(modes, "frequency_sd", len(values), len(frequency)):
            return nothing
        return values
    percent = yaml_values.as_percent(node)
    if percent is not None:
        return percent * frequency / 100
    value = yaml_values.number(document, node, what, words)
    return nothing if value is None else np.where(np.isnan(frequency), np.nan, value)


def _shapes(modes: Section, dofs: list[SensorDraft] | None, m: int) -> tuple[Grid, Grid]:
    """Shapes and their standard deviations; without dofs none are possible."""
    nothing = Grid(np.zeros((0, m)))
    if dofs is None:
        for key in {"shapes", "shape_sd"} & set(modes.nodes):
            if "dofs" not in modes:
                message = f"{modes.called} gives {key}, but no dofs"
                modes.document.error("MD211", modes.nodes[key], message, "give dofs: where the shapes were measured")
        return nothing, nothing
    if len(dofs) and "shapes" not in modes:
        what = "dofs" if "dofs" in modes else "sensors"
        message, place = f"{modes.called} gives {what}, but no shapes", modes.nodes.get("dofs", modes.node)
        modes.document.error("MD211", place, message, f"give shapes: one row for each of {what}; or delete {what}")
    if not len(dofs) or "shapes" not in modes:
        return nothing, nothing
    shapes = _grid(modes, "shapes", len(dofs), m)
    if shapes is None:
        return nothing, nothing
    return shapes, _shape_sd(modes, shapes.values) or nothing


def _shape_sd(modes: Section, shapes: np.ndarray) -> Grid | None:
    node, document = modes.nodes.get("shape_sd"), modes.document
    if node is None:
        message = f"{modes.called} has no shape_sd"
        return document.error(
            "MD211", modes.nodes.get("shapes", modes.node), message, "give shape_sd: a number, a percentage, or rows"
        )
    if not yaml_values.is_scalar(node):
        return _grid(modes, "shape_sd", *shapes.shape)
    percent = yaml_values.as_percent(node)
    value = percent
    if percent is None:
        value = yaml_values.number(document, node, modes.what("shape_sd"), KINDS["sd grid"].words)
    if value is None:
        return None
    each = np.full(shapes.shape, value) if percent is None else percent * _largest(shapes) / 100
    return Grid(np.where(np.isnan(shapes), np.nan, each), lambda s, m: document.span(node))


def _largest(shapes: np.ndarray) -> np.ndarray:
    """Largest component of each mode (1, m); NaN for a mode without any."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # a mode of which only the frequency was measured
        return np.nanmax(np.abs(shapes), axis=0, keepdims=True)


def _grid(modes: Section, key: str, s: int, m: int) -> Grid | None:
    """Rows inline or from a file, as (s, m)."""
    document, node, what = modes.document, modes.nodes[key], modes.what(key)
    if yaml_values.is_mapping(node):
        path = named(document, node, what)
        table = None if path is None else read_kept(document, node, what, matrix_files.read_table)
        return None if table is None else _oriented(modes, key, Grid(table, lambda i, j: document.span(path)), s, m)
    found = yaml_values.rows(document, node, what, KINDS[modes.definition.keys[key].kind].words, missing=True)
    if found is None:
        return None
    nodes, values = found
    widths = {len(row) for row in values}
    if len(widths) > 1:
        expected = m if len(nodes) == s else s if len(nodes) == m else len(values[0])
        for row, place in zip(values, nodes, strict=True):
            if len(row) != expected:
                message = f"a row of {what} has {len(row)} values; expected {expected}"
                document.error("MD216", place, message, _layout(s, m))
        return None
    where = lambda i, j: document.span(nodes[i].value[j])
    return _oriented(modes, key, Grid(np.array(values).reshape(len(nodes), -1), where), s, m)


def _oriented(modes: Section, key: str, grid: Grid, s: int, m: int) -> Grid | None:
    """The table as (s, m): one that is plainly (m, s) is turned, with a warning."""
    node, what, shape = modes.nodes[key], modes.what(key), grid.values.shape
    if shape == (s, m):
        return grid
    if shape == (m, s):
        message = f"{what} has {m} rows of {s}, one for each mode; it was turned to one for each of dofs"
        modes.document.warn("MD227", node, message, _layout(s, m))
        return Grid(grid.values.T, lambda i, j: grid.where(j, i))
    message = f"{what} has {shape[0]} rows of {shape[1]} values; expected {s} rows of {m}"
    return modes.document.error("MD216", node, message, _layout(s, m))


def _layout(s: int, m: int) -> str:
    return f"give {s} rows, one for each of dofs, of {m} values, one for each mode"
