"""A spring along an unknown motion of the whole structure."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices, with_tie
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_rows
from mouse_cli.diagnosis.sites.points import named_dof, wanted
from mouse_cli.model.diagnosis import FORCE, Site
from mouse_cli.model.problem import Problem


def cells(model: Reduced) -> Cells | None:
    """Rows of motion, in units of which k = lowest measured eigenvalue times the mass, shared by their lengths."""
    return _of_dofs(model) if of_matrices(model.problem) or model.bars is None else _of_bars(model)


def _of_bars(model: Reduced) -> Cells | None:
    bars = model.bars
    if len(bars) < FEWEST:
        return None
    rows = np.stack([bars.deflection(i, 0.5) for i in range(len(bars))])
    shares = (bars.length / bars.length.sum()) ** 2
    sites = [bars.site(i, 0.5) for i in range(len(bars))]
    at = bars.start + 0.5 * bars.length[:, None] * bars.axis
    return of_rows(model, sites, at, "m", rows, _unit(model) * shares, "K", None)


def _of_dofs(model: Reduced) -> Cells | None:
    structure, keep = model.problem.structure, wanted(model)
    own = np.arange(structure.n) if keep is None else np.flatnonzero(keep)
    if structure.geometry is not None:
        own = own[structure.geometry.direction[own] < 3]
    sites: list[Site] = [named_dof(structure, int(i)) for i in own]
    sizes = np.full(len(own), _unit(model) / max(len(own), 1) ** 2)

    def extend(problem: Problem, kept: np.ndarray, values: np.ndarray, spread: float, sign: int) -> Problem:
        return with_tie(problem, own[kept], values * np.sqrt(sizes[kept]), sign)

    rows, at = model.V[own], own[:, None].astype(float)
    put = extend if of_matrices(model.problem) else None
    return of_rows(model, sites, at, "degrees of freedom", rows, sizes, "K", put)


def _unit(model: Reduced) -> float:
    return lowest(model) * total_mass(model)


NAMELESS = Nameless(
    "force",
    "a spring along an unknown motion of the structure",
    FORCE,
    "stiffness that ties all parts together along one motion: K + b b' with a smooth random field b, whose spread and correlation "
    "length are integrated out (outrigger, strut between distant parts, overall bending)",
    (0.3, 1.0, 3.0),
    cells,
    (1,),
)
