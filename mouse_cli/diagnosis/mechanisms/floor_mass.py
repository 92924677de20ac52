"""Mass along the bars of one floor, of one section or of one entry of the deck."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.effects.line_mass import LineIntegral
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line, elements
from mouse_cli.diagnosis.sites.members import upward
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_MOST = 24  # floors, sections and entries
_LEVEL = 1e-3  # of the height of the structure


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m times the integral of u'u over some of the rows of bars, not all of them."""
    found = [] if model.bars is None else list(model.bars.runs)
    if len(found) < 2 or any(b.property == "nonstructural_mass" for b in model.problem.bindings):
        return []
    parts = _parts(model, found)
    sums = {i: LineIntegral(found[i]).sums[-1] for i in sorted({i for own in parts.values() for i in own})}
    return [_recipe(model, candidate, name, [found[i] for i in own], sum(sums[i] for i in own), len(parts))
            for name, own in list(parts.items())[:_MOST]]  # fmt: skip


def _parts(model: Reduced, found: list[Line]) -> dict[str, tuple[int, ...]]:
    """Rows (numbers) of each floor, section and entry, by its name; each choice of rows once, and none that is all."""
    mesh, bars = model.problem.mesh, model.bars
    up = upward(mesh)
    height = float(np.ptp(mesh.coordinates[:, up])) or 1.0
    named: dict[str, list[int]] = {}
    for i, run in enumerate(found):
        low, high = (float(end[up]) for end in run.ends)
        if abs(high - low) < _LEVEL * height:
            named.setdefault(f"the floor at {'XYZ'[up]} = {round(low, 3):g} m", []).append(i)
    own = [{int(s) for s in bars.set[run.members]} for run in found]
    sections = [{mesh.elements[s].origin.get("A", "") for s in sets} for sets in own]
    for kinds, name in (
        (sections, lambda s: f"section {s}"),
        (own, lambda s: elements(tuple(mesh.elements[s].ids.tolist()))),
    ):
        for kind in sorted(set().union(*kinds) - {""}):
            rows = [i for i, each in enumerate(kinds) if kind in each]
            if all(len(kinds[i]) == 1 for i in rows):
                named[name(kind)] = rows
    parts: dict[tuple[int, ...], str] = {}
    for name, rows in named.items():
        parts.setdefault(tuple(rows), name)
    return {name: rows for rows, name in parts.items() if 0 < len(rows) < len(found)}


def _recipe(model: Reduced, candidate: Candidate, name: str, rows: list[Line], M: np.ndarray, count: int) -> Recipe:
    length, total = sum(run.length for run in rows), total_mass(model)
    m = Unknown("mass per length", "kg/m", *(BODY * total / length))
    ids = tuple(np.concatenate([run.bars.ids[run.members] for run in rows]).tolist())
    middle = np.average([np.mean(run.ends, axis=0) for run in rows], axis=0, weights=[run.length for run in rows])
    site = Site("element", ids, tuple(middle.tolist()), name)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        beams = beams_within(edit, [run.ends for run in rows])
        own = np.array([edit.values(e, "nonstructural_mass") for e in beams])
        edit.put(beams, "nonstructural_mass", own + values[0])
        edit.bind(f"added mass of {name}", beams, ("nonstructural_mass",), unit="kg/m")
        return edit.done()

    return proportional(candidate, m, 3, site, -float(np.log(count)), extend, M=M)


CANDIDATE = Candidate(
    "floor-mass",
    "added mass on a floor or a set of bars",
    "added-mass",
    "added mass per length on all bars of one level, of one section or of one entry of the deck: a slab, "
    "cladding, a load that stands there",
    recipes,
)
