"""What figures of answers in JSON share."""

from typing import Any

import numpy as np

from mouse_cli.plots import AFTER, BEFORE
from mouse_cli.report.reading import Part, updates

MOST = 40  # lines of a figure


def update(document: Part) -> Part | None:
    """The last update of the document: of the extended model where there is one."""
    found = updates(document)
    return found[-1][2] if found else None


def values(parts: list[Part], key: str) -> np.ndarray:
    """Numbers (k,) of the parts; NaN where one is unknown."""
    return np.array([np.nan if (x := part.number(key)) is None else x for part in parts], dtype=float)


def short(name: str, most: int = 28) -> str:
    """A name that leaves room for the figure, on one line; no mathematics, whatever signs it has."""
    plain = "".join(c if c.isprintable() else "?" for c in name).replace("$", r"\$")
    return plain if len(plain) <= most else f"{plain[: most - 3]}..."


def words(site: Part) -> str:
    """A place."""
    return short(site.text("text") or f"{site.text('kind')} {', '.join(site.labels('ids'))}".strip(), 44)


def whiskers(axes: Any, at: np.ndarray, centre: np.ndarray, half: np.ndarray, after: bool) -> None:
    """Values with half widths, on lines `at`; of the model as it is, or of the revised one."""
    shift, colour = (0.16, AFTER) if after else (-0.16, BEFORE)
    name = "posterior" if after else "prior"
    axes.errorbar(centre, at + shift, xerr=half, fmt="o", markersize=3.5, color=colour, capsize=2, label=name)
