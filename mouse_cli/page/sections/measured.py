"""What was measured: modes that were identified, pairs of modes, and frequency response functions."""

from collections.abc import Iterator
from math import nan

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.matrix import matrix
from mouse_cli.page.numbers import shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed, shares
from mouse_cli.page.svg import svg, tenth
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_MODES = ("mode", "frequency, Hz", "sd", "damping, %", "sd", "MPC")
_REJECTED = ("frequency, Hz", "damping, %", "why it is no mode")
_WIDTH, _HEIGHT, _LEFT, _BOTTOM = 400.0, 220.0, 30.0, 196.0
_MOST = 2000  # poles that are drawn


def identified(document: Part) -> Iterator[Markup]:
    """Modes that were identified: their table with standard deviations, and the stabilisation diagram."""
    if document.text("schema") != "mouse.identification/1":
        return
    modes = document.parts("modes")
    yield _diagram(document, [x for m in modes if (x := m.number("frequency_hz")) is not None])
    yield table("identified", "Modes", _MODES, (_identified_row(i, m) for i, m in enumerate(modes, 1)))
    yield listed(document.texts("doubts"))
    yield table("rejected", "Poles that are no modes", _REJECTED, map(_rejected, document.parts("rejected")))


def _identified_row(number: int, mode: Part) -> tuple[object, ...]:
    damping, sd = mode.number("damping"), mode.number("damping_sd")
    return (
        Cell(float(number), str(number)),
        mode.number("frequency_hz"),
        Cell(mode.number("frequency_sd_hz"), shown(mode.number("frequency_sd_hz"), 2)),
        Cell(damping, "–" if damping is None else shown(100 * damping, 3)),
        Cell(sd, "–" if sd is None else shown(100 * sd, 2)),
        Cell(mode.number("mpc"), shown(mode.number("mpc"), 3)),
    )


def _rejected(pole: Part) -> tuple[object, ...]:
    damping = pole.number("damping")
    return pole.number("frequency_hz"), "–" if damping is None else shown(100 * damping, 3), pole.text("reason")


def _diagram(document: Part, modes: list[float]) -> Markup:
    """Poles by frequency and model order, stable ones filled; a line at each mode of the answer."""
    part = document.part("diagram")
    kinds = part.values.get("stable") or []
    poles = [
        (hz, order, bool(stable))
        for hz, order, stable in zip(part.numbers("frequency_hz"), part.numbers("order"), kinds, strict=False)
        if hz is not None and order is not None
    ]
    band = [x for x in document.numbers("band_hz") if x is not None]
    if not poles or len(band) < 2 or not band[1] > band[0]:
        return Markup("")
    highest = max(order for _, order, _ in poles)
    across = lambda hz: _LEFT + (_WIDTH - _LEFT - 8) * (hz - band[0]) / (band[1] - band[0])
    up = lambda order: _BOTTOM - (_BOTTOM - 12) * order / highest
    inside = [(hz, order, stable) for hz, order, stable in poles if band[0] <= hz <= band[1]][:_MOST]
    lines = [tag("line", x1=tenth(across(hz)), x2=tenth(across(hz)), y1=8, y2=_BOTTOM, class_="axis") for hz in modes]
    looks = {True: {"r": 2.5, "class_": "after"}, False: {"r": 1.5, "class_": "before"}}
    marks = [
        tag("circle", cx=tenth(across(hz)), cy=tenth(up(order)), **looks[bool(stable)]) for hz, order, stable in inside
    ]
    words = [
        tag("text", shown(band[0], 4), x=_LEFT, y=_BOTTOM + 16),
        tag("text", f"{shown(band[1], 4)} Hz", x=_WIDTH - 8, y=_BOTTOM + 16, text_anchor="end"),
        tag("text", f"{highest:.0f}", x=_LEFT - 4, y=20, text_anchor="end"),
    ]
    description = f"{sum(s for *_, s in inside)} of {len(inside)} poles are stable; lines at the {len(modes)} modes of the answer."
    drawn = svg("stable", "Stabilisation diagram", description, (_WIDTH, _HEIGHT), *lines, *marks, *words)
    return tag(
        "figure", tag("figcaption", "Stabilisation diagram: model order over frequency"), drawn, tag("p", description)
    )


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
    yield table("pairs", "Mode pairs", _PAIRS, map(_correlated_row, modes))
    if sensors:
        rows = ((s.label("name"), s.number("comac"), s.number("ecomac")) for s in sensors)
        yield tag("details", tag("summary", "All sensors"), table("sensors", "Sensors", _SENSORS, rows))


