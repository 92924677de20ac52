"""Rules for the supports of imported matrices; they are applied to K, M and what parameters move."""

import numpy as np

from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.model.held import Held, Support
from mouse_cli.model.held import applied as applied_to
from mouse_cli.model.structure import ListedElements, Structure


def applied(draft: Draft, base: Structure) -> Structure | None:
    """The structure on its supports; the draft follows: order, labels, listed elements, A. None after an error."""
    if not draft.supports:
        return base
    mask, owner = np.ones(base.n, bool), {}
    for support in draft.supports:
        for dof in (support.dofs - 1).tolist():
            if not 0 <= dof < base.n:
                message = f"support {support.name} holds degree of freedom {dof + 1}; the model has {base.n}"
                draft.error("MD276", message, support.place, help=f"give numbers from 1 to {base.n}, or labels")
                return None
            if owner.setdefault(dof, support.name) != support.name:
                message = f"degree of freedom {base.labels[dof]} is held by {owner[dof]} and by {support.name}"
                draft.error("MD276", message, support.place, help="let one of the two hold it")
                return None
            mask[dof] = False
    kept = np.flatnonzero(mask)
    if not len(kept):
        draft.error("MD276", "the supports hold every degree of freedom", draft.where_order, help="take some away")
        return None
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
    index, told = np.flatnonzero(own), A.where
    rows = np.where(known, rank[np.clip(A.rows - 1, 0, max(len(listed) - 1, 0))] if len(listed) else A.rows, A.rows)
    draft.A = Entries(rows[own], A.cols[own], A.values[own], lambda i: told(int(index[i])))
    return bound, held
