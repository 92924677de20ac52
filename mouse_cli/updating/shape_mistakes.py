"""Shapes that are unlike those of the model as they are read, and like them in another reading of the sensors."""

import re
from collections.abc import Iterator

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.dynamics.correlation import mac, pair
from mouse_cli.dynamics.eigen import RIGID, EigenSolution
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem
from mouse_cli.updating.state import reference_eigenvalue

_FEWEST = 4, 2  # sensors and modes: fewer are like anything in some reading
_UNLIKE = 0.7  # mean MAC as read, below which another reading is thought of
_WITHOUT_SIGNS = 0.9  # the same, where no component is negative
_LIKE, _EACH = 0.95, 0.9  # mean MAC and MAC of each mode that the reading must give
_FACTORS = ((1e3, "in mm beside m"), (1e-3, "in m beside mm"), (9.80665, "in m/s2 beside g"), (1 / 9.80665, "in g beside m/s2"),
            (25.4, "in mm beside in"), (1 / 25.4, "in in beside mm"))  # fmt: skip
_Reading = tuple[np.ndarray, np.ndarray, str, str]  # shapes of the test and of the model, what is said, what to do


def check(problem: Problem, solution: EigenSolution) -> None:
    """Raise DeckError (MD454) where the shapes fit the model in one other reading alone."""
    test = problem.test
    if test.s < _FEWEST[0] or test.m < _FEWEST[1] or not np.isfinite(test.shapes).all():
        return
    reach = min(solution.shapes.shape[1], 2 * int(test.number.max(initial=0)) + 6)
    phi, hz = solution.shapes[:, :reach], solution.frequencies_hz[:reach].copy()
    hz[solution.eigenvalues[:reach] <= RIGID * reference_eigenvalue(problem, solution.eigenvalues)] = 0.0
    before = _mac_of_pairs(test.frequency_hz, hz, test.shapes, test.read(phi))
    positive = bool((test.shapes >= 0).all())
    if before.mean() >= (_WITHOUT_SIGNS if positive else _UNLIKE):
        return
    found = []
    for x, read, said, help in _readings(problem, phi, positive):
        each = _mac_of_pairs(test.frequency_hz, hz, x, read)
        if each.mean() >= _LIKE and each.min() >= _EACH:
            found.append((each.mean(), said, help))
    if found:
        mean, said, help = max(found)
        message = f"the shapes are like those of the model by a mean MAC of {before.mean():.2f}; {said}, by {mean:.2f}"
        raise DeckError.of("MD454", message, problem.place(f"mode {test.number[0]}"), help=help)


def _mac_of_pairs(frequency_hz: np.ndarray, hz: np.ndarray, x: np.ndarray, read: np.ndarray) -> np.ndarray:
    """MAC (m,) of each measured mode and its partner."""
    return mac(x, read[:, pair(x, frequency_hz, read, hz)]).diagonal()


def _readings(problem: Problem, phi: np.ndarray, positive: bool) -> Iterator[_Reading]:
    test, read = problem.test, problem.test.read(phi)
    if positive:
        help = "give the shapes with their signs: amplitude and phase, or real and imag, of each mode"
        yield test.shapes, np.abs(read), "without signs", help
        return
    names = test.sensors or tuple(problem.structure.labels[i] for i in test.dofs)
    groups = {name: [i] for i, name in enumerate(names)}
    for i, name in enumerate(names):
        groups.setdefault(f"all in {name[-2:]}", []).append(i)
    for called, rows in groups.items():
        for factor, said in _FACTORS:
            x = test.shapes.copy()
            x[rows] /= factor
            one = f"with the shapes at {called} divided by {factor:.6g} ({said})"
            yield x, read, one, "give the shapes of all sensors in one unit"
    if test.sensing is None:
        yield from _placed(problem, phi, names)


def _placed(problem: Problem, phi: np.ndarray, names: tuple[str, ...]) -> Iterator[_Reading]:
    """Directions exchanged, and numbers of nodes one off."""
    place = {label: i for i, label in enumerate(problem.structure.labels)}
    parsed = [re.fullmatch("([0-9]+)([TR][XYZ])", name) for name in names]
    if not all(parsed):
        return
    turned = [(a, b) for i, a in enumerate("XYZ") for b in "XYZ"[i + 1 :]]
    turns = {f"with {a} and {b} exchanged": {f"{t}{a}": f"{t}{b}" for t in "TR"} | {f"{t}{b}": f"{t}{a}" for t in "TR"}
             for a, b in turned}  # fmt: skip
    moves = [(said, {d: d for d in DIRECTIONS} | to, 0) for said, to in turns.items()]
    moves += [(f"with every node {by:+d}", {d: d for d in DIRECTIONS}, by) for by in (-1, 1)]
    for said, to, by in moves:
        rows = [place.get(f"{int(each[1]) + by}{to[each[2]]}") for each in parsed]
        if None not in rows:
            yield problem.test.shapes, phi[rows], said, "mend the directions or the numbers of the nodes of the sensors"
