"""From the matrices, supports and structure of a draft to the model: its constant part, its terms, its degrees of freedom."""

from dataclasses import replace

import numpy as np

from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.formats.rules import matrices
from mouse_cli.formats.rules import mesh as mesh_rules
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.held import Held, Support
from mouse_cli.model.held import applied as applied_to
from mouse_cli.model.structure import ListedElements, Structure
from mouse_cli.model.term import Term

FAULTS = {  # codes of what may be wrong with a mesh
    "Disconnected": "MD410",
    "ZeroLength": "MD411",
    "Unoriented": "MD412",
    "Loose": "MD421",
    "Overconstrained": "MD417",
    "LinkLoop": "MD417",
    "Mechanism": "MD418",
    "NoLoadPath": "MD422",
}
Model = tuple[Structure, tuple[Term, ...]]


def model(draft: Draft) -> Model | None:
    """Structure and terms, after their rules; sets order and labels of the draft. None when a rule is broken."""
    found = {name: getattr(draft, name) for name in ("K", "M", "C", "D")}
    found = {name: matrices.matrix(draft, source, name) for name, source in found.items() if source is not None}
    mesh_rules.mesh(draft)
    if draft.has_errors:
        return None
    if draft.mesh is None:
        base = applied(draft, Structure(**found, labels=draft.labels, geometry=draft.geometry))
        if base is not None:
            _massive(draft, base.K, base.M)
        return None if draft.has_errors else (base, ())
    made = _built(draft, Structure(**found, labels=draft.labels) if found else None)
    if made is not None:
        draft.order, draft.labels = made[0].n, made[0].labels
        _masses(draft, *made)
    return made


def _built(draft: Draft, base: Structure | None) -> Model | None:
    """What the element library makes of the mesh; what it finds wrong becomes a diagnostic."""
    from mouse_cli.terms.build import built
    from mouse_cli.terms.faults import MeshFault

    given = draft.mesh
    on_dofs = bool(given.labels)
    if on_dofs:  # the degrees of freedom are the nodes, and each moves along X
        base = replace(base, labels=tuple(f"{i + 1}TX" for i in range(base.n)))
    try:
        found = built(given.mesh, tuple(given.bindings), base)
    except MeshFault as fault:
        place = mesh_rules.fault_place(given, fault.nodes, fault.elements)
        return draft.error(FAULTS.get(type(fault).__name__, "MD418"), str(fault), place, help=fault.help)
    for remark in found.remarks:
        if len(remark.nodes) == len(given.mesh.node_ids) and remark.kind == "floating":
            continue  # a structure that is free as a whole is no slip
        draft.warn("MD423", remark.message, mesh_rules.fault_place(given, remark.nodes, ()))
    structure = found.structure
    if on_dofs:
        structure = replace(structure, labels=given.labels, geometry=None)
    return structure, found.terms


def _masses(draft: Draft, structure: Structure, terms: tuple[Term, ...]) -> None:
    from mouse_cli.terms.assembly import Assembly

    if not structure.n:
        draft.error(
            "MD424", "no direction of the structure is free to move", draft.mesh.span, help="take supports away"
        )
        return
    if draft.has_errors or any(p.sd != p.sd for p in draft.parameters):
        return
    nominal = matrices.nominal(draft)
    _massive(draft, *Assembly(structure, terms, len(nominal)).matrices(nominal))


def _massive(draft: Draft, K: Matrix, M: Matrix) -> None:
    """The rule for masses: zero is allowed in matrices of other programs, and in structures where stiffness ties it to masses."""
    if draft.mesh is not None and draft.M is None:
        matrices.carried_masses(draft, K, M)
    elif draft.M is None or isinstance(draft.M, Entries):
        matrices.positive_masses(draft, M)
    else:
        masses(draft, K, M)


_LISTED = 3  # findings that are reported one by one


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


def applied(draft: Draft, base: Structure) -> Structure | None:
    """The structure on its supports; the draft follows: order, labels, listed elements, A. None after an error."""
    if not draft.supports:
        return base
    mask, owner = np.ones(base.n, bool), {}
    for support in draft.supports:
        for dof in (support.dofs - 1).tolist():
            if not 0 <= dof < base.n:
                message = f"support {support.name} holds degree of freedom {dof + 1}; the model has {base.n}"
                return draft.error("MD276", message, support.place, help=f"give numbers from 1 to {base.n}, or labels")
            if owner.setdefault(dof, support.name) != support.name:
                message = f"degree of freedom {base.labels[dof]} is held by {owner[dof]} and by {support.name}"
                return draft.error("MD276", message, support.place, help="let one of the two hold it")
            mask[dof] = False
    kept = np.flatnonzero(mask)
    if not len(kept):
        return draft.error(
            "MD276", "the supports hold every degree of freedom", draft.where_order, help="take some away"
        )
    border, A = _parted(draft, base.n, mask)
    supports = tuple(Support(each.name, each.dofs - 1) for each in draft.supports)
    draft.held = Held(base, supports, kept, border, A)
    draft.order, draft.labels = len(kept), tuple(base.labels[i] for i in kept)
    return applied_to(base, kept)


def _parted(draft: Draft, n: int, mask: np.ndarray) -> tuple[ListedElements, object]:
    """Leaves in the draft the listed elements that no support touches; returns the others and their rows of A."""
    from scipy.sparse import coo_array

    listed, A = draft.elements, draft.A
    inside = (np.minimum(listed.rows, listed.cols) >= 1) & (np.maximum(listed.rows, listed.cols) <= n)
    low, high = (np.clip(part - 1, 0, n - 1) for part in (listed.rows, listed.cols))
    free = (mask[low] & mask[high]) | ~inside  # the rules for listed elements refuse what is outside
    number = np.cumsum(mask)
    where = np.flatnonzero(free)
    at = listed.where
    draft.elements = Entries(
        np.where(inside, number[low], listed.rows)[free],
        np.where(inside, number[high], listed.cols)[free],
        listed.values[free],
        lambda i: at(int(where[i])),
    )
    bound = ListedElements(listed.values[~free] > 0, np.minimum(low, high)[~free], np.maximum(low, high)[~free])
    rank = np.where(free, np.cumsum(free), np.cumsum(~free))
    known = (A.rows >= 1) & (A.rows <= len(listed))
    own = np.ones(len(A), bool)
    own[known] = free[A.rows[known] - 1]
    held = coo_array(
        (A.values[~own], (rank[A.rows[~own] - 1] - 1, A.cols[~own] - 1)), shape=(len(bound), len(draft.parameters))
    ).tocsr()
    index, place = np.flatnonzero(own), A.where
    rows = np.where(known, rank[np.clip(A.rows - 1, 0, max(len(listed) - 1, 0))] if len(listed) else A.rows, A.rows)
    draft.A = Entries(rows[own], A.cols[own], A.values[own], lambda i: place(int(index[i])))
    return bound, held
