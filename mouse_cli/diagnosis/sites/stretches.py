"""Stretches of lines of bars that are softer, or stiffer, than the model says."""

import numpy as np

from mouse_cli.diagnosis.effects.change import PLACE, Change, Recipe, Softening, Unknown, product, steps
from mouse_cli.diagnosis.effects.hinges import lines
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within, element_at
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_STARTS = 8  # places to begin from on a line
_WHOLE = 0.9  # of a line, from which on a stretch is called all of it
_WIDEST = 0.6  # of a line that is all of the structure: beyond, a stretch is the modulus of all


def of_lines(model: Reduced, candidate: Candidate, stiffer: bool = False) -> list[Recipe]:
    """1/EI (1 + d), or EI (1 + d) of one that is stiffer, over a stretch of width w about x, for each line of bars."""
    return _over(lines(model), candidate, stiffer, both=False)


def in_both_planes(model: Reduced, candidate: Candidate, stiffer: bool = False) -> list[Recipe]:
    """The same for each row of bars that bends in two planes, in both alike: of another material, or by another wall."""
    rows = [line for line in lines(model) if not line.bars.plane[line.members[0]] and line.both_ways]
    return _over(rows, candidate, stiffer, both=True)


def _over(chosen: list[Line], candidate: Candidate, stiffer: bool, both: bool) -> list[Recipe]:
    """A stretch of each of the lines `chosen`, which share the prior by their lengths."""
    total = sum(line.length for line in chosen)
    widest = _WIDEST if len(chosen) == 1 else 1.0
    return [_recipe(candidate, line, line.length / total, widest, stiffer, both) for line in chosen]


def _planes(line: Line, members: np.ndarray) -> list[list[int]]:
    """Bars of the same element, for each of `members`: one for each plane."""
    bars = line.bars
    return [bars.twins[int(bars.set[i]), int(bars.member[i])] for i in members]


def _recipe(candidate: Candidate, line: Line, share: float, widest: float, stiffer: bool, both: bool) -> Recipe:
    L = line.length
    d = Unknown("stiffness added" if stiffer else "flexibility added", "1", 0.02, 3.0)
    w = Unknown("width over length", "1", 0.05, widest)
    x = Unknown(PLACE, "m", 0.0, L, log=False)
    plane = ", in both planes" if both else f", bending {line.about}" if line.about else ""

    def change(values: np.ndarray) -> Change:
        touched, a, b = covered(line, *stretch(line, values))
        if both:
            touched, a, b = np.ravel(_planes(line, touched)).astype(int), np.repeat(a, 2), np.repeat(b, 2)
        more = -values[0] / (1 + values[0]) if stiffer else values[0]
        return Change(softening=Softening(touched, more * bent(line, touched, a, b)))

    def site(values: np.ndarray) -> Site:
        here = line.site(sum(stretch(line, values)) / 2)  # the middle of what is covered: less than the width at an end
        part = "the whole length" if values[1] > _WHOLE else f"{values[1]:.2g} of the length"
        return Site(here.kind, here.ids, here.position, f"{part}, about {here.text}{plane}")

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        factor = 1 + values[0] if stiffer else 1 / (1 + values[0])
        names = ("Iy", "Iz") if both else ("Iy",) if line.bars.plane[line.members[0]] else ("Iz",)
        return _with_stretch(problem, line, stretch(line, values), names, factor, site(values).text)

    grid = product(steps(d, 2), steps(w, 2), line.starts(_STARTS, share))
    return Recipe(candidate, (d, w, x), change, grid, site, log_prior=float(np.log(share)), extend=extend)


def stretch(line: Line, values: np.ndarray) -> tuple[float, float]:
    """Both ends of the stretch, as distances along the line."""
    half, L = values[1] * line.length / 2, line.length
    return max(0.0, float(values[2] - half)), min(L, float(values[2] + half))


def covered(line: Line, first: float, last: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Bars that lie within, if only in part, and the shares of their lengths between which they do."""
    a = np.minimum(np.maximum((first - line.start) / line.extent, 0.0), 1.0)
    b = np.minimum(np.maximum((last - line.start) / line.extent, 0.0), 1.0)
    within = b > a
    return line.members[within], a[within], b[within]


def bent(line: Line, touched: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Integral of [1, eta]'[1, eta] / EI over the covered part of each bar (c, 2, 2)."""
    bars, low, high = line.bars, 2 * a - 1, 2 * b - 1
    moments = [(high**k - low**k) / k for k in (1, 2, 3)]
    F = np.array([[moments[0], moments[1]], [moments[1], moments[2]]]).transpose(2, 0, 1)
    return F * (bars.length[touched] / 2 / bars.EI[touched])[:, None, None]


def elements_of(edit: Edit, line: Line, first: float, last: float) -> list[tuple[int, int]]:
    """Elements of the deck between two distances along the line, split where they reach beyond."""
    ends = [np.array(line.bars.point(*line.at(s))) for s in (first, last)]
    for end in ends:
        edit.split(*element_at(edit, end, line.bars.axis[line.members[0]]))
    return beams_within(edit, [tuple(ends)])


def _with_stretch(
    problem: Problem, line: Line, ends: tuple[float, float], names: tuple[str, ...], factor: float, where: str
) -> Problem:
    edit = Edit(problem)
    what = f"stiffness left of {where}" if factor < 1 else f"stiffness of {where}, strengthened"
    edit.bind(what, elements_of(edit, line, *ends), names, factor=factor)
    return edit.done()
