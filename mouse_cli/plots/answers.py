"""Figures of answers in JSON."""

from typing import Any

import numpy as np

from mouse_cli.dynamics.correlation import mac
from mouse_cli.model.diagnosis import Site
from mouse_cli.plots import AFTER, BEFORE, Plot, labelled
from mouse_cli.plots._field import TITLE, band
from mouse_cli.plots._line import along, lying
from mouse_cli.plots._pairs import pairs
from mouse_cli.report.reading import Part, columns, updates

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


def answer_frequencies(document: Part, axes: Any) -> bool:
    """Two bars a mode, in per cent of the measured frequency, with the sd of its measurement."""
    found = update(document)
    modes = [m for m in found.parts("modes") if m.number("test_hz")][:MOST] if found else []
    if not modes:
        return False
    measured = values(modes, "test_hz")
    errors = [100 * (values(modes, key) / measured - 1) for key in ("prior_hz", "revised_hz")]
    sd = np.nan_to_num(100 * values(modes, "test_sd_hz") / measured)
    pairs(axes, [f"mode {m.label('mode')}" for m in modes], errors, sd, ("prior", "revised"))
    return True


def answer_parameters(document: Part, axes: Any) -> bool:
    """Shift from the prior value in prior standard deviations, with one standard deviation of each."""
    found = update(document)
    shown = [p for p in found.parts("parameters") if p.number("prior_sd")][:MOST] if found else []
    if not shown:
        return False
    at, sd = np.arange(len(shown)), values(shown, "prior_sd")
    posterior = values(shown, "posterior_sd" if "posterior_sd" in shown[0].values else "sd")
    whiskers(axes, at, np.zeros(len(shown)), np.ones(len(shown)), False)
    shift = (values(shown, "posterior") - values(shown, "prior")) / sd
    whiskers(axes, at, shift, np.nan_to_num(posterior / sd), True)
    axes.axvline(0, color="black", linewidth=0.8)
    axes.set_yticks(at, [short(p.label("name")) for p in shown], fontsize=8 if len(shown) <= 12 else 6)
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("shift, prior standard deviations")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    return True


_WRITTEN = 12  # modes up to which each square holds its number
_DARK = 0.55  # above which letters are white


def answer_mac(document: Part, axes: Any) -> bool:
    """Rows are measured modes, columns the paired modes of the model."""
    found = update(document)
    components = found.parts("shapes") if found else []
    modes = list(dict.fromkeys(c.label("mode") for c in components))[:MOST]
    components = [c for c in components if c.label("mode") in modes]
    if not modes:
        return False
    matrix = mac(columns(components, modes, "test"), columns(components, modes, "revised"))
    axes.imshow(matrix, cmap="Blues", vmin=0, vmax=1)
    for i, k in np.ndindex(matrix.shape) if len(modes) <= _WRITTEN else ():
        colour = "white" if matrix[i, k] > _DARK else "black"
        axes.text(k, i, f"{matrix[i, k]:.2f}", ha="center", va="center", fontsize=7, color=colour)
    axes.set_xticks(range(len(modes)), modes)
    axes.set_yticks(range(len(modes)), modes)
    axes.grid(visible=False)
    return labelled(axes, "mode of the revised model", "measured mode")


def answer_causes(document: Part, axes: Any) -> bool:
    """Of an answer in JSON: probabilities of the groups of causes. Bars; of several arrangements those of the first turn."""
    judged = document.parts("groups") or [g for turn in document.parts("turns")[:1] for g in turn.parts("groups")]
    shown = [g for g in judged if g.number("probability") is not None][:MOST]
    if not shown:
        return False
    lying(axes, [short(g.text("group")) for g in shown], [g.number("probability") or 0.0 for g in shown], AFTER)
    axes.set_xlim(0, 1)
    return labelled(axes, "probability")


def answer_field(document: Part, axes: Any) -> bool:
    """Over the longest direction of the structure, or over the number of the site where sites are not in one line."""
    found = document.part("verdict").part("field")
    every = found.parts("sites")
    points = [[x for x in each.numbers("position") if x is not None] for each in every]
    row = along([Site("", (), tuple(p) if len(p) == 3 else None) for p in points])
    at, name = (np.arange(1.0, len(every) + 1), "number of the site") if row is None else row
    return band(axes, at, values(every, "value"), values(every, "sd"), name, found.text("property"))


_MOST_PLACES = 15  # bars


