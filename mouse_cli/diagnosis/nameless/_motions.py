"""How the parts of a structure move: the cells of a change of rank one along a motion of the whole that is unknown."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_rows
from mouse_cli.diagnosis.sites.points import named_dof, wanted
from mouse_cli.model.site import Site


@dataclass(frozen=True)
class Motions:
    """Rows of motion (c, r): of the middle of each bar across it, or of degrees of freedom, `dofs` (c,). at (c, d) is in `unit`.

    shares (c,): of the length, or all alike.
    """

    sites: list[Site]
    at: np.ndarray
    unit: str
    rows: np.ndarray
    shares: np.ndarray
    dofs: np.ndarray | None = None

    def cells(self, model: Reduced, weights: np.ndarray, extend: Callable | None) -> Cells | None:
        """Cells in K whose rows have the `weights` (c,); extend: as in `of_rows`, for models of matrices."""
        put = extend if self.dofs is not None and of_matrices(model.problem) else None
        return of_rows(model, self.sites, self.at, self.unit, self.rows, weights**2, "K", put)


def motions(model: Reduced) -> Motions | None:
    """Of bars where there are any, else of degrees of freedom; None of too few bars."""
    bars = model.bars
    if of_matrices(model.problem) or bars is None:
        own = translations(model)
        sites = [named_dof(model.problem.structure, int(i)) for i in own]
        shares = np.full(len(own), 1 / max(len(own), 1))
        return Motions(sites, own[:, None].astype(float), "degrees of freedom", model.V[own], shares, own)
    if len(bars) < FEWEST:
        return None
    rows = np.stack([bars.deflection(i, 0.5) for i in range(len(bars))])
    sites = [bars.site(i, 0.5) for i in range(len(bars))]
    at = bars.start + 0.5 * bars.length[:, None] * bars.axis
    return Motions(sites, at, "m", rows, bars.length / bars.length.sum())


def translations(model: Reduced) -> np.ndarray:
    """Degrees of freedom (c,) that are worth looking at and do not turn."""
    structure, keep = model.problem.structure, wanted(model)
    own = np.arange(structure.n) if keep is None else np.flatnonzero(keep)
    return own if structure.geometry is None else own[structure.geometry.direction[own] < 3]
