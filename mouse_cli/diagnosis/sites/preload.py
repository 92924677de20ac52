"""Axial forces in straight rows of bars."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import beams_within
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.lines import Line, elements, whole
from mouse_cli.diagnosis.sites.points import wanted
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.groups import enumerated
from mouse_cli.model.problem import Problem
from mouse_cli.terms.element_term import ElementTerm
from mouse_cli.terms.elements import _beam as beam

_FEW = 3  # rows that are named one by one
_ONE = 6  # decimals of the size of the structure to which lengths and levels are one


def runs(model: Reduced, *bound: str, multiplied: bool = False) -> list[Line]:
    """Rows of bars that are worth looking at, and that no parameter gives a property of `bound` already; multiplied: or is a factor
    of it.
    """
    bars, keep, found = model.bars, wanted(model), []
    taken = {
        (b.set, int(i)) for b in model.problem.bindings if b.property in bound and not (multiplied and b.factor) for i in b.members
    }
    for run in () if bars is None else bars.runs:
        own = zip(bars.set[run.members].tolist(), bars.member[run.members].tolist(), strict=True)
        if not taken & set(own) and (keep is None or keep[bars.nodes[run.members]].any()):
            found.append(run)
    return found


def site_of(model: Reduced, run: Line) -> Site:
    """A row of bars in words."""
    ids = tuple(model.bars.ids[run.members].tolist())
    return Site("element", ids, None, elements(ids))


def resistance(EI: np.ndarray, tension: np.ndarray, length: float) -> float:
    """EI / l^2 + T / pi^2 (N) of bars (c,) as they are: a pull changes their lowest mode by what it is of this, over pi^2.

    A cable resists by its tension T alone, which in EI / l^2 is ten thousand; compression takes nothing off.
    """
    return float(EI.mean()) / length**2 + max(float(tension.mean()), 0.0) / np.pi**2


def tensions(model: Reduced) -> np.ndarray:
    """Axial force (b,) of bars in the deck: their preload, and what gravity brings about."""
    mesh, bars = model.problem.mesh, model.bars
    force = [np.array(np.broadcast_to(each.properties.get("preload", 0.0), len(each)), float) for each in mesh.elements]
    terms = [term for term in model.problem.terms if isinstance(term, ElementTerm)]
    for g, term in enumerate(terms):
        if term.axial is not None:
            for (s, i), own in zip(zip(*mesh.gathered.origin(g), strict=True), term.axial, strict=True):
                force[s][i] += own
    return np.array([force[s][i] for s, i in zip(bars.set.tolist(), bars.member.tolist(), strict=True)])


def preloads(model: Reduced, candidate: Candidate, sign: int) -> list[Recipe]:
    """K + T Kg, T of the given sign, for each straight row of bars, and for rows side by side, all alike: half of the prior each.
    """
    single = [[run] for run in runs(model, "preload")]
    tension = tensions(model) if single else np.zeros(0)
    alike = side_by_side([run for run, in single])
    return [
        _recipe(model, candidate, rows, sign, len(kind) * (1 + bool(alike)), tension) for kind in (single, alike) for rows in kind
    ]


def side_by_side(found: list[Line]) -> list[list[Line]]:
    """Rows of one direction and length, two or more, that begin at one level along it: columns of a storey, legs."""
    by: dict[tuple, list[Line]] = {}
    for run in found:
        first, last = sorted(each.tolist() for each in run.ends)
        along, size = np.subtract(last, first), float(np.ptp(run.bars.start, axis=0).max())
        by.setdefault(tuple(np.round(np.append(along, along @ first / run.length) / size, _ONE)), []).append(run)
    return [rows for rows in by.values() if len(rows) > 1]


def _recipe(
    model: Reduced, candidate: Candidate, rows: list[Line], sign: int, count: int, tension: np.ndarray
) -> Recipe:
    """Of rows that have one force."""
    bars, own = model.bars, np.concatenate([run.members for run in rows])
    members = np.concatenate([whole(run) for run in rows])
    _, slope, _ = beam.shapes(bars.length[members], bars.phi[members])
    Kg = sign * bars.added(beam.integral(slope, bars.length[members]), members)
    scale = resistance(bars.EI[own], tension[own], rows[0].length)
    T = Unknown("force", "N", 0.03 * scale, 30 * scale)
    site = site_of(model, rows[0]) if len(rows) == 1 else _of_several(model, rows)

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        beams = beams_within(edit, [run.ends for run in rows])
        edit.put(beams, "preload", np.array([edit.values(e, "preload") for e in beams]) + sign * values[0])
        edit.bind(f"axial force of {site.text}", beams, ("preload",), unit="N")
        return edit.done()

    return proportional(candidate, T, 6, site, -float(np.log(count)), extend, K=Kg)


def _of_several(model: Reduced, rows: list[Line]) -> Site:
    """Rows of bars in words."""
    ids = [tuple(model.bars.ids[run.members].tolist()) for run in rows]
    every = tuple(i for own in ids for i in own)
    text = enumerated([elements(own) for own in ids]) if len(rows) <= _FEW else elements(every)
    return Site("element", every, None, f"{text}, all alike")
