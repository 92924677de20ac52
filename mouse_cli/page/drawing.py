"""The structure as inline SVG: at rest, deformed in a mode, what the test read, and the marked places.

The drawing is whole as it stands. Its numbers stand beside it in `data-scene`, for the script that moves and turns it.
"""

import json
from collections.abc import Sequence

import numpy as np

from mouse_cli.page.html import Markup, tag
from mouse_cli.page.marks import Mark
from mouse_cli.page.projection import TILT, View, view
from mouse_cli.page.scene import Scene, Shape
from mouse_cli.page.svg import svg, tenth

WIDTH, HIGHEST, MARGIN = 640.0, 440.0, 34.0
_SMALL, _LOW, _EDGE = 260.0, 200.0, 16.0  # of a drawing in the row of all modes
_FINE = 10000  # positions in the data count in this share of the size of the structure, displacements in thousandths
_DOTTED = 120  # nodes up to which each is a dot
_LONGEST, _LETTER = 28, 7.6  # characters of a name in the drawing, and how wide each is, about
_RING = 11.0


def large(scene: Scene) -> View:
    """The view of the large drawing."""
    return view(scene, WIDTH, HIGHEST, MARGIN)


def stage(scene: Scene, marks: Sequence[Mark], seen: View, title: str, description: str) -> Markup:
    """The large drawing, in its first mode, with the numbers for the script."""
    pieces = [*_pieces(scene, scene.shapes[:1], marks, seen), _names(scene, marks, seen), _triad(seen)]
    size = (seen.width, seen.height)
    return svg("stage", title, description, size, *pieces, data_scene=_data(scene, marks, seen), class_="stage")


def small(scene: Scene, shape: Shape, marks: Sequence[Mark], key: str, title: str) -> Markup:
    """The drawing of one mode, among others."""
    seen = view(scene, _SMALL, _LOW, _EDGE)
    description, size = f"{title}, drawn on the structure.", (seen.width, seen.height)
    return svg(key, title, description, size, *_pieces(scene, (shape,), marks, seen))


def _pieces(scene: Scene, shapes: Sequence[Shape], marks: Sequence[Mark], seen: View) -> list[Markup]:
    rest = seen.at(scene.positions)
    held = _held(scene, marks)
    pieces = [tag("path", d=_lines(rest, scene.lines), class_="still")]
    if held:
        u = shapes[0].u if shapes else 0.0
        at = seen.at(scene.positions + scene.amplitude * u)
        pieces.append(tag("path", d=_lines(at, np.array(held)), class_="stretch"))
    if not len(scene.lines) or not shapes:
        pieces.append(tag("path", d=_dots(rest[: scene.nodes]), class_="still dots"))
    for shape in shapes:
        at = seen.at(scene.positions + scene.amplitude * shape.u)
        if not len(scene.lines):
            pieces.append(tag("path", d=_stems(rest, at), class_="stems"))
        pieces.append(tag("path", d=_lines(at, scene.lines), class_="moved"))
        dots = at[: scene.nodes if _dotted(scene) else 0]
        pieces.append(tag("path", d=_dots(dots), class_="moved dots"))
        pieces.append(tag("path", d=_squares(seen.at(_tested(scene, shape))), class_="test"))
    return [*pieces, *_rings(scene, shapes, marks, seen)]


def _dotted(scene: Scene) -> bool:
    """Whether each node is a dot."""
    return scene.nodes <= _DOTTED or not len(scene.lines)


def _held(scene: Scene, marks: Sequence[Mark]) -> list[tuple[int, int]]:
    """Lines of the elements that the answer takes up."""
    taken = [mark.nodes for mark in marks if mark.strong]
    return [(i, j) for i, j in scene.lines.tolist() if any({i, j} <= nodes for nodes in taken)]


def _tested(scene: Scene, shape: Shape) -> np.ndarray:
    found = [scene.positions[node] + scene.amplitude * u for node, u in shape.tested]
    return np.array(found).reshape(-1, 3)


def _rings(scene: Scene, shapes: Sequence[Shape], marks: Sequence[Mark], seen: View) -> list[Markup]:
    rings = []
    for mark, (x, y) in zip(marks, _centres(scene, shapes, marks, seen), strict=True):
        faint = None if mark.strong else f"{0.35 + 0.65 * min(mark.probability or 0.0, 1.0):.2f}"
        looks = "ring" if mark.strong else "ring rival"
        rings.append(tag("circle", cx=tenth(x), cy=tenth(y), r=_RING, class_=looks, stroke_opacity=faint))
    return rings


def _centres(scene: Scene, shapes: Sequence[Shape], marks: Sequence[Mark], seen: View) -> np.ndarray:
    """Where marks (c, 2) are drawn: they move with the structure."""
    u = shapes[0].u if shapes else np.zeros_like(scene.positions)
    points = [mark.point + scene.amplitude * ((1 - w) * u[i] + w * u[j]) for mark, (i, j, w) in _tied(scene, marks)]
    return seen.at(np.array(points).reshape(-1, 3))


