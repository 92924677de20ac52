"""How the parts of a structure move: the cells of a change of rank one along a motion of the whole that is unknown."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_rows
from mouse_cli.diagnosis.sites.bases import axes
from mouse_cli.diagnosis.sites.points import named_dof, wanted
from mouse_cli.model.site import Site


@dataclass(frozen=True)
class Motions:
    """Rows of motion (c, r): of the middle of each bar across it, or of degrees of freedom, `dofs` (c,). at (c, d) is in `unit`.

    shares (c,): of the length, or all alike. rigid: see `Cells`.
    """

    sites: list[Site]
    at: np.ndarray
    unit: str
    rows: np.ndarray
    shares: np.ndarray
    dofs: np.ndarray | None = None
    rigid: bool = False

    def cells(self, model: Reduced, weights: np.ndarray, extend: Callable | None) -> Cells | None:
        """Cells in K whose rows have the `weights` (c,); extend: as in `of_rows`, for models of matrices."""
        put = extend if self.dofs is not None and of_matrices(model.problem) else None
        found = of_rows(model, self.sites, self.at, self.unit, self.rows, weights**2, "K", put)
        return found and replace(found, rigid=self.rigid)


def motions(model: Reduced) -> Motions | None:
    """Of bars where there are any, else of degrees of freedom; None of too few bars."""
    bars = model.bars
    if of_matrices(model.problem) or bars is None:
        own = translations(model)
        sites = [named_dof(model.problem.structure, int(i)) for i in own]
        shares = np.full(len(own), 1 / max(len(own), 1))
        high = _heights(model, own)
        at, unit = (own, "degrees of freedom") if high is None else (high, "m")
        return Motions(sites, at[:, None].astype(float), unit, model.V[own], shares, own, high is not None)
    if len(bars) < FEWEST:
        return None
    rows = np.stack([bars.deflection(i, 0.5) for i in range(len(bars))])
    sites = [bars.site(i, 0.5) for i in range(len(bars))]
    at = bars.start + 0.5 * bars.length[:, None] * bars.axis
    return Motions(sites, at, "m", rows, bars.length / bars.length.sum())


def _heights(model: Reduced, own: np.ndarray) -> np.ndarray | None:
    """Of degrees of freedom (c,) of a building of storeys that sways in one direction, above its base; None of any other."""
    turning = [] if model.problem.mesh is None else axes(model.problem)
    labels = [model.problem.structure.labels[i] for i in own]
    if len(turning) != 1 or not set(labels) <= set(turning[0].heights):
        return None
    return np.array([turning[0].heights[label] for label in labels])


def translations(model: Reduced) -> np.ndarray:
    """Degrees of freedom (c,) that are worth looking at and do not turn."""
    structure, keep = model.problem.structure, wanted(model)
    own = np.arange(structure.n) if keep is None else np.flatnonzero(keep)
    at = structure.geometry
    return own if at is None else own[((at.direction < 3) & at.placed)[own]]