def _worst(sensors: list[Part]) -> Markup:
    """COMAC of the sensors that agree least."""
    known = sorted((x, s.label("name")) for s in sensors if (x := s.number("comac")) is not None)[:_WORST]
    rows = [(name, shown(x, 3), x) for x, name in known]
    return shares("comac", "COMAC of sensors, the worst first", f"{len(rows)} of {len(sensors)} sensors. ", rows)


def _matrix(document: Part, modes: list[Part], compared: list[Part]) -> Markup:
    """Each measured mode that has a partner against all partners."""
    rows = dict(zip((m.label("mode") for m in modes), document.rows("mac"), strict=False))
    columns = [int(m.number("model_mode") or 1) - 1 for m in compared]
    names = [m.label("mode") for m in compared]
    values = [[nan if (x := rows[name][j]) is None else x for j in columns] for name in names]
    description = "Rows: measured modes; columns: their partners in the model, in the same order."
    return matrix("mac", "MAC of mode pairs", description, names, values)


def _correlated_row(mode: Part) -> tuple[object, ...]:
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


_HEADS = ("function", "lines", "before, dB", "after, dB", "FRAC before", "FRAC after")

_DEEP = 120.0  # dB below the highest value: more would flatten all else


def functions(document: Part) -> Iterator[Markup]:
    """Curves of the functions that are missed most, then a table for each measurement."""
    for key, kind in (("frf", "fitted"), ("held_out_frf", "held out")):
        for number, each in enumerate(document.parts(key), 1):
            rows = [_functions_row(function) for function in each.parts("functions")]
            title = f"{each.text('title') or each.text('kind')}, {kind}, measurement {number}"
            drawn = [(name, f"{cell.words} dB", cell.value) for name, _, _, cell, *_ in rows]
            slug = f"{key}-{number}".replace("_", "-")
            for order, pair in enumerate(each.parts("curves"), 1):
                yield _curves(f"{slug}-curve-{order}", pair, each.text("kind"), kind)
            yield shares(f"{slug}-error", f"Median error of magnitudes after: {title}", "In dB.", drawn)
            yield table(slug, f"Median error of magnitudes: {title}", _HEADS, rows)


def _curves(slug: str, pair: Part, kind: str, which: str) -> Markup:
    """Measured, before and after, over frequency."""
    drawn = [
        Line(name, looks, pair.vectors(key, 2))
        for key, name, looks in (
            ("measured", "measured", "measured"),
            ("prior", "before", "prior"),
            ("baseline", "as it is", "prior"),
            ("revised", "after", "revised"),
        )
    ]
    title = f"{kind.capitalize()} {pair.label('output')} by {pair.label('input')}, {which}"
    description = f"Magnitudes of {' and '.join(line.name for line in drawn if line.points)} over frequency."
    return lines(slug, title, description, "frequency, Hz", "dB", drawn, _DEEP)


def _functions_row(function: Part) -> tuple[object, ...]:
    before = "baseline" if "baseline_median_db" in function.values else "prior"
    keys = (f"{before}_median_db", "revised_median_db", f"{before}_frac", "revised_frac")
    cells = [Cell(function.number(key), shown(function.number(key), 3)) for key in keys]
    return (f"{function.label('output')} by {function.label('input')}", function.number("lines"), *cells)


SECTIONS = (
    PageSection("identification", 35, "Modes", identified, folded=False),
    PageSection("correlation", 35, "Test and model", correlated, folded=False),
    PageSection("functions", 65, "Frequency response functions", functions),
)
