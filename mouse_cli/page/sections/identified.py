"""Modes that were identified: their table with standard deviations, and the stabilisation diagram."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import listed
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_MODES = ("mode", "frequency, Hz", "sd", "damping, %", "sd", "MPC")
_REJECTED = ("frequency, Hz", "damping, %", "why it is no mode")
_WIDTH, _HEIGHT, _LEFT, _BOTTOM = 400.0, 220.0, 30.0, 196.0
_MOST = 2000  # poles that are drawn


def identified(document: Part) -> Iterator[Markup]:
    """The diagram, the modes, poles that are none."""
    if document.text("schema") != "mouse.identification/1":
        return
    modes = document.parts("modes")
    yield _diagram(document, [x for m in modes if (x := m.number("frequency_hz")) is not None])
    yield table("identified", "Modes", _MODES, (_row(i, m) for i, m in enumerate(modes, 1)))
    yield listed(document.texts("doubts"))
    yield table("rejected", "Poles that are no modes", _REJECTED, map(_rejected, document.parts("rejected")))


def _row(number: int, mode: Part) -> tuple[object, ...]:
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
    lines = [tag("line", x1=_at(across(hz)), x2=_at(across(hz)), y1=8, y2=_BOTTOM, class_="axis") for hz in modes]
    marks = [
        tag(
            "circle",
            cx=_at(across(hz)),
            cy=_at(up(order)),
            r=2.5 if stable else 1.5,
            class_="after" if stable else "before",
        )
        for hz, order, stable in inside
    ]
    words = [
        tag("text", shown(band[0], 4), x=_LEFT, y=_BOTTOM + 16),
        tag("text", f"{shown(band[1], 4)} Hz", x=_WIDTH - 8, y=_BOTTOM + 16, text_anchor="end"),
        tag("text", f"{highest:.0f}", x=_LEFT - 4, y=20, text_anchor="end"),
    ]
    told = f"{sum(s for *_, s in inside)} of {len(inside)} poles are stable; lines at the {len(modes)} modes of the answer."
    head = [tag("title", "Stabilisation diagram", id="stable-title"), tag("desc", told, id="stable-told")]
    size = {"viewBox": f"0 0 {_WIDTH:g} {_HEIGHT:g}"}
    svg = tag("svg", *head, *lines, *marks, *words, role="img", aria_labelledby="stable-title stable-told", **size)
    return tag("figure", tag("figcaption", "Stabilisation diagram: model order over frequency"), svg, tag("p", told))


def _at(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")


SECTION = PageSection("identification", 35, "Modes", identified, folded=False)
