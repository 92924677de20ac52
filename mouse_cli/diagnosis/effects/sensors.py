"""Sensors that read something else than the deck says, and decks whose sensors read what they do."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.problem import Problem

_SHIFT = 1e-3  # of a row of bars, for derivatives along it
_MOST = 24  # sensors that are suspected: those that fit worst


def worst_sensors(model: Reduced, most: int = _MOST) -> list[int]:
    """Sensors (from 0) whose shapes the model misses most, the worst first; those of fewer than two modes tell nothing."""
    data = model.data
    at = Model(model).point(model.z)
    known = np.flatnonzero(data.has_shape.sum(axis=1) >= 2)
    if at is None or not len(known):
        return []
    off = np.zeros(data.has_shape.shape)
    off[data.has_shape] = at.residual[int(data.has_frequency.sum()) :]
    size = (off**2).sum(axis=1)
    return known[np.argsort(-size[known], kind="stable")][:most].tolist()


def regressed(model: Reduced, k: int, limits: tuple[float, float]) -> float:
    """The multiple of what the model lets sensor k read that comes nearest to its readings, within limits."""
    at, data = Model(model).point(model.z), model.data
    if at is None:
        return 1.0
    known = data.has_shape[k]
    read, w = at.a[known] * at.measured(at.seen)[k, known], 1 / data.test.shape_sd[k, known]
    gain = float(np.sum(w * w * read * data.test.shapes[k, known]) / max(np.sum((w * read) ** 2), 1e-300))
    return float(np.clip(gain, *limits))


def share(model: Reduced) -> float:
    """ln of the share of one sensor in the prior of all."""
    return -float(np.log(max(model.data.test.s, 1)))


def changed(model: Reduced, rows: dict[int, np.ndarray]) -> np.ndarray:
    """Change of sensing (s, r) when sensors read `rows` (r,) instead."""
    found = np.zeros(model.sensing.shape)
    for k, row in rows.items():
        found[k] = row - model.sensing[k]
    return found


def name(problem: Problem, k: int) -> str:
    """How the deck calls a sensor."""
    test, labels = problem.test, problem.structure.labels
    return test.sensors[k] if test.sensors else _plain(labels, int(test.dofs[k]))


def _plain(labels: tuple[str, ...], dof: int) -> str:
    return labels[dof] if labels[dof][-2:] in DIRECTIONS else str(dof + 1)


def site(problem: Problem, *which: int) -> Site:
    """Sensors in words."""
    names = tuple(name(problem, k) for k in which)
    return Site("sensor", names, None, f"sensor{'s' if len(names) > 1 else ''} {' and '.join(names)}")


def readings(test: ModalTest, n: int) -> np.ndarray:
    """Weights of the sensors (s, n), sparse."""
    from scipy.sparse import csr_array

    if test.sensing is not None:
        return csr_array(test.sensing)
    return csr_array((np.ones(test.s), (np.arange(test.s), test.dofs)), shape=(test.s, n))


def misread(
    model: Reduced,
    candidate: Any,
    rows: dict[int, np.ndarray],
    log_prior: float,
    extend: Callable[[Problem], Problem],
    how: str = "",
) -> Recipe:
    """Sensors that read `rows` (r,) instead, by a fault without a size; how: what is said of them beside their names."""
    sensing, where = changed(model, rows), site(model.problem, *rows)
    where = replace(where, text=f"{where.text}, {how}") if how else where
    nothing = np.zeros((1, 0))
    change = lambda values: Change(sensing=sensing)
    return Recipe(candidate, (), change, nothing, lambda values: where, 0, log_prior, lambda deck, values: extend(deck))


def with_readings(problem: Problem, rows: dict[int, np.ndarray]) -> Problem:
    """The deck with sensors that read `rows` (n,) instead; each keeps its name and says that it was corrected."""
    from scipy.sparse import csr_array, vstack

    test, n = problem.test, problem.structure.n
    weights = readings(test, n)
    parts = [csr_array(rows[k][None]) if k in rows else weights[[k]] for k in range(test.s)]
    names = [f"{name(problem, k)} corrected" if k in rows else name(problem, k) for k in range(test.s)]
    sensing = csr_array(vstack(parts))
    sensing.eliminate_zeros()
    dofs = [int(np.argmax(np.abs(rows[k]))) if k in rows else int(test.dofs[k]) for k in range(test.s)]
    test = replace(test, dofs=np.array(dofs), sensing=sensing, sensors=tuple(names))
    return replace(problem, test=test, frf=_in_functions(problem, rows))


def _in_functions(problem: Problem, rows: dict[int, np.ndarray]) -> tuple[FrfTest, ...]:
    """The functions of the deck, responses of the sensors in `rows` read as these (n,) instead."""
    from scipy.sparse import csr_array, vstack

    n, found = problem.structure.n, []
    known = [(csr_array(row(problem, k)[None]), csr_array(new[None])) for k, new in rows.items()]
    for test in problem.frf:
        outputs = test.outputs
        if outputs.ndim == 1:
            outputs = csr_array((np.ones(len(outputs)), (np.arange(len(outputs)), outputs)), shape=(len(outputs), n))
        parts = [csr_array(outputs)[[o]] for o in range(outputs.shape[0])]
        parts = [next((new for old, new in known if not abs(part - old).sum()), part) for part in parts]
        found.append(replace(test, outputs=csr_array(vstack(parts))))
    return tuple(found)


def row(problem: Problem, k: int) -> np.ndarray:
    """What a sensor reads of the degrees of freedom (n,)."""
    weights = readings(problem.test, problem.structure.n)[[k]]
    return weights.toarray()[0] if is_sparse(weights) else weights[0]


def row_of_sensor(model: Reduced, k: int) -> tuple[Line, float, np.ndarray] | None:
    """The row of bars, the distance along it and the direction (3,) of what a sensor reads."""
    at, bars, weights = model.problem.structure.geometry, model.bars, row(model.problem, k)
    node = int(at.node[model.problem.test.dofs[k]])
    direction = np.array([weights[(at.direction == d) & (at.node >= 0)].sum() for d in range(3)])
    if node < 0 or not direction.any():
        return None
    best, found = np.inf, None
    for run in bars.runs:
        ends = bars.nodes[run.members]
        axis = bars.axis[run.members[0]]
        along = abs(axis @ direction) / np.linalg.norm(direction)
        for i, end in np.argwhere(ends == node)[:1].tolist():
            if along < min(best, 0.9):
                bar = run.members[i]
                best, found = along, (run, float(bars.before[bar] + end * bars.length[bar]), direction)
    return found


def sliding(model: Reduced) -> np.ndarray:
    """What sensors would read (s, r) of the motion along their rows of bars, for a shift by a whole row; else 0."""
    found = np.zeros(model.sensing.shape)
    for k in range(len(found)) if model.bars is not None else ():
        on = row_of_sensor(model, k)
        if on is not None:
            run, s, direction = on
            first, last = np.clip([s - _SHIFT * run.length, s + _SHIFT * run.length], 0.0, run.length)
            moved = model.bars.motion(*run.at(last)) - model.bars.motion(*run.at(first))
            found[k] = direction @ moved * run.length / (last - first)
    return found


def exchanged(problem: Problem, i: int, j: int) -> Problem:
    """The deck with the places of two sensors exchanged."""
    test, order = problem.test, np.arange(problem.test.s)
    order[[i, j]] = j, i
    sensing = None if test.sensing is None else test.sensing[order]
    names = tuple(test.sensors[k] for k in order) if test.sensors else ()
    functions = _in_functions(problem, {i: row(problem, j), j: row(problem, i)})
    return replace(problem, test=replace(test, dofs=test.dofs[order], sensing=sensing, sensors=names), frf=functions)
