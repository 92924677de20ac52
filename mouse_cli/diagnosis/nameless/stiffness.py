"""A stiffness that varies smoothly along the structure."""

import numpy as np

from mouse_cli.diagnosis.effects.losses import listed_springs
from mouse_cli.diagnosis.extend.matrices import of_matrices, with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import FEWEST, Cells, of_elements
from mouse_cli.model.diagnosis import STIFFNESS, Site
from mouse_cli.model.problem import Problem


def cells(model: Reduced) -> Cells | None:
    """K + sum v_e K_e over elements, or over the springs and groups that a model of matrices shows."""
    return _springs(model) if of_matrices(model.problem) else of_elements(model, "K", ("E", "G"))


def _springs(model: Reduced) -> Cells | None:
    listed = listed_springs(model)
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


NAMELESS = Nameless(
    "field-stiffness",
    "a stiffness that varies along the structure",
    STIFFNESS,
    "stiffness of every part is off by its own share, neighbours alike: a smooth random field whose spread and correlation length "
    "are integrated out",
    (0.03, 0.1, 0.3),
    cells,
)
