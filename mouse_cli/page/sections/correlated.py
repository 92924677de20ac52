"""Test beside model before any update: pairs of modes, their MAC, and sensors that fit badly."""

from collections.abc import Iterator
from math import nan

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.matrix import matrix
from mouse_cli.page.numbers import shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed, shares
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_PAIRS = ("mode", "model mode", "test, Hz", "sd of test", "model, Hz", "off", "off, in sd", "MAC", "scale factor")
_SENSORS = ("sensor", "COMAC", "eCOMAC")
_WORST = 10  # sensors in the figure
_FAULTS = {
    "reversed": "of reversed polarity",
    "swapped": "exchanged",
    "gain": "of a wrong gain",
    "strange": "unlike the model",
}


def correlated(document: Part) -> Iterator[Markup]:
    """MAC of the pairs, their table, and the COMAC of sensors."""
    if document.text("schema") != "mouse.correlation/1":
        return
    modes, sensors = document.parts("modes"), document.parts("sensors")
    compared = [m for m in modes if m.number("mac") is not None]
    if compared:
        yield tag("div", _matrix(document, modes, compared), _worst(sensors), class_="beside")
    yield listed([_fault(each) for each in document.parts("sensor_faults")])
    yield table("pairs", "Mode pairs", _PAIRS, map(_row, modes))
    if sensors:
        rows = ((s.text("name"), s.number("comac"), s.number("ecomac")) for s in sensors)
        yield tag("details", tag("summary", "All sensors"), table("sensors", "Sensors", _SENSORS, rows))


def _worst(sensors: list[Part]) -> Markup:
    """COMAC of the sensors that agree least."""
    known = sorted((x, s.text("name")) for s in sensors if (x := s.number("comac")) is not None)[:_WORST]
    rows = [(name, shown(x, 3), x) for x, name in known]
    return shares("comac", "COMAC of sensors, the worst first", f"{len(rows)} of {len(sensors)} sensors. ", rows)


def _matrix(document: Part, modes: list[Part], compared: list[Part]) -> Markup:
    """Each measured mode that has a partner against all partners."""
    rows = dict(zip((m.label("mode") for m in modes), document.rows("mac"), strict=False))
    columns = [int(m.number("model_mode") or 1) - 1 for m in compared]
    names = [m.label("mode") for m in compared]
    values = [[nan if (x := rows[name][j]) is None else x for j in columns] for name in names]
    told = "Rows: measured modes; columns: their partners in the model, in the same order."
    return matrix("mac", "MAC of mode pairs", told, names, values)


def _row(mode: Part) -> tuple[object, ...]:
    off = mode.number("difference_percent")
    return (
        Cell(mode.number("mode"), mode.label("mode")),
        Cell(mode.number("model_mode"), mode.label("model_mode") or "none"),
        mode.number("test_hz"),
        Cell(mode.number("test_sd_hz"), shown(mode.number("test_sd_hz"), 3)),
        mode.number("model_hz"),
        Cell(off, signed_per_cent(off)),
        Cell(mode.number("difference_sd"), shown(mode.number("difference_sd"), 3)),
        Cell(mode.number("mac"), shown(mode.number("mac"), 4)),
        Cell(mode.number("scale_factor"), shown(mode.number("scale_factor"), 4)),
    )


def _fault(fault: Part) -> str:
    """One sensor, or two that are exchanged, with the mean MAC before and after the repair."""
    what = _FAULTS.get(fault.text("kind"), fault.text("kind"))
    before, after = shown(fault.number("mac_before"), 3), shown(fault.number("mac_after"), 3)
    return f"{', '.join(fault.labels('sensors'))}: {what}; mean MAC {before}, and {after} without the fault"


SECTION = PageSection("correlation", 35, "Test and model", correlated, folded=False)
