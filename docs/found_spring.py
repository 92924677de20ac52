"""Draws what a diagnosis of `decks/ground_spring_proved.yaml` found: the spring that the model lacked, errors before and after."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import mouse_cli

DECK = Path(__file__).resolve().parents[1] / "decks" / "ground_spring_proved.yaml"
_WIDTH, _HEIGHT = 960, 330
_STYLE = (
    "text{font:13px sans-serif;fill:#1a1a1a} .head{font-weight:bold;font-size:15px} .small{font-size:12px;fill:#555} "
    ".mass{fill:#eef3f8;stroke:#55708c} .spring{fill:none;stroke:#55708c;stroke-width:1.5} "
    ".found{fill:none;stroke:#c4312b;stroke-width:2.5} .red{fill:#c4312b} .before{fill:#9aa5b1} .after{fill:#c4312b}"
)
_WALL, _ROW = 24, 105  # pixels: first wall, height of the chain
_STEP, _SIZE = 100, 40  # pixels: from mass to mass, side of a mass
_LEFT, _ZERO, _GROUP = 560, 245, 42  # pixels: left edge and bottom of the bars, from mode to mode
_PER_CENT = 12.5  # pixels for an error of 1 %


def drawing() -> str:
    """The picture: the chain with the spring that was found, and errors of frequencies, fitted and held out."""
    found = mouse_cli.document(mouse_cli.diagnose(mouse_cli.read_deck(DECK)))
    label = (
        "A chain of four masses with the spring to the ground that mouse found; errors of frequencies before and after."
    )
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{label}">'
    paper = '<rect width="100%" height="100%" fill="#fff"/>'
    return "\n".join([head, f"<style>{_STYLE}</style>", paper, *_chain(found), *_errors(found), "</svg>"]) + "\n"


def _chain(found: dict[str, Any]) -> Iterator[str]:
    """Four masses in a row from a wall, and the spring to the ground at the site that the verdict names."""
    (node,) = found["verdict"]["site"]["ids"]
    size = found["candidates"][0]["parameters"][0]
    yield _text(_WALL, 30, "Modelled: masses and springs. Found: a spring to the ground", "head")
    yield f'<path class="spring" d="M{_WALL} {_ROW - 30}V{_ROW + 30}"/>'
    for i in range(4):
        at = _WALL + (i + 1) * _STEP
        yield _spring(at - _STEP + (_SIZE // 2 if i else 0), _ROW, at - _SIZE // 2, _ROW, "spring")
        yield f'<rect class="mass" x="{at - _SIZE // 2}" y="{_ROW - _SIZE // 2}" width="{_SIZE}" height="{_SIZE}" rx="4"/>'
        yield _text(at, _ROW + 5, str(i + 1), "", "middle")
    at = _WALL + node * _STEP
    yield _spring(at, _ROW + _SIZE // 2, at, _ROW + 95, "found")
    yield f'<path class="found" d="M{at - 30} {_ROW + 95}h60"/>'
    yield _text(at + 16, _ROW + 62, f"{size['value']:.0f} {size['unit']} (sd {size['sd']:.0f})", "red")
    yield _text(_WALL, _HEIGHT - 62, found["verdict"]["sentences"][0])
    yield _text(_WALL, _HEIGHT - 40, "The structure had 400 N/m there; the deck says nothing of it.", "small")


def _errors(found: dict[str, Any]) -> Iterator[str]:
    """Bars of |model - test| in per cent: four modes that were fitted, four of another configuration that no fit saw."""
    fitted = [_modes(found[key]["modes"]) for key in ("baseline", "extended")]
    held = found["held_out"]
    unseen = [_relative(held[key]["hz"], held["measured_hz"]) for key in ("baseline", "revised")]
    yield _text(_LEFT, 30, "Error of natural frequencies (%)", "head")
    for title, start, (before, after) in (
        ("fitted modes", 0, fitted),
        ("held out: modes with 3 kg added", 4.6, unseen),
    ):
        left = _LEFT + start * _GROUP
        yield _text(left, _ZERO + 38, title, "small")
        for i, pair in enumerate(zip(before, after, strict=True)):
            for k, (kind, value) in enumerate(zip(("before", "after"), pair, strict=True)):
                height = max(round(value * _PER_CENT), 1)
                x = round(left + i * _GROUP) + 16 * k
                yield f'<rect class="{kind}" x="{x}" y="{_ZERO - height}" width="14" height="{height}"/>'
                yield _text(x + 7, _ZERO - height - 4, f"{value:.1f}", "small", "middle")
            yield _text(round(left + i * _GROUP) + 15, _ZERO + 18, str(i + 1), "small", "middle")
    for k, (kind, title) in enumerate((("before", "parameters updated, spring missing"), ("after", "with the spring"))):
        yield f'<rect class="{kind}" x="{_LEFT + 240 * k}" y="{_HEIGHT - 34}" width="14" height="14"/>'
        yield _text(_LEFT + 240 * k + 20, _HEIGHT - 22, title, "small")


def _modes(modes: list[dict[str, float]]) -> list[float]:
    return _relative([each["revised_hz"] for each in modes], [each["test_hz"] for each in modes])


def _relative(model: list[float], test: list[float]) -> list[float]:
    return [100 * abs(a / b - 1) for a, b in zip(model, test, strict=True)]


def _spring(x0: int, y0: int, x1: int, y1: int, kind: str) -> str:
    """A zigzag of eight strokes, across the line from the one end to the other."""
    along = ((x1 - x0) / 10, (y1 - y0) / 10)
    across = (0, 8) if x1 != x0 else (8, 0)
    turns = [(x0 + k * along[0] + s * across[0], y0 + k * along[1] + s * across[1]) for k, s in _TURNS]
    return f'<path class="{kind}" d="M{x0} {y0}L' + "L".join(f"{x:.0f} {y:.0f}" for x, y in turns) + f'L{x1} {y1}"/>'


_TURNS = [(1, 0), *((k + 0.5, (-1) ** k) for k in range(1, 9)), (9, 0)]


def _text(x: float, y: float, text: str, kind: str = "", anchor: str = "start") -> str:
    return f'<text class="{kind}" x="{x:.0f}" y="{y}" text-anchor="{anchor}">{escape(text)}</text>'