def answer_places(document: Part, axes: Any) -> bool:
    """Of an answer in JSON: probability of each place where one force could make all measured shapes."""
    shown = document.part("location").parts("places")[:_MOST_PLACES]
    if not shown:
        return False
    names = [f"{words(p.part('site'))} {p.text('channel')}" for p in shown]
    lying(axes, names, [p.number("probability") or 0.0 for p in shown], AFTER)
    return labelled(axes, "probability")


_MOST_SHAPES, _ROW = 8, 4  # shapes, and how many stand beside each other
_SIZE = 0.15  # of the structure: the largest displacement
_GAP = 1.2  # from one drawing to the next, in sizes of a drawing
_NARROW = 0.4  # of the larger side of a drawing: the least room, for its label
_THIN = 1e-3  # of the largest extent, below which a direction is not seen
_VIEW = np.array([[0.866, -0.866, 0.0], [0.4, 0.4, 1.0]])  # isometric, z up


def answer_shapes(document: Part, axes: Any) -> bool:
    """Each mode beside the undeformed structure in grey."""
    geometry = document.part("geometry")
    shapes = geometry.parts("shapes")[:_MOST_SHAPES]
    at = _coordinates(geometry.rows("positions"))
    if not shapes or not len(at):
        return False
    lines = [[int(i) for i in line if i is not None] for line in geometry.rows("lines")]
    scale = _SIZE * (np.ptp(at, axis=0).max() or 1.0)
    drawn = np.array([at, *(at + scale * _coordinates(shape.rows("displacements")) for shape in shapes)])
    still, *moved = drawn @ _view(drawn).T
    low, high = (end([still, *moved], axis=(0, 1)) for end in (np.min, np.max))
    step = _GAP * np.maximum(high - low, _NARROW * np.max(high - low))
    for k, (shape, points) in enumerate(zip(shapes, moved, strict=True)):
        corner = step * [k % _ROW, -(k // _ROW)]
        _drawn(axes, still + corner, lines, BEFORE, 0.6)
        _drawn(axes, points + corner, lines, AFTER, 1.1)
        axes.text(*low + corner, f"mode {shape.label('mode')}, {shape.number('hz') or 0:.4g} Hz", fontsize=7, va="top")
    axes.set_aspect("equal")
    axes.set_axis_off()
    return True


def _view(drawn: np.ndarray) -> np.ndarray:
    """Directions (2, 3) in which what is `drawn` (d, k, 3) is seen: its plane where it stays in one, else an isometric view."""
    extent = np.ptp(drawn.reshape(-1, 3), axis=0)
    return _VIEW if extent.min() > _THIN * extent.max() else np.delete(np.eye(3), int(np.argmin(extent)), axis=0)


def _drawn(axes: Any, points: np.ndarray, lines: list[list[int]], colour: str, width: float) -> None:
    """points (k, 2); lines between them, or dots where there are none."""
    if not lines:
        axes.plot(*points.T, ".", color=colour, markersize=3)
        return
    gap = np.full(2, np.nan)
    path = np.array([each for i, j in lines for each in (points[i], points[j], gap)])
    axes.plot(*path.T, color=colour, linewidth=width)


def _coordinates(rows: list[list[float | None]]) -> np.ndarray:
    """Coordinates (k, 3)."""
    return np.array([[0.0 if x is None else x for x in row] for row in rows], dtype=float).reshape(-1, 3)


def answer_convergence(document: Part, axes: Any) -> bool:
    """Of an answer in JSON: chi-square after each cycle. On a logarithmic axis; cycle 0 is the prior model."""
    chi2 = values(document.parts("cycles"), "chi2")
    if len(chi2) < 2 or not np.isfinite(chi2).any() or np.nanmin(chi2) <= 0:
        return False
    axes.semilogy(range(len(chi2)), chi2, marker="o", markersize=3.5, color=AFTER)
    axes.xaxis.get_major_locator().set_params(integer=True)
    return labelled(axes, "cycle", "chi-square")


PLOTS = (
    Plot("answer-frequencies", 10, "What the models miss of the measured frequencies", answer_frequencies, (Part,)),
    Plot("answer-parameters", 20, "Parameters, prior and posterior", answer_parameters, (Part,)),
    Plot("answer-mac", 30, "MAC of test and revised model", answer_mac, (Part,)),
    Plot("answer-causes", 40, "Probability of each group of mechanisms", answer_causes, (Part,)),
    Plot("answer-field", 45, TITLE, answer_field, (Part,)),
    Plot("answer-places", 50, "Where one force could make all measured shapes", answer_places, (Part,)),
    Plot("answer-shapes", 60, "Mode shapes of the revised model", answer_shapes, (Part,)),
    Plot("answer-convergence", 70, "Chi-square after each cycle", answer_convergence, (Part,)),
)
