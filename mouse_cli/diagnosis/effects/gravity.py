"""What weight does to stiffness (P-delta): of a mesh by its axial forces, of a chain of masses by the mass above each spring."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, proportional
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.matrices import Entries, of_matrices, with_entries
from mouse_cli.diagnosis.extend.points import found
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem

G = 9.80665  # m/s2
_STOREYS, _BARS = (0.3, 3.0), (0.9, 1.1)  # effective heights are anybody's guess; of bars all is known but the mass
_NOTHING = 1e-6  # share of an eigenvalue that a change must move to matter
_LARGEST = 400  # degrees of freedom up to which a model of matrices is looked at as a chain
_AXES = (("-Z", (0, 0, -1)), ("-Y", (0, -1, 0)), ("-X", (-1, 0, 0)), ("+X", (1, 0, 0)), ("+Y", (0, 1, 0)))


def self_weight(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """The recipes of a mesh that does not know gravity yet, one for each direction that may be down, or of a chain."""
    if of_matrices(model.problem):
        return _chain(model, candidate, (0.03 * lowest(model), 10.0 * lowest(model)))
    if (h := _storey(model.problem)) is not None:
        return _chain(model, candidate, tuple(G / model.problem.units.metre / h * np.array(_STOREYS)))
    if model.problem.mesh.gravity is not None or not len(model.problem.mesh.supports):
        return []
    softer = [(name, Kg) for name, down in _downward(model) if (Kg := _softening(model, down)) is not None]
    return [_under(model, candidate, name, Kg, len(softer)) for name, Kg in softer]


def _storey(problem: Problem) -> float | None:
    """Mean height of storeys: point masses on springs one above another that move across, in units of the deck; None for others."""
    mesh, at = problem.mesh, problem.structure.geometry
    if mesh.gravity is not None or {each.type for each in mesh.elements} != {"mass", "spring"}:
        return None
    extent = np.ptp(at.coordinates, axis=0)
    up = int(np.argmax(extent))
    straight = np.delete(extent, up).max() <= _NOTHING * extent[up]
    across = np.unique(at.direction).size == 1 and int(at.direction[0]) not in (up, up + 3)
    return float(extent[up] / (len(at.coordinates) - 1)) if straight and across and extent[up] > 0 else None


def _downward(model: Reduced) -> list[tuple[str, tuple[int, int, int]]]:
    """Directions that may be down: -Z where the structure has height along Z, else those of its own extent."""
    extent = np.ptp(model.problem.mesh.coordinates, axis=0) > 0
    if extent[2]:
        return [_AXES[0]]
    return [axis for axis in _AXES if np.abs(axis[1]) @ extent]


def _softening(model: Reduced, down: tuple[int, int, int]) -> np.ndarray | None:
    """V' Kg V (r, r) for 9.81 m/s2 along `down`; None where that does nothing or nothing carries the weight."""
    from mouse_cli.terms.faults import MeshFault

    try:
        _, total = model.once(("gravity", down), lambda problem: _with_gravity(problem, down, 1.0))
        K, _ = total.matrices(model.theta)
    except (MeshFault, np.linalg.LinAlgError):
        return None
    before, _ = model.assembly.matrices(model.theta)
    Kg = model.project(K - before)
    count = model.low_modes()
    return Kg if np.abs(Kg[:count, :count]).max() > _NOTHING * lowest(model) else None


def _with_gravity(problem: Problem, down: tuple[int, int, int], factor: float) -> Problem:
    edit = Edit(problem)
    edit.gravity = factor * G / problem.units.metre * np.array(down, float)
    return edit.done()


def _under(model: Reduced, candidate: Candidate, name: str, Kg: np.ndarray, count: int) -> Recipe:
    down = dict(_AXES)[name]
    stacked = any(each.type == "storey" for each in model.problem.mesh.elements)
    factor = Unknown("times 9.81 m/s2", "1", *(_STOREYS if stacked else _BARS))

    def site(values: np.ndarray) -> Site:
        tall = f", as if storeys were {1 / values[0]:.3g} times as high as in the deck" if stacked else ""
        return Site("structure", text=f"the whole structure, downward {name}{tall}")

    extend = lambda problem, values: _with_gravity(problem, down, values[0])
    return proportional(candidate, factor, 3, site, -float(np.log(count)), extend, K=Kg)


def _chain(model: Reduced, candidate: Candidate, ends: tuple[float, float]) -> list[Recipe]:
    """K - a sum M_above,i b_i b_i', b_i the drift of storey i, for springs in a row on the ground: a = g / h within `ends`."""
    entries = _above(model)
    if entries is None:
        return []
    row, col, value = entries
    n = model.problem.structure.n
    Kg = np.zeros((n, n))
    Kg[row, col] = Kg[col, row] = value
    a = Unknown("g / h", "1/s2", *ends)

    def site(values: np.ndarray) -> Site:
        h = G / values[0]  # rigid storeys are h high, those whose columns bend between floors that do not turn 6/5 h
        return Site("structure", text=f"the whole structure, as if its storeys were {h:.3g} to {1.2 * h:.3g} m high")

    extend = lambda problem, values: with_entries(problem, found("gravity g / h", values[0], "1/s2"), K=entries)
    return [proportional(candidate, a, 6, site, 0.0, extend, K=model.project(Kg))]


def _above(model: Reduced) -> Entries | None:
    """-sum M_above,i b_i b_i' (upper triangle) of a row of springs that stands on the ground; None for other models."""
    n = model.problem.structure.n
    if n > _LARGEST or (of_matrices(model.problem) and model.problem.structure.geometry is not None):
        return None
    K, M = (dense(part) for part in model.assembly.matrices(model.theta))
    size = np.abs(K).max()
    apart = np.abs(np.subtract.outer(range(n), range(n)))
    if np.abs(K[apart > 1]).max(initial=0) > 1e-9 * size or (np.diag(K, 1) >= -1e-9 * size).any():
        return None
    grounded = np.abs(K.sum(axis=1)) > 1e-6 * size
    if grounded.sum() != 1 or not grounded[[0, -1]].any() or n < 2:
        return None
    order = np.arange(n) if grounded[0] else np.arange(n)[::-1]
    above = np.cumsum(M.sum(axis=1)[order][::-1])[::-1]
    diagonal = -above - np.append(above[1:], 0.0)
    lower, upper = np.minimum(order[:-1], order[1:]), np.maximum(order[:-1], order[1:])
    return np.append(order, lower), np.append(order, upper), np.append(diagonal, above[1:])
