"""Mass beside the axis about which a bar twists: bending and torsion together."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown
from mouse_cli.diagnosis.effects.shearing import lumped
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.preload import runs, site_of
from mouse_cli.diagnosis.sites.reasons import bars
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam

_SOFT = 1e-10  # share of the stiffness that a bar has which stands for its mass alone
_WIDE = 3.0  # radii of gyration
_MASS = ("density", "nonstructural_mass")


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """The mass of a bar moves as its centre does, u + theta x e, e along local y or z."""
    if (
        model.bars is None
        or lumped(model).any()
        or any(model.problem.mesh.elements[s].options.get("offsets") for s in model.bars.set)
    ):
        return []
    bars = model.bars
    used = slice(0, min(model.r, int(model.data.test.number.max()) + 6))
    twists = np.abs(bars.twist[:, :, used]).max() * bars.span > 1e-6 * np.abs(bars.ends[:, 0, used]).max()
    own = [run for run in runs(model) if all(len(bars.twins[_key(run, i)]) == 2 for i in run.members)]
    if not twists or not own:
        return []
    return [_recipe(model, candidate, run, axis, 2 * len(own)) for run in own for axis in (0, 1)]


def _key(run: Line, bar: int) -> tuple[int, int]:
    return int(run.bars.set[bar]), int(run.bars.member[bar])


def _recipe(model: Reduced, candidate: Candidate, run: Line, axis: int, count: int) -> Recipe:
    bars, members = model.bars, run.members
    twins = np.array([sorted(bars.twins[_key(run, i)], key=lambda k: bars.plane[k]) for i in members])
    radius = float(np.sqrt(np.mean(bars.EI[twins].sum(axis=1) / bars.E[members] / bars.A[members])))
    e = Unknown("offset of the mass", "m", -_WIDE * radius, _WIDE * radius, log=False)
    across = bars.across[twins[:, axis]]
    before, where = _mass(bars, twins, axis, 0.0), site_of(model, run)
    site = Site(where.kind, where.ids, None, f"{where.text}, along local {'yz'[axis]}")
    change = lambda values: Change(M=_mass(bars, twins, axis, values[0]) - before)
    extend = lambda problem, values: _beside(problem, run, values[0] * across[0])
    grid = _WIDE * radius * np.array([[-0.5], [-0.15], [0.15], [0.5]])
    return Recipe(candidate, (e,), change, grid, lambda values: site, 0, -float(np.log(count)), extend)


def _mass(bars, twins: np.ndarray, axis: int, e: float) -> np.ndarray:
    """M (r, r) of bars (c, 2 planes) whose mass is at e along local y (axis 0) or z (axis 1)."""
    first, twist = twins[:, 0], bars.twist[twins[:, 0]]
    l, mass = bars.length[first], bars.line_mass[first] * bars.length[first]
    M, slopes = 0.0, bars.ends[twins[:, axis]][:, [1, 3]]
    for plane in (0, 1):
        ends = bars.ends[twins[:, plane]].copy()
        if plane != axis:
            ends[:, [0, 2]] += (e if axis == 0 else -e) * twist
        w, _, _ = beam.shapes(l, bars.phi[twins[:, plane]])
        blocks = beam.integral(w, mass)
        M = M + ends.reshape(-1, ends.shape[2]).T @ (blocks @ ends).reshape(-1, ends.shape[2])
    along = bars.axial[first] - e * slopes
    blocks = mass[:, None, None] * np.array([[1 / 3, 1 / 6], [1 / 6, 1 / 3]])
    return M + along.reshape(-1, along.shape[2]).T @ (blocks @ along).reshape(-1, along.shape[2])


def _beside(problem: Problem, run: Line, offset: np.ndarray) -> Problem:
    """The mass of the bars, with hardly any stiffness, on rigid arms beside them; no parameter can say how far."""
    edit = Edit(problem)
    beams = beams_within(edit, [run.ends])
    for s in sorted({s for s, _ in beams}):
        own = edit.extract([each for each in beams if each[0] == s])
        members = edit.sets[own[0][0]]
        values = {name: np.array([edit.values(e, name) for e in own]) for name in ("E", "G", *members.properties)}
        values |= {"E": _SOFT * values["E"], "G": _SOFT * values["G"], "preload": np.zeros(len(own))}
        options = members.options | {"offsets": {1: offset.tolist(), 2: offset.tolist()}}
        added = edit.add("beam", members.nodes, values, options)
        for name in _MASS:
            edit.put(own, name, np.zeros(len(own)))
        edit.move(own[0][0], _MASS, added[0][0])
    return edit.done()


CANDIDATE = Candidate(
    "offset",
    "mass beside the shear centre",
    "offset",
    "the centre of mass of a section is not the point about which it twists: bending and torsion come in pairs of coupled modes",
    recipes,
    bars,
    lasting=True,
)
