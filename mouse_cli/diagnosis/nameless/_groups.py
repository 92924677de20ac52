"""Groups of matrices, each of a parameter of the deck, as the cells of a field: strips of a plate, storeys, parts of a machine."""

import numpy as np

from mouse_cli.diagnosis.extend.matrices import Entries, with_shares
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import Cells, with_energy
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Site
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure

_WHOLE = 0.999  # share of the diagonal of a matrix from which on a group is all of it, and no part


def of_groups(model: Reduced, into: str) -> Cells | None:
    """What each parameter of a model of matrices makes of K or M (`into`), where that is more than one spring or mass."""
    problem, sites, blocks, listed = model.problem, [], [], []
    of_it = dict(zip("KM", (model.dK, model.dM), strict=True))[into]
    total = dict(zip("KM", model.assembly.matrices(model.theta), strict=True))[into].diagonal()
    for j, parameter in enumerate(problem.parameters):
        entries = _entries(problem, j, into == "M", float(model.theta[j]))
        if len(entries[0]) > 3 and _share(entries, total) < _WHOLE:
            sites.append(Site("dof", (), None, f"what '{parameter.name}' stands for"))
            matrix = model.theta[j] * np.tensordot(model.along[:, j], of_it, 1)
            blocks.append((np.eye(model.r), matrix)), listed.append(entries)
    at, unit = places(problem.structure)
    middles = np.array([at[np.concatenate([row, col])].mean(axis=0) for row, col, _ in listed])
    what = {"K": "stiffness", "M": "mass"}[into]

    def extend(problem: Problem, values: np.ndarray, spread: float) -> Problem:
        pairs = zip(cells.sites, values, strict=True)
        where = {site.text: entries for site, entries in zip(sites, listed, strict=True)}
        return with_shares(problem, what, [(site.text, float(v), where[site.text]) for site, v in pairs], spread)

    cells = with_energy(model, Cells(tuple(sites), middles.reshape(-1, at.shape[1]), unit, tuple(blocks), into, extend))
    return cells


def _entries(problem: Problem, j: int, mass: bool, theta: float) -> Entries:
    """Entries of the matrix that parameter j makes at `theta`: rows <= columns, values."""
    listed = problem.elements
    column = dense(problem.A[:, [j]]).ravel() if len(listed) else np.zeros(0)
    own = np.flatnonzero((column != 0) & (listed.is_mass == mass))
    return listed.row[own], listed.col[own], theta * column[own]


def _share(entries: Entries, total: np.ndarray) -> float:
    """The least share that a group has in the diagonal `total` (n,) of its matrix, where that has any."""
    row, col, value = entries
    diagonal = np.zeros(len(total))
    np.add.at(diagonal, row[row == col], value[row == col])
    has = total > 0
    return float((diagonal[has] / total[has]).min())


def places(structure: Structure) -> tuple[np.ndarray, str]:
    """Where each degree of freedom is (n, d), and in which unit: at its node in m, else by its number.

    What a solver adds, on no node, is in the middle of all.
    """
    at = structure.geometry
    if at is None or not (at.node >= 0).any():
        return np.arange(structure.n, dtype=float)[:, None], "degrees of freedom"
    middle = at.coordinates[np.unique(at.node[at.node >= 0])].mean(axis=0)
    return np.where((at.node >= 0)[:, None], at.coordinates[at.node], middle), "m"
