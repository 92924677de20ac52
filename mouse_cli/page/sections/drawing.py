"""Mode shapes drawn on the structure, the located site marked; over degrees of freedom where there are no positions."""

from collections.abc import Iterator, Sequence

from mouse_cli.page.drawing import large, small, stage
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.lollipops import lollipops
from mouse_cli.page.marks import Mark, marks
from mouse_cli.page.numbers import shown
from mouse_cli.page.projection import TILT, View
from mouse_cli.page.scene import Scene, Shape, scene
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import drawn_model, listed, paragraphs
from mouse_cli.report.reading import Part

_MOST_SMALL, _MOST_LINES = 12, 20_000  # drawings in the row of all modes, and lines in all of them

_LOCATED = {"one-of": "the most probable site, which the test does not settle"}


def drawing(document: Part) -> Iterator[Markup]:
    """The large drawing with its controls, then every mode in a small one."""
    found = scene(document)
    if found is None:
        yield from lollipops(document)
        return
    marked = marks(document, found)
    title = f"Mode {_name(found.shapes[0])}" if found.shapes else "The structure"
    seen = large(found)
    drawn = stage(found, marked, seen, title, _caption(found, marked))
    caption = tag("figcaption", title, class_="now", aria_live="off")
    yield tag(
        "figure",
        caption,
        drawn,
        _controls(found, seen),
        _legend(found, marked, document),
        class_="structure",
    )
    yield from _places(marked)
    yield paragraphs(_remark(found))
    each = _MOST_LINES // max(len(found.lines), len(found.positions), 1)
    chosen = found.shapes[: min(_MOST_SMALL, each)]
    if len(found.shapes) > 1 and chosen:
        each = tag("div", *(_one(found, shape, marked, i) for i, shape in enumerate(chosen, 1)), class_="gallery")
        yield tag("details", tag("summary", f"{len(chosen)} modes side by side"), each)


def _places(marked: Sequence[Mark]) -> Iterator[Markup]:
    """Marked places in words, the answer first, by the numbers of the drawing."""
    strong, rivals = (list(dict.fromkeys(m.words for m in marked if m.strong is of)) for of in (True, False))
    yield tag("ol", *(tag("li", words) for words in strong)) if len(strong) > 1 else listed(strong)
    if rivals:
        yield tag("details", tag("summary", f"Other sites: {len(rivals)}"), listed(rivals))


def _name(shape: Shape) -> str:
    return f"{shape.mode}, {shown(shape.hz, 4)} Hz"


def _one(found: Scene, shape: Shape, marked: Sequence[Mark], number: int) -> Markup:
    title = f"Mode {_name(shape)}"
    return tag("figure", tag("figcaption", title), small(found, shape, marked, f"mode-{number}", title))


def _caption(found: Scene, marked: Sequence[Mark]) -> str:
    """The drawing in words."""
    nodes, lines = f"{found.of} nodes", f"{len(found.lines)} lines" if len(found.lines) else "no lines"
    strong = [mark.words for mark in marked if mark.strong]
    places = f" Marked: {'; '.join(strong)}." if strong else ""
    return f"The model has {nodes}, drawn with {lines}; its mode shape is drawn beside the structure at rest.{places}"


def _remark(found: Scene) -> str:
    along = "The structure moves along its own line; the motion is drawn across it." if found.across else ""
    fewer = f"Drawn with {found.nodes} of {found.of} nodes." if found.nodes < found.of else ""
    return " ".join(filter(None, (along, fewer)))


def _controls(found: Scene, seen: View) -> Markup:
    """What the script brings to life; hidden where scripts do not run."""
    options = [tag("option", _name(shape), value=i) for i, shape in enumerate(found.shapes)]
    choose = tag("label", "Mode ", tag("select", *options, class_="mode"))
    play = tag("button", "Play", type="button", class_="play")
    controls = [choose, play] if found.shapes else []
    if seen.turn is not None:
        controls += [_slider("Turn", "turn", -180, 180, seen.turn), _slider("Tilt", "tilt", -90, 90, TILT)]
    return tag("div", *controls, class_="controls", hidden=True) if controls else Markup("")


def _slider(words: str, name: str, low: int, high: int, value: float) -> Markup:
    bounds = {"min": low, "max": high, "step": 1, "value": f"{value:g}"}
    return tag("label", f"{words} ", tag("input", type="range", class_=name, **bounds))


def _legend(found: Scene, marked: Sequence[Mark], document: Part) -> Markup:
    """What the lines are."""
    name, kind = drawn_model(document), document.part("verdict").text("kind")
    tested = any(shape.tested for shape in found.shapes)
    rows = [
        ("still", "at rest", True),
        ("moved", name, bool(found.shapes)),
        ("test", "the test, at its sensors", tested),
        ("ring", _LOCATED.get(kind, "the located site"), any(mark.strong for mark in marked)),
        ("ring rival", "other sites, fainter the less probable", any(not mark.strong for mark in marked)),
    ]
    items = [
        tag("li", tag("span", class_=f"key {looks}", aria_hidden="true"), words) for looks, words, on in rows if on
    ]
    return tag("ul", *items, class_="legend")


SECTION = PageSection("drawing", 15, "Mode shapes", drawing, folded=False)
