"""Where a model is and how it moves, for drawings: key `geometry` of documents; `shapes_by_dof` of models without positions."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Result
from mouse_cli.observables.frf import names
from mouse_cli.report.bending import bent
from mouse_cli.report.coarsened import coarsened
from mouse_cli.report.json_values import dof_name
from mouse_cli.terms.constraints import following

# That a page still draws; degrees of freedom of a shape without positions
MOST_NODES, MOST_MODES, LARGEST = 1500, 20, 140
_LOWEST = 6  # modes of a model whose test has none
_DIGITS = 4


@dataclass(frozen=True)
class Moved:
    """One mode: shape q (n,), and what sensors (s,) read of it and of the test, all at one scale; NaN where not measured."""

    mode: int
    hz: float
    q: np.ndarray
    read: np.ndarray
    test: np.ndarray


def geometry(problem: Problem, modes: Sequence[Moved] = ()) -> dict[str, Any] | None:
    """Nodes, lines, elements, sensors and `modes` of the model; None where no node has a position.

    Beyond MOST_NODES some of them are left out, see `coarsened`, and elements altogether; `of` says how many there are.
    """
    of = problem.structure.geometry
    if of is None or not len(of.node_ids):
        return None
    moves = [_nodes_of(problem, of, one.q) for one in modes]
    sensors = _sensors(problem, of)
    size = float(np.ptp(of.coordinates, axis=0).max(initial=0.0)) or 1.0
    k = len(of.node_ids)
    kept = coarsened(k, of.lines, MOST_NODES, [s["node"] for s in sensors])
    bows = None if kept.fewer else bent(problem.mesh)
    positions, elements = of.coordinates[kept.nodes], [] if kept.fewer else _elements(problem)
    shapes = [u[kept.nodes, :3] for u in moves]
    if bows:
        positions = np.vstack([positions, bows.at(positions)])
        shapes = [np.vstack([shape, bows.moved(u)]) for shape, u in zip(shapes, moves, strict=True)]
        through = bows.through(k)
        elements = [[i, *through.get(i, nodes)] for i, *nodes in elements]
    digits = max(0, _DIGITS + 1 - int(np.floor(np.log10(size))))
    readings = [s["reading"] for s in sensors]
    return {
        "unit": problem.units.length if problem.units.declared else "",
        "nodes": of.node_ids[kept.nodes],
        "positions": positions.round(digits) + 0.0,
        "lines": bows.lines(kept.lines, k) if bows else kept.lines,
        "elements": elements,
        "of": k,
        "sensors": [{"dof": s["dof"], "node": kept.index[s["node"]], "direction": s["direction"]} for s in sensors],
        "shapes": [_shape(m, u, readings) for m, u in zip(modes, shapes, strict=True) if np.abs(u).max() > 0],
    }


def shapes_by_dof(problem: Problem, modes: Sequence[Moved]) -> dict[str, Any] | None:
    """Shapes of a small model without positions, over its degrees of freedom; largest component 1."""
    n, test = problem.structure.n, problem.test
    if problem.structure.geometry is not None or n > LARGEST or not modes:
        return None
    measured = [] if test is None or test.sensing is not None else test.dofs.tolist()
    found = []
    for one in modes:
        size = np.abs(one.q).max() or 1.0
        values = dict(zip(measured, one.test / size, strict=True)) if measured else {}
        test_shape = [values.get(i, np.nan) for i in range(n)]
        shape = (one.q / size).round(_DIGITS) + 0.0
        found.append({"mode": one.mode, "hz": one.hz, "shape": shape, "test": np.round(test_shape, _DIGITS)})
    return {"dofs": [dof_name(label) for label in problem.structure.labels], "modes": found}


def moved(result: Result) -> list[Moved]:
    """The modes of the revised model that a test measured, at most MOST_MODES; its lowest ones where the test has no modes."""
    test, model = result.problem.test, result.revised
    hz = frequency_hz(np.asarray(model.eigenvalues))
    if test is None or not test.m:
        chosen = range(result.rigid_modes, min(result.rigid_modes + _LOWEST, model.shapes.shape[1]))
        return [Moved(k + 1, float(hz[k]), _turned(model.shapes[:, k]), np.zeros(0), np.zeros(0)) for k in chosen]
    found = []
    for i, k in enumerate(model.modes[:MOST_MODES].tolist()):
        q, read = model.shapes[:, k], model.model_shapes[:, i]
        have = np.isfinite(result.test_shapes[:, i]).any()
        q = q * _scale(test.read(model.shapes[:, [k]])[:, 0], read) if have else _turned(q)
        found.append(Moved(int(test.number[i]), float(hz[k]), q, read, result.test_shapes[:, i]))
    return found


def _scale(of: np.ndarray, to: np.ndarray) -> float:
    """The factor that makes `to` of `of`; 1 where there is none."""
    have = np.isfinite(of) & np.isfinite(to)
    size = float(of[have] @ of[have])
    return float(of[have] @ to[have]) / size if size > 0 else 1.0


def _turned(q: np.ndarray) -> np.ndarray:
    """q with its largest component positive: a shape has no sign of its own."""
    return q * (np.sign(q[np.abs(q).argmax()]) or 1.0)


def _nodes_of(problem: Problem, of: Geometry, q: np.ndarray) -> np.ndarray:
    """Displacements and rotations (k, 6) of the nodes, those that follow rigid links among them."""
    k = len(of.node_ids)
    if problem.mesh is None:
        u = np.zeros((k, 6))
        here = of.node >= 0
        u[of.node[here], of.direction[here]] = q[here]
        return u
    return following(problem.mesh, of).apply(q)[: 6 * k].reshape(k, 6)


def _sensors(problem: Problem, of: Geometry) -> list[dict[str, Any]]:
    """Sensors of modes and of functions: node and direction, null where a rotation is read."""
    found, test = [], problem.test
    if test is not None and test.s:
        called = test.sensors or [problem.structure.labels[d] for d in test.dofs]
        found = _placed(of, test, called)
    for each in problem.frf:
        weights = each.outputs
        at = weights if weights.ndim == 1 else abs(weights).argmax(axis=1)
        known = {one["dof"] for one in found}
        reads = _like(np.asarray(at).ravel(), None if weights.ndim == 1 else weights)
        more = _placed(of, reads, names(each)[0])
        found += [{**one, "reading": None} for one in more if one["dof"] not in known]
    return found


def _like(dofs: np.ndarray, sensing: Any) -> ModalTest:
    """A test without modes, with these sensors."""
    none = np.zeros((len(dofs), 0))
    return ModalTest(np.zeros(0, int), np.zeros(0), np.zeros(0), dofs, none, none, sensing=sensing)


def _placed(of: Geometry, test: ModalTest, called: Sequence[str]) -> list[dict[str, Any]]:
    found = []
    for i, (name, dof) in enumerate(zip(called, test.dofs.tolist(), strict=True)):
        if of.node[dof] < 0:
            continue
        weights = {dof: 1.0} if test.sensing is None else _row(test.sensing, i)
        along = np.zeros(6)
        for j, weight in weights.items():
            along[of.direction[j]] += weight
        size = float(np.linalg.norm(along[:3]))
        direction = along[:3] / size if size > 1e-9 * np.abs(along).max(initial=0.0) and size > 0 else None
        node = int(of.node[dof])
        found.append({"dof": dof_name(name), "node": node, "reading": i, "direction": direction})
    return found


def _row(matrix: Any, i: int) -> dict[int, float]:
    row = matrix[[i]].toarray()[0] if hasattr(matrix, "tocsr") else np.asarray(matrix)[i]
    return {int(j): float(row[j]) for j in np.flatnonzero(row)}


def _elements(problem: Problem) -> list[list[int]]:
    """[id, node, ...] of each element, nodes as indices into `nodes`."""
    sets = () if problem.mesh is None else problem.mesh.elements
    return [[int(i), *nodes] for each in sets for i, nodes in zip(each.ids, each.nodes.tolist(), strict=True)]


def _shape(one: Moved, u: np.ndarray, readings: list[int | None]) -> dict[str, Any]:
    """The mode with its largest displacement 1; model and test as read by the sensors, at that scale."""
    size = float(np.linalg.norm(u, axis=1).max()) or 1.0
    of = lambda values: [
        None if i is None or i >= len(values) else round(float(values[i]) / size, _DIGITS) for i in readings
    ]
    return {
        "mode": one.mode,
        "hz": one.hz,
        "displacements": (u / size).round(_DIGITS) + 0.0,
        "model": of(one.read),
        "test": of(one.test),
    }
