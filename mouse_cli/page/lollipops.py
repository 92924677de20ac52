"""Mode shapes of models without positions: components over the degrees of freedom, test beside model."""

from collections.abc import Iterator
from dataclasses import dataclass

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.marks import named
from mouse_cli.page.numbers import padded, shown
from mouse_cli.page.sections._words import drawn_model, listed, paragraphs
from mouse_cli.page.svg import figure, tenth
from mouse_cli.report.reading import Part

_WIDTH, _HEIGHT, _LEFT, _TOP = 300.0, 150.0, 16.0, 12.0
_MOST, _MOST_DOFS, _NAMED = 12, 140, 12  # modes that are drawn; degrees of freedom of them; up to so many are named


@dataclass(frozen=True)
class Stems:
    """One mode: components of model and test over dofs, None where unknown; largest of the model 1."""

    title: str
    dofs: list[str]
    model: list[float | None]
    test: list[float | None]


def lollipops(document: Part) -> Iterator[Markup]:
    """One small figure a mode."""
    found = _whole(document) or _measured(document)
    places = {
        i for one in named(document) if one.strong and one.site.text("kind") == "dof" for i in one.site.labels("ids")
    }
    drawn = [_figure(one, places, number) for number, one in enumerate(found[:_MOST], 1)]
    if drawn:
        ring = " The ring is the located site." if places & set(found[0].dofs) else ""
        test = ", squares of the test" if any(x is not None for one in found for x in one.test) else ""
        yield paragraphs(f"Components over the degrees of freedom: dots of {drawn_model(document)}{test}.{ring}")
        yield listed([one.words for one in named(document) if one.strong])
        yield tag("div", *drawn, class_="gallery")


def _whole(document: Part) -> list[Stems]:
    """The full shapes of a small model."""
    part = document if document.text("schema") == "mouse.modes/1" else document.part("shapes_by_dof")
    dofs = part.labels("dofs")
    if len(dofs) > _MOST_DOFS:
        return []
    return [
        Stems(_title(m), dofs, padded(m.numbers("shape"), len(dofs)), padded(m.numbers("test"), len(dofs)))
        for m in part.parts("modes")[:_MOST]
    ]


def _measured(document: Part) -> list[Stems]:
    """Measured components where there is no more; largest 1."""
    if not document.parts("shapes"):
        return []
    modes = {m.label("mode"): m for m in document.parts("modes")}
    found: dict[str, list[Part]] = {}
    for component in document.parts("shapes"):
        found.setdefault(component.label("mode"), []).append(component)
    drawn = []
    for mode, parts in found.items():
        parts = parts[:_MOST_DOFS]
        model, test = ([p.number(key) for p in parts] for key in ("revised", "test"))
        size = max((abs(x) for x in model if x is not None), default=0.0) or 1.0
        scaled = [[None if x is None else x / size for x in values] for values in (model, test)]
        drawn.append(Stems(_title(modes.get(mode, parts[0])), [p.label("dof") for p in parts], *scaled))
    return drawn


def _title(mode: Part) -> str:
    hz = mode.number("hz" if "hz" in mode.values else "revised_hz")
    return f"Mode {mode.label('mode')}" + ("" if hz is None else f", {shown(hz, 4)} Hz")


def _figure(one: Stems, places: set[str], number: int) -> Markup:
    key, count = f"mode-{number}", len(one.dofs)
    values = [abs(x) for x in (*one.model, *one.test) if x is not None]
    scale = (_HEIGHT / 2 - 2 * _TOP) / max(values, default=1.0) if values and max(values) > 0 else 1.0
    across = [_LEFT + (_WIDTH - 2 * _LEFT) * (i + 0.5) / max(count, 1) for i in range(count)]
    pieces = [tag("line", x1=_LEFT, x2=_WIDTH - _LEFT, y1=_HEIGHT / 2, y2=_HEIGHT / 2, class_="axis")]
    for x, name, model, test in zip(across, one.dofs, one.model, one.test, strict=True):
        pieces += _stem(x, model, test, scale, name in places)
        if count <= _NAMED:
            pieces.append(tag("text", name[:6], x=tenth(x), y=_HEIGHT - 2, text_anchor="middle"))
    description = "; ".join(
        f"{name}: {shown(m, 3)}, test {shown(t, 3)}" for name, m, t in zip(one.dofs, one.model, one.test, strict=True)
    )
    return figure(key, one.title, f"Model and test. {description}.", (_WIDTH, _HEIGHT), *pieces)


def _stem(x: float, model: float | None, test: float | None, scale: float, marked: bool) -> list[Markup]:
    zero, found = _HEIGHT / 2, []
    if model is not None:
        y = zero - scale * model
        found.append(tag("line", x1=tenth(x), x2=tenth(x), y1=tenth(zero), y2=tenth(y), class_="stem"))
        found.append(tag("circle", cx=tenth(x), cy=tenth(y), r=3, class_="after"))
    if test is not None:
        found.append(
            tag("rect", x=tenth(x - 4.5), y=tenth(zero - scale * test - 4.5), width=9, height=9, class_="test")
        )
    if marked:
        found.append(tag("circle", cx=tenth(x), cy=tenth(zero), r=8, class_="ring"))
    return found
