"""Rules for matrices of other programs, which write a zero mass where rotations have none."""

import numpy as np

from mouse_cli.formats.draft import Draft
from mouse_cli.model.arrays import Matrix

_LISTED = 3  # findings that are told one by one


def masses(draft: Draft, K: Matrix, M: Matrix) -> None:
    """No mass is negative, and a degree of freedom without mass has stiffness and takes no part in the mass of others.

    Its eigenvalue is infinite, and the eigensolvers leave it out; with neither, K - eigenvalue M is singular for every eigenvalue.
    """
    mass, stiffness = M.diagonal(), K.diagonal()
    negative = np.flatnonzero(~(mass >= 0))
    for i in negative[:_LISTED]:
        message = f"mass of degree of freedom {_name(draft, i)} is {mass[i]:.8g}; it must not be negative"
        draft.error("MD304", message, draft.where_order, help="export the mass matrix again")
    massless = np.flatnonzero(mass == 0)
    if not len(massless):
        return
    loose = massless[~(stiffness[massless] > 0)]
    coupled = massless[np.asarray(abs(M[massless]).sum(axis=1)).ravel() > 0]
    _reject(draft, loose, "has neither stiffness nor mass")
    _reject(draft, np.setdiff1d(coupled, loose), "has no mass of its own, but is coupled to others by mass")


def _reject(draft: Draft, dofs: np.ndarray, what: str) -> None:
    rest = f" ({len(dofs)} such degrees of freedom)" if len(dofs) > _LISTED else ""
    for i in dofs[:_LISTED].tolist():
        help = "constrain it in the program that wrote the matrices, or export without it"
        draft.error("MD263", f"degree of freedom {_name(draft, i)} {what}{rest}", draft.where_order, help=help)


def _name(draft: Draft, i: int) -> str:
    return draft.labels[i] if draft.labels else str(i + 1)
