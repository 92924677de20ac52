"""What strains of bars a model in few coordinates lacks: the static flexibility that it leaves out.

A bar that gives way changes the stiffness by L on its natural strains e = E q. Of what the coordinates leave out, x, with its
stiffness A = K - sigma M, least energy makes E x = -R L (E q + E x), R = E A^-1 E' - E V (V'A V)^-1 V'E': the bar feels
(I + R L)^-1 e, and the coordinates L (I + R L)^-1 (residual flexibility, MacNeal 1971; Craig and Kurdila 2006, ch. 17).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.strains import natural, sparse_rows
from mouse_cli.model.problem import Problem
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.elements import Layout
from mouse_cli.terms.elements import _beam as beam

_NUMBERS = 3e7  # in loads on all degrees of freedom, above which bars are left as the coordinates have them
_EACH = 64  # bars worked on at once


@dataclass(frozen=True)
class Static:
    """E A^-1 E' (b, 3, 3) of bars by all degrees of freedom, A = K - shift M; and their flexibility (b, 3) there."""

    whole: np.ndarray
    shift: float
    flexibility: np.ndarray

    def left(self, bars: Bars, eigenvalues: np.ndarray) -> np.ndarray:
        """R (b, 3, 3) of the same bars in coordinates of these eigenvalues (r,); it follows their flexibility."""
        kept = bars.strain / (eigenvalues - self.shift) @ bars.strain.transpose(0, 2, 1)
        scale = np.sqrt(np.diagonal(bars.flexibility, axis1=1, axis2=2) / self.flexibility)
        return (self.whole - kept) * scale[:, :, None] * scale[:, None, :]


def static(
    problem: Problem, motion: Motion, bars: Bars | None, shift: float, solve: Callable[[np.ndarray], np.ndarray]
) -> Static | None:
    """The same by `solve`, A^-1 times columns (n, c); None where there are no bars, or too many."""
    if bars is None or 3 * len(bars) * motion.n > _NUMBERS:
        return None
    whole, B = np.zeros((len(bars), 3, 3)), _strains(problem, bars)
    for first in range(0, len(bars), _EACH):
        own = slice(first, first + _EACH)
        places = (6 * bars.nodes[own, :, None] + np.arange(6)).ravel()
        rows = sparse_rows(motion, places)
        loads = np.zeros((motion.n, len(B[own]), 3))
        for i, strains in enumerate(B[own]):
            loads[:, i] = (strains @ rows[12 * i : 12 * i + 12].toarray()).T
        moved = rows @ solve(loads.reshape(motion.n, -1))
        at = np.arange(len(B[own]))
        whole[own] = B[own] @ moved.reshape(len(at), 12, len(at), 3)[at, :, at]
    return Static(whole, shift, np.diagonal(bars.flexibility, axis1=1, axis2=2))


def _strains(problem: Problem, bars: Bars) -> np.ndarray:
    """Natural strains (b, 3, 12) for each direction of both nodes."""
    B = np.zeros((len(bars), 3, 12))
    for number in np.unique(bars.set).tolist():
        elements = problem.mesh.elements[number]
        local = beam.span(Layout(problem.mesh.coordinates[elements.nodes], dict(elements.options))).motion
        for plane, (dofs, sense) in enumerate(beam.PLANES):
            own = (bars.set == number) & (bars.plane == plane)
            there = local[bars.member[own]]
            B[own] = natural(there[:, dofs] * sense[:, None], there[:, [0, 6]], bars.length[own])
    return B
