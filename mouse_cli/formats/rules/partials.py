"""Rules for the elements that may vary and for the matrix A that ties them to the properties."""

import numpy as np

from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.formats.rules.entries import MOST, finite, inside
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.structure import ListedElements

LARGEST_DENSE = 5_000_000  # entries of A above this are kept sparse


def elements(draft: Draft) -> ListedElements | None:
    """The elements that may vary (RS), checked for range, repetition and order of the indices."""
    listed = draft.elements
    if not inside(draft, listed, draft.order, draft.order, "listed element").all():
        return None
    low, high = np.minimum(listed.rows, listed.cols), np.maximum(listed.rows, listed.cols)
    for i in np.flatnonzero(listed.rows > listed.cols)[:MOST].tolist():
        message = f"{_called(listed, i)} is below the diagonal; it is taken as its mirror image"
        draft.warn("MD305", message, listed.where(i), help="list the upper triangle: row before column")
    place = (listed.values * draft.order + low - 1) * draft.order + high - 1
    _, first = np.unique(place, return_index=True)
    for i in np.delete(np.arange(len(listed)), first)[:MOST].tolist():
        message = f"element {_called(listed, i)} is listed twice"
        draft.error("MD306", message, listed.where(i), help="list each element once")
    return ListedElements(listed.values > 0, low - 1, high - 1)


def _called(listed: Entries, i: int) -> str:
    """Name of listed element `i`, such as k(1,2)."""
    return f"{'m' if listed.values[i] else 'k'}({listed.rows[i]},{listed.cols[i]})"


def partials(draft: Draft) -> Matrix | None:
    """A (e, p): checked for range and repetition; rows and columns of zeros are warned of."""
    e, p, A = len(draft.elements), len(draft.parameters), draft.A
    if not inside(draft, A, e, p, "A").all():
        return None
    finite(draft, A, "A")
    order = np.lexsort((A.cols, A.rows))
    again = (np.diff(A.rows[order]) == 0) & (np.diff(A.cols[order]) == 0)
    for first, second in zip(order[:-1][again][:MOST].tolist(), order[1:][again][:MOST].tolist(), strict=True):
        note = draft.warn if A.values[first] == A.values[second] else draft.error
        place, message = A.where(max(first, second)), f"A({A.rows[first]},{A.cols[first]}) is given twice"
        note("MD307", message, place, help="give each partial derivative once")
    _idle(draft)
    if e * p > LARGEST_DENSE:
        from scipy.sparse import coo_array

        return coo_array((A.values, (A.rows - 1, A.cols - 1)), shape=(e, p)).tocsr()
    dense = np.zeros((e, p))
    dense[A.rows - 1, A.cols - 1] = A.values
    return dense


def _idle(draft: Draft) -> None:
    """Warn of elements that no property moves and of properties that move no element."""
    moving = draft.A.values != 0
    bound = [binding.parameter for binding in draft.mesh.bindings] if draft.mesh else []
    still = np.delete(np.arange(len(draft.elements)), draft.A.rows[moving] - 1) + 1
    for i in still[:MOST].tolist():
        message = f"no property moves listed element {i}, ({draft.elements.rows[i - 1]},{draft.elements.cols[i - 1]})"
        help = "leave the element out of the list, or give its row of A"
        draft.warn("MD308", message, draft.elements.where(i - 1), help=help)
    idle = np.delete(np.arange(len(draft.parameters)), [*(draft.A.cols[moving] - 1).tolist(), *bound]) + 1
    for j in idle[:MOST].tolist():
        parameter = draft.parameters[j - 1]
        message = f"property {j} ({parameter.name}) moves no element of K or M; the test cannot revise it"
        draft.warn("MD309", message, parameter.span, help="give its column of A, or leave the property out")