def _tied(scene: Scene, marks: Sequence[Mark]) -> list[tuple[Mark, tuple[int, int, float]]]:
    return [(mark, tied(scene, mark.point)) for mark in marks]


def tied(scene: Scene, point: np.ndarray) -> tuple[int, int, float]:
    """The two nodes that `point` moves between, and how far it is from the first to the second: on the nearest line."""
    if not len(scene.lines):
        nearest = int(np.argmin(((scene.positions - point) ** 2).sum(axis=1)))
        return nearest, nearest, 0.0
    a, b = (scene.positions[scene.lines[:, end]] for end in (0, 1))
    span = b - a
    length2 = np.maximum((span**2).sum(axis=1), 1e-300)
    w = np.clip(((point - a) * span).sum(axis=1) / length2, 0.0, 1.0)
    nearest = int(np.argmin(((point - a - w[:, None] * span) ** 2).sum(axis=1)))
    i, j = scene.lines[nearest].tolist()
    return i, j, round(float(w[nearest]), 4)


def _names(scene: Scene, marks: Sequence[Mark], seen: View) -> Markup:
    """The name of each marked place that is the answer, beside its ring."""
    named = []
    for i, (mark, (x, y)) in enumerate(zip(marks, _centres(scene, scene.shapes[:1], marks, seen), strict=True)):
        if mark.name:
            short = mark.name if len(mark.name) <= _LONGEST else f"{mark.name[: _LONGEST - 1]}…"
            leftward = x + 16 + _LETTER * len(short) > seen.width
            place = {"x": tenth(x + (-16 if leftward else 16)), "y": tenth(y - 14)}
            named.append(tag("text", short, text_anchor="end" if leftward else "start", data_mark=i, **place))
    return tag("g", *named, class_="names")


def _triad(seen: View) -> Markup:
    """The axes, in the lower left corner."""
    x, y, pieces = 30.0, seen.height - 26, []
    for name, arrow in seen.axes(20.0):
        end = np.array([x, y]) + arrow
        letter = np.array([x, y + 4]) + 1.45 * arrow
        pieces.append(tag("line", x1=tenth(x), y1=tenth(y), x2=tenth(end[0]), y2=tenth(end[1]), class_="axis"))
        pieces.append(tag("text", name, x=tenth(letter[0]), y=tenth(letter[1]), text_anchor="middle"))
    return tag("g", *pieces, class_="triad")


def _data(scene: Scene, marks: Sequence[Mark], seen: View) -> str:
    """What the script draws with, as JSON of whole numbers."""
    middle = (scene.positions.min(axis=0) + scene.positions.max(axis=0)) / 2
    of = lambda points: ((points - middle) / scene.size * _FINE).round().astype(int).ravel().tolist()
    tests = [[[node, *(1000 * u).round().astype(int).tolist()] for node, u in s.tested] for s in scene.shapes]
    found = {
        "p": of(scene.positions),
        "l": scene.lines.ravel().tolist(),
        "u": [(1000 * s.u).round().astype(int).ravel().tolist() for s in scene.shapes],
        "t": tests,
        "m": [[*of(mark.point), *tie] for mark, tie in _tied(scene, marks)],
        "a": scene.amplitude / scene.size * _FINE / 1000,
        "v": None if seen.turn is None else [seen.turn, TILT],
        "f": seen.matrix.round(6).tolist(),
        "s": [x for pair in _held(scene, marks) for x in pair],
        "d": scene.nodes if _dotted(scene) else 0,
        "h": MARGIN,
    }
    return json.dumps(found, separators=(",", ":"))


def _lines(at: np.ndarray, lines: np.ndarray) -> str:
    """Lines as one path; those that begin where the last one ended go on from there."""
    words, last = [], -1
    places = [f"{tenth(x)} {tenth(y)}" for x, y in at.tolist()]
    for i, j in lines.tolist():
        words.append(f"L{places[j]}" if i == last else f"M{places[i]}L{places[j]}")
        last = j
    return "".join(words)


def _dots(at: np.ndarray) -> str:
    """Points as strokes of no length, whose round ends are dots."""
    return "".join(f"M{tenth(x)} {tenth(y)}h0" for x, y in at.tolist())


def _stems(rest: np.ndarray, at: np.ndarray) -> str:
    """From each point at rest to where it is: without lines nothing else says which is which."""
    return "".join(
        f"M{tenth(a)} {tenth(b)}L{tenth(x)} {tenth(y)}"
        for (a, b), (x, y) in zip(rest.tolist(), at.tolist(), strict=True)
    )


def _squares(at: np.ndarray) -> str:
    return "".join(f"M{tenth(x - 4)} {tenth(y - 4)}h8v8h-8z" for x, y in at.tolist())
