"""Ends of bars that all turn against what they meet, with one stiffness: what it does to a model, and the deck with it."""

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Softening
from mouse_cli.diagnosis.effects.hinges import end_of
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import hinge
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam

_MOMENT = np.array(
    [[1.0, -1.0, 0.0], [1.0, 1.0, 0.0]]
)  # work of the moment at either end of a bar on its natural strains
_TURN = np.array(
    [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, -1.0]]
)  # of the ends of a bar, by the angles of both joints


def turned(bars: Bars, ends: np.ndarray, k: float) -> Change:
    """What joints of stiffness k do at `ends` (c, 2), bar and 0 or 1: F + sum of b'b / k, and bars turn by b F^-1 e / k there."""
    own = np.unique(ends[:, 0])
    soft = np.zeros((len(own), 2))
    soft[np.searchsorted(own, ends[:, 0]), ends[:, 1]] = 1 / k
    added, R = np.einsum("ce,ei,ej->cij", soft, _MOMENT, _MOMENT), None
    left = bars.rigid(own, added)
    lost, strain = left - bars.whole[own], bars.strain[own]
    if bars.residual is not None:
        R = bars.residual[own]
        strain = np.linalg.solve(np.eye(3) + R @ lost, strain)
    angles = soft[:, :, None] * (_MOMENT @ left @ strain)
    moved = bars.ends[own] + _TURN @ angles
    m = beam.consistent(bars.length[own]) * bars.line_mass[own][:, None, None]
    M = sum(
        np.einsum("cir,cij,cjs->rs", u, sign * m, u, optimize=True) for u, sign in ((moved, 1), (bars.ends[own], -1))
    )
    return Change(M=M, softening=Softening(own, added, R, lost))


def with_joints(problem: Problem, bars: Bars, ends: np.ndarray, name: str, k: float) -> Problem:
    """The deck with a spring (N m/rad) at each of `ends` (c, 2), all by one parameter; about both axes where both planes turn."""
    edit = Edit(problem)
    planes: dict[tuple[int, int, int], list[int]] = {}
    for bar, end in ends.tolist():
        planes.setdefault((int(bars.set[bar]), int(bars.member[bar]), end), []).append(bar)
    by_keys: dict[tuple[str, ...], list[tuple[int, int]]] = {}
    for (*_, end), own in planes.items():
        spring, soft = hinge(edit, *end_of(edit, bars, own[0], float(end)), k, other=k if len(own) > 1 else 0.0)
        by_keys.setdefault(tuple(soft), []).append(spring)
    for i, (keys, springs) in enumerate(by_keys.items()):
        if i:
            edit.follow(springs, keys)
        else:
            edit.bind(name, springs, keys, unit="N m/rad")
    return edit.done()
