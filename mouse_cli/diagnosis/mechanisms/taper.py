"""A section that changes along a row of bars."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Softening, Unknown, product, steps
from mouse_cli.diagnosis.effects.line_mass import uniform
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.line_mass import line_mass, put_line_mass
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line, whole
from mouse_cli.diagnosis.sites.members import crossed
from mouse_cli.diagnosis.sites.preload import runs, site_of
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.problem import Problem

_FEWEST = 4  # bars in a row that show a slope
_MOST = 0.6  # change from the middle to an end
# Of b h over that of b h^3: a third where the depth h changes, all where the width b does
_LEAST_MASS, _MOST_MASS = 0.3, 1.0


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """EI (1 + a xi) and mass per length (1 + a b xi), xi from -1 at one end of a member to 1 at the other; it stops at joints."""
    rows = runs(model, "nonstructural_mass", "Iy", "Iz", multiplied=True)
    joints = crossed(model.problem.mesh) if rows else set()
    found = [part for run in rows for part in run.parted(joints) if len(part.members) >= _FEWEST]
    return [_recipe(model, candidate, run, len(found)) for run in found]


def _recipe(model: Reduced, candidate: Candidate, run: Line, count: int) -> Recipe:
    bars = model.bars
    a = Unknown("slope of EI over its mean", "1", -_MOST, _MOST, log=False)
    b = Unknown("slope of the mass over that of EI", "1", _LEAST_MASS, _MOST_MASS, log=False)
    along = {int(i): _xi(run, run.bars.point(int(i), 0.5)) for i in run.members}
    members = whole(run)
    same = {(int(bars.set[i]), int(bars.member[i])): xi for i, xi in along.items()}
    xi = np.array([same[int(bars.set[i]), int(bars.member[i])] for i in members])
    F = np.zeros((len(members), 2, 2))
    F[:, 0, 0], F[:, 1, 1] = bars.length[members] / bars.EI[members], bars.length[members] / (3 * bars.EI[members])
    M = sum(bars.line_mass[i] * value * uniform(bars, i) for i, value in along.items())
    site = site_of(model, run)

    def change(values: np.ndarray) -> Change:
        return Change(
            M=values[0] * values[1] * M, softening=Softening(members, F * (1 / (1 + values[0] * xi) - 1)[:, None, None])
        )

    extend = lambda problem, values: _tapered(problem, run, values[0], values[0] * values[1])
    grid = product(steps(a, 4), steps(b, 2))
    return Recipe(candidate, (a, b), change, grid, lambda values: site, 0, -float(np.log(count)), extend)


def _xi(run: Line, point: tuple[float, float, float]) -> float:
    start, end = run.ends
    return float(2 * (np.array(point) - start) @ (end - start) / ((end - start) @ (end - start)) - 1)


def _tapered(problem: Problem, run: Line, a: float, b: float) -> Problem:
    """The sections themselves; no parameter can say a slope."""
    edit = Edit(problem)
    beams = beams_within(edit, [run.ends])
    middles = [np.mean([edit.coordinates[n] for n in edit.sets[s].nodes[i]], axis=0) for s, i in beams]
    xi = np.array([_xi(run, middle) for middle in middles])
    for name in ("Iy", "Iz"):
        edit.put(beams, name, np.array([edit.values(e, name) for e in beams]) * (1 + a * xi))
    own, more = np.array([edit.values(e, "density") * edit.values(e, "A") for e in beams]), line_mass(edit, beams)
    put_line_mass(edit, beams, more + b * xi * (own + more))
    return edit.done()


CANDIDATE = Candidate(
    "taper",
    "a taper",
    "taper",
    "sections that grow or shrink along a member, a row of bars up to the next joint, which the model takes as uniform: stiffness "
    "and mass change linearly, the mass by 0.3 to 1 times as much, as in one section (b h and b h^3)",
    recipes,
    bars,
    lasting=True,
)
