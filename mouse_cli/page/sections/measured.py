"""What was measured: modes that were identified, pairs of modes, and frequency response functions."""

from collections.abc import Iterator
from math import nan

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.matrix import matrix
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed, shares
from mouse_cli.page.svg import svg, tenth
from mouse_cli.page.tables import Cell, Listing, columns_of, table
from mouse_cli.report.reading import Part

_WIDTH, _HEIGHT, _LEFT, _BOTTOM = 400.0, 220.0, 30.0, 196.0
_MOST = 2000  # poles that are drawn


_IDENTIFIED = columns_of(
    "mode: number name | frequency, Hz: frequency_hz | sd: frequency_sd_hz 2 | damping: damping share | "
    "sd: damping_sd share | MPC: mpc 3"
)
_REJECTED = columns_of("frequency, Hz: frequency_hz | damping: damping share | why it is no mode: reason text")


def identification_figures(document: Part) -> Iterator[Markup]:
    """The stabilisation diagram, and what is doubtful."""
    yield _diagram(document, [x for m in document.parts("modes") if (x := m.number("frequency_hz")) is not None])
    yield listed(document.texts("doubts"))


def identification_tables(document: Part) -> Iterator[Listing]:
    """Modes with their standard deviations, and poles that are no modes."""
    modes = [
        Part({**mode.values, "number": i}, mode.file, mode.place) for i, mode in enumerate(document.parts("modes"), 1)
    ]
    yield Listing("identified", "Modes", _IDENTIFIED, modes)
    yield Listing("rejected", "Poles that are no modes", _REJECTED, document.parts("rejected"))


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


_PAIRS = columns_of(
    "mode: mode name | model mode: model_mode name | test, Hz: test_hz | sd of test: test_sd_hz 3 | model, Hz: model_hz | "
    "off: difference_percent percent | off, in sd: difference_sd 3 | MAC: mac 4 | scale factor: scale_factor 4"
)
_SENSORS = columns_of("sensor: name name | COMAC: comac | eCOMAC: ecomac")
_WORST = 10  # sensors in the figure
_FAULTS = {
    "reversed": "of reversed polarity",
    "swapped": "exchanged",
    "gain": "of a wrong gain",
    "strange": "unlike the model",
}


def correlation_figures(document: Part) -> Iterator[Markup]:
    """MAC of the pairs beside the worst COMAC, and faults of sensors."""
    modes = document.parts("modes")
    compared = [m for m in modes if m.number("mac") is not None]
    if compared:
        yield tag("div", _matrix(document, modes, compared), _worst(document.parts("sensors")), class_="beside")
    yield listed([_fault(each) for each in document.parts("sensor_faults")])


def correlation_tables(document: Part) -> Iterator[Listing]:
    """Mode pairs and sensors."""
    yield Listing("pairs", "Mode pairs", _PAIRS, document.parts("modes"))
    yield Listing("sensors", "Sensors", _SENSORS, document.parts("sensors"))


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


SECTION = PageSection("functions", 65, "Frequency response functions", functions)
