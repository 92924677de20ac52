"""Flexibility along an unknown motion of the whole structure."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices, with_tie
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import lowest, total_mass
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_rows
from mouse_cli.diagnosis.sites.points import named_dof, wanted
from mouse_cli.model.diagnosis import COMPLIANCE, Site
from mouse_cli.model.problem import Problem


def cells(model: Reduced) -> Cells | None:
    """Rows of momentum m u, whose sum over the motion is it in the coordinates of the model, where M = 1.

    The motion is in units of 1 / sqrt(mass times lowest measured eigenvalue): a spread of one doubles the compliance of a first
    mode of its form.
    """
    return _of_dofs(model) if of_matrices(model.problem) or model.bars is None else _of_bars(model)


def _of_bars(model: Reduced) -> Cells | None:
    bars = model.bars
    if len(bars) < FEWEST:
        return None
    rows = np.stack([bars.deflection(i, 0.5) for i in range(len(bars))])
    mass = total_mass(model) * bars.length / bars.length.sum()
    sites = [bars.site(i, 0.5) for i in range(len(bars))]
    at = bars.start + 0.5 * bars.length[:, None] * bars.axis
    return of_rows(model, sites, at, "m", rows, _sizes(model, mass), "K", None)


def _of_dofs(model: Reduced) -> Cells | None:
    structure, keep = model.problem.structure, wanted(model)
    own = np.arange(structure.n) if keep is None else np.flatnonzero(keep)
    if structure.geometry is not None:
        own = own[structure.geometry.direction[own] < 3]
    mass = np.asarray(model.assembly.matrices(model.theta)[1].diagonal())[own]
    sites: list[Site] = [named_dof(structure, int(i)) for i in own]
    sizes = _sizes(model, mass * total_mass(model) / mass.sum())

    def extend(problem: Problem, kept: np.ndarray, values: np.ndarray, spread: float, sign: int) -> Problem:
        motion = np.zeros(structure.n)
        motion[own[kept]] = values / np.sqrt(total_mass(model) * lowest(model))
        force = model.assembly.matrices(model.theta)[0] @ motion
        acting = np.flatnonzero(force)
        return with_tie(problem, acting, force[acting] / np.sqrt(1 + motion @ force), sign)

    rows, at = model.V[own], own[:, None].astype(float)
    put = extend if of_matrices(model.problem) else None
    return of_rows(model, sites, at, "degrees of freedom", rows, sizes, "K", put)


def _sizes(model: Reduced, mass: np.ndarray) -> np.ndarray:
    """Squares of the weights of the rows, by the mass (c,) that moves with each."""
    return mass**2 / (total_mass(model) * lowest(model))


NAMELESS = Nameless(
    "compliance",
    "flexibility along an unknown motion of the structure",
    COMPLIANCE,
    "one motion of the whole structure more than the model lets it make: K^-1 + h h' with a smooth random field h, whose spread "
    "and correlation length are integrated out (soil that rocks, a base or a joint that is soft, a part that turns as one)",
    (0.1, 0.5, 2.5),
    cells,
    (-1,),
)
