"""What a model in few coordinates lacks where a part of it changes: the static flexibility that the coordinates leave out.

A softer bar changes the stiffness by L on its natural strains e = E q. Of what the coordinates leave out, x, with its
stiffness A = K - sigma M, least energy makes E x = -R L (E q + E x), R = E A^-1 E' - E V (V'A V)^-1 V'E': the bar feels
(I + R L)^-1 e, and the coordinates L (I + R L)^-1 (residual flexibility, MacNeal 1971; Craig and Kurdila 2006, ch. 17). Members
of several elements, and springs between nodes: `left_out.py`.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.strains import by_ends, sparse_rows
from mouse_cli.model.problem import Problem
from mouse_cli.terms.constraints import Motion

NUMBERS = 3e7  # in loads on all degrees of freedom, above which parts are left as the coordinates have them
_EACH = 64  # bars worked on at once


@dataclass(frozen=True)
class Static:
    """What the model does statically in all n degrees of freedom: solve, A^-1 times columns (n, c), A = K - shift M.

    bars: E A^-1 E' (b, 3, 3) of bars, and their flexibility (b, 3) there; None: there are none, or too many. modes (n, m): the
    lowest, by which members are loaded. kept: what members do, by their elements.
    """

    motion: Motion
    shift: float
    solve: Callable[[np.ndarray], np.ndarray] = field(repr=False)
    modes: np.ndarray = field(repr=False)
    bars: tuple[np.ndarray, np.ndarray] | None = None
    kept: dict = field(default_factory=dict, repr=False, compare=False)

    def left(self, bars: Bars, eigenvalues: np.ndarray) -> np.ndarray | None:
        """R (b, 3, 3) of the same bars in coordinates of these eigenvalues (r,); it follows their flexibility."""
        if self.bars is None:
            return None
        whole, flexibility = self.bars
        kept = bars.strain / (eigenvalues - self.shift) @ bars.strain.transpose(0, 2, 1)
        scale = np.sqrt(np.diagonal(bars.flexibility, axis1=1, axis2=2) / flexibility)
        return (whole - kept) * scale[:, :, None] * scale[:, None, :]


def static(
    problem: Problem,
    motion: Motion | None,
    bars: Bars | None,
    shift: float,
    solve: Callable[[np.ndarray], np.ndarray],
    modes: np.ndarray,
) -> Static | None:
    """The same; None without a mesh."""
    if motion is None:
        return None
    few = bars is not None and 3 * len(bars) * motion.n <= NUMBERS
    flexibility = np.diagonal(bars.flexibility, axis1=1, axis2=2) if few else None
    of_bars = (_strained(problem, motion, bars, solve), flexibility) if few else None
    return Static(motion, shift, solve, modes, of_bars)


def _strained(problem: Problem, motion: Motion, bars: Bars, solve: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """E A^-1 E' (b, 3, 3)."""
    whole, B = np.zeros((len(bars), 3, 3)), by_ends(problem, bars)
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
    return whole
