"""A mass that varies smoothly along the structure."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import of_matrices, with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import Cells, of_elements, of_rows
from mouse_cli.diagnosis.nameless._groups import of_groups, places
from mouse_cli.diagnosis.sites.points import named_dof, wanted
from mouse_cli.model.diagnosis import MASS
from mouse_cli.model.problem import Problem


def cells(model: Reduced) -> Cells | None:
    """M + sum v_e M_e over elements; of a model of matrices over its groups, or over the diagonal of its mass matrix."""
    if not of_matrices(model.problem):
        return of_elements(model, "M", ("density", "nonstructural_mass", "mass"))
    return of_groups(model, "M") or _diagonal(model)


def _diagonal(model: Reduced) -> Cells | None:
    mass = model.assembly.matrices(model.theta)[1].diagonal()
    keep, geometry = wanted(model), model.problem.structure.geometry
    has = mass > 0 if geometry is None else (mass > 0) & geometry.placed
    own = np.flatnonzero(has) if keep is None else np.flatnonzero(keep & has)
    sites = [named_dof(model.problem.structure, int(i)) for i in own]

    def extend(problem: Problem, kept: np.ndarray, values: np.ndarray, spread: float) -> Problem:
        shares = [
            (sites[k].text, float(v), (own[[k]], own[[k]], mass[own[[k]]])) for k, v in zip(kept, values, strict=True)
        ]
        return with_shares(problem, "mass", shares, spread)

    at, unit = places(model.problem.structure)
    return of_rows(model, sites, at[own], unit, model.V[own], mass[own], "M", extend)


NAMELESS = Nameless(
    "field-mass",
    "a mass that varies along the structure",
    MASS,
    "mass of every part is off by its own share, neighbours alike: a smooth random field whose spread and correlation length are "
    "integrated out",
    (0.03, 0.1, 0.3),
    cells,
    even="added-mass",
)
