"""Mass along the bars of one floor or storey, of one section or of one entry of the deck."""

from functools import lru_cache
from itertools import groupby
from operator import itemgetter

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.effects.line_mass import uniform
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.line_mass import add_line_mass, may_bear_more
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.diagnosis.sites.lines import elements as in_words
from mouse_cli.diagnosis.sites.members import STOREY, Element, members, upward
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

_MOST = 32  # floors, sections, entries and parts of storeys
_LEVEL = 1e-3  # of the height of the structure


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """M + m times the integral of u'u over some of the bars, not all of them."""
    found = [] if model.bars is None else list(model.bars.runs)
    if len(found) < 2 or not all(may_bear_more(model.problem, run) for run in found):
        return []
    bar_of = {at: bar for run in found for at, bar in zip(_elements(run), run.members.tolist(), strict=True)}
    parts = _parts(model, found, set(bar_of))
    of_bar = lru_cache(None)(lambda bar: uniform(model.bars, bar))
    made = []
    for own, name in parts[:_MOST]:
        bars = [bar_of[at] for at in own]
        made.append(_recipe(model, candidate, name, own, model.bars.length[bars], sum(map(of_bar, bars)), len(parts)))
    return made


def _elements(run: Line) -> list[Element]:
    """Elements of the bars of a row."""
    return list(zip(run.bars.set[run.members].tolist(), run.bars.member[run.members].tolist(), strict=True))


def _parts(model: Reduced, found: list[Line], every: set[Element]) -> list[tuple[tuple[Element, ...], str]]:
    """Elements of each floor, section and entry, and columns, braces and beams of a storey, with their names; each choice once, and
    none that is all.
    """
    mesh, up, named = model.problem.mesh, upward(model.problem.mesh), {}
    height = float(np.ptp(mesh.coordinates[:, up])) or 1.0
    for run in found:
        low, high = (float(end[up]) for end in run.ends)
        if abs(high - low) < _LEVEL * height:
            named.setdefault(f"the floor at {'XYZ'[up]} = {round(low, 3):g} m", []).extend(_elements(run))
    entries = {s: list(own) for s, own in groupby(sorted(every), key=itemgetter(0))}
    for s, own in entries.items():
        if section := mesh.elements[s].origin.get("A", ""):
            named.setdefault(f"section {section}", []).extend(own)
    for member in members(mesh):
        if member.kind == STOREY and every.issuperset(member.elements):
            named[member.site.text] = list(member.elements)
    named |= {in_words(tuple(mesh.elements[s].ids.tolist())): own for s, own in entries.items()}
    parts: dict[tuple[Element, ...], str] = {}
    for name, own in named.items():
        if 0 < len(own) < len(every):
            parts.setdefault(tuple(sorted(own)), name)
    return list(parts.items())


def _recipe(
    model: Reduced,
    candidate: Candidate,
    name: str,
    own: tuple[Element, ...],
    lengths: np.ndarray,
    M: np.ndarray,
    count: int,
) -> Recipe:
    """lengths (e,) of the elements `own`; M (r, r) of one unit per length on them; count: of all such sets."""
    mesh = model.problem.mesh
    m = Unknown("mass per length", "kg/m", *(BODY * total_mass(model) / lengths.sum()))
    ids = tuple(int(mesh.elements[s].ids[i]) for s, i in own)
    ends = [mesh.coordinates[mesh.elements[s].nodes[i]] for s, i in own]
    site = Site("element", ids, tuple(np.average(np.mean(ends, axis=1), axis=0, weights=lengths).tolist()), name)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        add_line_mass(edit, beams_within(edit, ends), f"added mass of {name}", values[0])
        return edit.done()

    return proportional(candidate, m, 3, site, -float(np.log(count)), extend, M=M)


CANDIDATE = Candidate(
    "floor-mass",
    "added mass on a floor or a set of bars",
    "added-mass",
    "added mass per length on all bars of one level, of one section or of one entry of the deck, or on the columns, braces or "
    "beams of one storey: a slab, cladding, ice, marine growth, a load that stands there",
    recipes,
)
