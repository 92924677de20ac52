"""A stiffness that varies smoothly along the structure."""

import numpy as np

from mouse_cli.diagnosis.effects.losses import Listed, listed_springs
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_elements
from mouse_cli.diagnosis.nameless._energy import local_energy
from mouse_cli.diagnosis.nameless._groups import of_groups
from mouse_cli.model.diagnosis import STIFFNESS, Site
from mouse_cli.model.problem import Problem

_SUM = 1e-6  # of its size, that a part has beyond sums of others, below which it is one


def cells(model: Reduced) -> Cells | None:
    """K + sum v_e K_e over elements; of a model of matrices over its springs, of a continuum over its groups, or over degrees of
    freedom where it has none.
    """
    if not of_matrices(model.problem):
        return of_elements(model, "K", ("E", "G"))
    return (of_groups(model, "K") or local_energy(model)) if _continuum(model) else _springs(model)


def _continuum(model: Reduced) -> bool:
    """Whether K couples as bending, plates and solids do, some degrees of freedom with k_ij > 0: none of that is a spring."""
    from scipy.sparse import coo_array

    K = coo_array(model.assembly.matrices(model.theta)[0])
    return bool((K.data[K.row != K.col] > _SUM * K.data.max(initial=0.0)).any())


def _springs(model: Reduced) -> Cells | None:
    listed = _apart(listed_springs(model))
    if len(listed) < FEWEST:
        return None
    sites = tuple(Site("dof", (), None, text) for text, _, _ in listed)
    at = np.array([[np.mean([*row, *col])] for _, (row, col, _), _ in listed])
    blocks = tuple((np.eye(model.r), K) for _, _, K in listed)

    def extend(problem: Problem, values: np.ndarray, spread: float) -> Problem:
        shares = [(text, float(v), tuple(-part if k == 2 else part for k, part in enumerate(entries)))
                  for (text, entries, _), v in zip(listed, values, strict=True)]  # fmt: skip
        return with_shares(problem, "stiffness", shares, spread)

    return Cells(sites, at, "degrees of freedom", blocks, "K", extend)


def _apart(listed: list[Listed]) -> list[Listed]:
    """Those that are no sum of others before them: a group of springs that are cells themselves would change them twice."""
    basis, kept = np.zeros((0, listed[0][2].size if listed else 0)), []
    for each in listed:
        own = each[2].ravel() / np.linalg.norm(each[2])
        left = own - basis.T @ (basis @ own)
        left -= basis.T @ (basis @ left)
        if np.linalg.norm(left) > _SUM:
            basis = np.vstack([basis, left / np.linalg.norm(left)])
            kept.append(each)
    return kept


NAMELESS = Nameless(
    "field-stiffness",
    "a stiffness that varies along the structure",
    STIFFNESS,
    "stiffness of every part is off by its own share, neighbours alike: a smooth random field whose spread and correlation length "
    "are integrated out",
    (0.03, 0.1, 0.3),
    cells,
)
