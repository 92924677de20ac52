"""Draws the layers of the package as an SVG: rows from the Layers line of CONTRIBUTING.md, text from the docstrings of packages."""

import ast
import re
import textwrap
from pathlib import Path
from xml.sax.saxutils import escape

TOP = Path(__file__).resolve().parents[1]
# Of the drawing, between boxes, of a line of text, of a letter: pixels
_WIDTH, _GAP, _LINE, _CHARACTER = 960, 12, 15, 6.1
_STYLE = (
    "text{font:12px sans-serif;fill:#1a1a1a} .name{font-weight:bold;font-size:13px} rect{fill:#eef3f8;stroke:#55708c}"
)


def layers() -> list[list[str]]:
    """Packages from the top layer down, as CONTRIBUTING.md lists them."""
    line = re.search(r"\*\*Layers\.\*\* `([^`]+)`", (TOP / "CONTRIBUTING.md").read_text("utf-8"))
    return [[name.strip() for name in row.split(",")] for row in line[1].split(">")]


def summary(package: str) -> str:
    """The first sentence of the docstring of a package."""
    text = ast.get_docstring(ast.parse((TOP / "mouse_cli" / package / "__init__.py").read_text("utf-8")))
    return re.split(r"[.;](?:\s|$)", text.replace("\n", " "))[0]


def drawing() -> str:
    """The map: one row a layer; a package imports from its own row and from those below."""
    body, y = [], _GAP
    for row in layers():
        width = (_WIDTH - _GAP * (len(row) + 1)) / len(row)
        texts = [textwrap.wrap(summary(name), int((width - 2 * _GAP) / _CHARACTER)) for name in row]
        height = _LINE * (max(map(len, texts)) + 1) + _GAP
        for place, (name, lines) in enumerate(zip(row, texts, strict=True)):
            x = _GAP + place * (width + _GAP)
            body.append(f'<rect x="{x:.0f}" y="{y}" width="{width:.0f}" height="{height}" rx="4"/>')
            for number, line in enumerate([name, *lines]):
                kind = ' class="name"' if number == 0 else ""
                body.append(f'<text{kind} x="{x + 8:.0f}" y="{y + _LINE * (number + 1) + 2}">{escape(line)}</text>')
        y += height + _GAP
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {y}" role="img" aria-label="Layers of the package">'
    return "\n".join([head, f"<style>{_STYLE}</style>", *body, "</svg>"]) + "\n"
