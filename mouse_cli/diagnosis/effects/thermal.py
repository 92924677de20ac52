"""Axial forces that one change of temperature makes in the bars of a frame, by statics."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam
from mouse_cli.terms.faults import NoLoadPath
from mouse_cli.terms.gravity import displacements

_STRAIN = 1.5e-3  # free expansion of steel by 125 K
_BUCKLES = 0.95  # share of the strain that makes the structure buckle
_LEAST = 1e-2  # of the largest strain, the least
_FREE = 1e-6  # share of E A below which no force is one
_RIGID = 1e-6  # of the eigenvalue of the lowest measured mode, below which nothing resists a motion


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + s sum N_e Kg_e, N_e the forces in equilibrium for a unit of free expansion s: heated, and cooled.

    One straight row of bars has but one force, which `tension` and `compression` are. Forces in equilibrium do no work on a motion
    that nothing resists: where those of the bars do, rigid links hold them, which in truth expand too.
    """
    bars, mesh = model.bars, model.problem.mesh
    if bars is None or len(bars.runs) < 2 or any(b.property == "preload" for b in model.problem.bindings):
        return []
    if any(each.type == "rod" or each.options.get("offsets") for each in mesh.elements):
        return []
    forces = _forces(model)
    if forces is None:
        return []
    _, slope, _ = beam.shapes(bars.length, bars.phi)
    Kg = bars.added(forces[:, None, None] * beam.integral(slope, bars.length))
    elastic = model.eigenvalues > _RIGID * lowest(model)
    if _STRAIN * np.abs(Kg[np.ix_(~elastic, ~elastic)]).max(initial=0.0) > _RIGID * lowest(model):
        return []
    size = np.sqrt(model.eigenvalues[elastic])
    softer = -np.linalg.eigvalsh(Kg[np.ix_(elastic, elastic)] / np.outer(size, size))
    found = []
    for sign in (1, -1):
        buckles = (sign * softer).max()
        most = min(_STRAIN, _BUCKLES / buckles) if buckles > 0 else _STRAIN
        found.append(_recipe(model, candidate, forces, sign, Kg, most))
    return found


def _forces(model: Reduced) -> np.ndarray | None:
    """Tension (b,) of the bars for a free expansion of 1; None where all of them may expand."""
    from scipy.sparse import csr_array

    bars, motion = model.bars, model.motion
    first = np.array([bars.twins[int(s), int(i)][0] for s, i in zip(bars.set, bars.member, strict=True)])
    own, back = np.unique(first, return_inverse=True)
    T = csr_array((motion.factor, motion.dof, motion.start), shape=(len(motion.start) - 1, motion.n))
    stretch = sum(
        sign * (csr_array((bars.axis[own, d], (range(len(own)), range(len(own))))) @ T[6 * bars.nodes[own, end] + d])
        for end, sign in ((0, -1), (1, 1))
        for d in range(3)
    )
    EA = bars.E[own] * bars.A[own]
    K, _ = model.assembly.matrices(model.theta)
    try:
        u = displacements(K, stretch.T @ EA)
    except (NoLoadPath, np.linalg.LinAlgError):
        return None
    force = EA * ((stretch @ u) / bars.length[own] - 1)
    return force[back] if np.abs(force / EA).max() > _FREE else None


def _recipe(model: Reduced, candidate: Candidate, forces: np.ndarray, sign: int, Kg: np.ndarray, most: float) -> Recipe:
    strain = Unknown("free expansion" if sign > 0 else "free contraction", "1", _LEAST * most, most)
    bars, site = model.bars, Site("structure", text=f"all bars, {'heated' if sign > 0 else 'cooled'}")
    axial = dict(zip(zip(bars.set.tolist(), bars.ids.tolist(), strict=True), sign * forces, strict=True))

    def extend(problem: Problem, values: np.ndarray) -> Problem:
        edit = Edit(problem)
        beams = [edit.element(number) for _, number in axial]
        added = values[0] * np.array(list(axial.values()))
        edit.put(beams, "preload", np.array([edit.values(e, "preload") for e in beams]) + added)
        edit.bind("axial forces by temperature", beams, ("preload",), factor=1.0)
        return edit.done()

    return proportional(candidate, strain, 4, site, -float(np.log(2)), extend, K=sign * Kg)
