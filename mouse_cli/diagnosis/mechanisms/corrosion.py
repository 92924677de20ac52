"""A stretch of bars that has lost wall thickness: corrosion, erosion, wear; stiffness and mass are lost together."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Softening, Unknown, product, steps
from mouse_cli.diagnosis.effects.line_mass import LineIntegral, motions
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.intervals import Interval
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.preload import runs
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.diagnosis.sites.stretches import bent, covered, elements_of
from mouse_cli.model.problem import Problem

_LOST = Unknown("share of the thickness lost", "1", 0.02, 0.9)
_ROWS = 24  # rows of bars that are looked at, the longest


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """F / (1 - d) and M - d M_e, EI and EA by one factor in all planes, over a part of a row of bars between two places."""
    found = sorted((run for run in runs(model) if _weight(run).any()), key=lambda run: -run.length)[:_ROWS]
    total = sum(run.length for run in found)
    return [_recipe(candidate, run, run.length / total) for run in found]


def _weight(run: Line) -> np.ndarray:
    """Mass per length (c,) of the section of each bar, without what it carries."""
    bars, own = run.bars, run.members
    return bars.section_inertia[own] * bars.E[own] * bars.A[own] / bars.EI[own]


def _recipe(candidate: Candidate, run: Line, share: float) -> Recipe:
    interval, root = Interval(run), dict(zip(run.members.tolist(), np.sqrt(_weight(run)).tolist(), strict=True))
    mass = LineIntegral(run, lambda bars, bar: root[bar] * motions(bars, bar))

    def change(values: np.ndarray) -> Change:
        ends = interval.ends(*values[1:])
        softer = _softer(run, *covered(run, *ends), values[0] / (1 - values[0]))
        return Change(M=-values[0] * mass.between(*ends), softening=softer)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        own = elements_of(edit, run, *interval.ends(*values[1:]))
        edit.bind(f"section left of {interval.site(*values[1:]).text}", own, ("A", "Iy", "Iz"), factor=1 - values[0])
        return edit.done()

    return Recipe(
        candidate,
        (_LOST, *interval.unknowns),
        change,
        product(steps(_LOST, 2), *interval.grid),
        lambda values: interval.site(*values[1:]),
        log_prior=float(np.log(share)),
        extend=extend,
    )


def _softer(run: Line, touched: np.ndarray, a: np.ndarray, b: np.ndarray, more: float) -> Softening:
    """`more` of the flexibility of the covered parts: bending and shear in every plane, and elongation, once for an element."""
    every: Bars = run.bars
    twins = [every.twins[int(every.set[bar]), int(every.member[bar])] for bar in touched]
    own, count = np.array([bar for planes in twins for bar in planes]), [len(planes) for planes in twins]
    a, b, first = np.repeat(a, count), np.repeat(b, count), np.cumsum(count) - count
    added = np.zeros((len(own), 3, 3))
    added[:, :2, :2] = bent(run, own, a, b)
    added[:, 1, 1] += (b - a) * every.phi[own] * every.length[own] / (3 * every.EI[own])
    added[first, 2, 2] = ((b - a) * every.flexibility[own, 2, 2])[first]
    return Softening(own, more * added)


CANDIDATE = Candidate(
    "corrosion",
    "a stretch with a thinner wall",
    "local-stiffness",
    "a stretch of a bar that has lost wall thickness (corrosion, erosion, wear): A, Iy and Iz by one factor and the mass of the "
    "section with them, between two places",
    recipes,
    bars,
)
