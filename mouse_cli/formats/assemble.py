"""The rules that every deck obeys, whatever its format: a Draft becomes a Problem, or one DeckError with all that is wrong."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError
from mouse_cli.formats import _prior_rules, _test_rules
from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.model._arrays import Matrix
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import ListedElements, Structure

LARGEST_DENSE = 1500  # orders up to this are kept as dense arrays: eigh of the whole matrix is then the fastest way
_LISTED = 3  # findings of one kind that are told one by one where one cause is likely to make many
LARGEST_PARTIALS = 5_000_000  # entries of A above this are kept sparse


def assemble(draft: Draft) -> Problem:
    """Apply the rules to `draft` and build the Problem.

    Raises DeckError with every error found, warnings included, in the order of the file.
    """
    unread = has_errors(draft)
    K = _matrix(draft, draft.K, "K")
    M = _matrix(draft, draft.M, "M")
    if not has_errors(draft):
        _positive_masses(draft, M)
    elements = _elements(draft)
    A = _partials(draft)
    prior = _prior_rules.prior(draft)
    test = _test_rules.modal_test(draft)
    _test_rules.total_mass_dofs(draft)
    if unread:  # what was not read seems to be missing: remarks on that would only mislead
        draft.diagnostics = [d for d in draft.diagnostics if d.severity == ERROR or not d.code.startswith("MD3")]
    stop_on_errors(draft)
    return Problem(
        title=draft.title,
        structure=Structure(K, M, draft.labels),
        elements=elements,
        A=A,
        parameters=tuple(draft.parameters),
        prior=prior,
        test=test,
        run=replace(draft.run),
        source=draft.source,
        warnings=tuple(d for d in draft.diagnostics if d.severity == WARNING),
    )


def has_errors(draft: Draft) -> bool:
    """Whether anything found so far forbids a run."""
    return any(d.severity == ERROR for d in draft.diagnostics)


def stop_on_errors(draft: Draft) -> None:
    """Raise DeckError when `draft` carries an error, all diagnostics in the order of the file."""
    if has_errors(draft):
        raise DeckError(sorted(draft.diagnostics, key=lambda d: d.span.line if d.span else 0))


def outside(draft: Draft, entries: Entries, rows: int, cols: int, what: str) -> np.ndarray:
    """Mask of the entries within (rows, cols), after noting MD301 for each that is not."""
    inside = (entries.rows >= 1) & (entries.rows <= rows) & (entries.cols >= 1) & (entries.cols <= cols)
    for i in np.flatnonzero(~inside)[:20]:
        draft.error(
            "MD301",
            f"{what} ({entries.rows[i]},{entries.cols[i]}) is outside {rows} x {cols}",
            entries.where(int(i)),
            help=f"give a row from 1 to {rows} and a column from 1 to {cols}",
        )
    return inside


def _matrix(draft: Draft, source: Entries | Matrix, name: str) -> Matrix | None:
    """K or M as a whole symmetric matrix, from listed entries or from a file."""
    if not isinstance(source, Entries):
        return source
    inside = outside(draft, source, draft.order, draft.order, name)
    if not inside.all() or has_errors(draft):
        return None
    _finite(draft, source, name)
    _mirror_images(draft, source, name)
    return None if has_errors(draft) else symmetric(source, draft.order)


def symmetric(entries: Entries, order: int) -> Matrix:
    """The full symmetric matrix (order, order) of diagonal and triangle entries; a place given twice counts once."""
    low, high = np.minimum(entries.rows, entries.cols) - 1, np.maximum(entries.rows, entries.cols) - 1
    if order <= LARGEST_DENSE:
        full = np.zeros((order, order))
        full[low, high] = entries.values
        full[high, low] = entries.values
        return full
    from scipy.sparse import coo_array

    _, first = np.unique(low.astype(np.int64) * order + high, return_index=True)
    low, high, values = low[first], high[first], entries.values[first]
    off = low != high
    rows, cols = np.concatenate([low, high[off]]), np.concatenate([high, low[off]])
    return coo_array((np.concatenate([values, values[off]]), (rows, cols)), shape=(order, order)).tocsr()


def _finite(draft: Draft, entries: Entries, name: str) -> None:
    for i in np.flatnonzero(~np.isfinite(entries.values))[:20]:
        draft.error(
            "MD302",
            f"{name}({entries.rows[i]},{entries.cols[i]}) is {entries.values[i]}, not a finite number",
            entries.where(int(i)),
            help="give a finite number",
        )


def _mirror_images(draft: Draft, entries: Entries, name: str) -> None:
    """(i, j) and (j, i) are one place: equal values are a warning, unequal ones an error."""
    seen: dict[tuple[int, int], int] = {}
    for i, (row, col) in enumerate(zip(entries.rows.tolist(), entries.cols.tolist(), strict=True)):
        first = seen.setdefault((min(row, col), max(row, col)), i)
        if first == i:
            continue
        one, other = entries.values[first], entries.values[i]
        message = f"{name}({row},{col}) is given twice, first as {one:.8g}, then as {other:.8g}"
        note = "an element and its mirror image are one place"
        if one == other:
            draft.warn("MD303", message, entries.where(i), note, "give each element once")
        else:
            draft.error("MD303", message, entries.where(i), note, "delete one of the two")


def _positive_masses(draft: Draft, M: Matrix) -> None:
    """Every diagonal element of M must be positive: a massless degree of freedom has an infinite eigenvalue."""
    diagonal = M.diagonal()
    missing = np.flatnonzero(~(diagonal > 0))
    for i in missing[:_LISTED]:
        draft.error(
            "MD304",
            f"mass of degree of freedom {i + 1} is {diagonal[i]:.8g}; it must be positive",
            _where_diagonal(draft.M, i + 1) or draft.where_order,
            help=f"give M({i + 1},{i + 1}) a positive value, or condense that degree of freedom out",
        )
    if len(missing) > _LISTED:
        draft.error(
            "MD304",
            f"{len(missing)} of {draft.order} degrees of freedom have no positive mass",
            draft.where_order,
            help=f"check the order of the model: is it {draft.order}?",
        )


def _where_diagonal(source: Entries | Matrix, index: int):
    """Place of the diagonal entry `index`, when it was listed at all."""
    if not isinstance(source, Entries):
        return None
    listed = np.flatnonzero((source.rows == index) & (source.cols == index))
    return source.where(int(listed[0])) if len(listed) else None


def _elements(draft: Draft) -> ListedElements | None:
    """The elements that may vary (RS), checked for range, repetition and order of the indices."""
    listed = draft.elements
    if not outside(draft, listed, draft.order, draft.order, "listed element").all():
        return None
    seen: dict[tuple[float, int, int], int] = {}
    for i, (row, col, mass) in enumerate(zip(listed.rows, listed.cols, listed.values, strict=True)):
        name = f"{'m' if mass else 'k'}({row},{col})"
        if row > col:
            draft.warn(
                "MD305",
                f"{name} is below the diagonal; it is taken as its mirror image",
                listed.where(i),
                help="list the upper triangle: row before column",
            )
        if seen.setdefault((mass, min(row, col), max(row, col)), i) != i:
            draft.error("MD306", f"element {name} is listed twice", listed.where(i), help="list each element once")
    low, high = np.minimum(listed.rows, listed.cols), np.maximum(listed.rows, listed.cols)
    return ListedElements(listed.values > 0, low - 1, high - 1)


def _partials(draft: Draft) -> Matrix | None:
    """A (e, p): checked for range and repetition; rows and columns of zeros are warned of."""
    e, p, A = len(draft.elements), len(draft.parameters), draft.A
    if not outside(draft, A, e, p, "A").all():
        return None
    _finite(draft, A, "A")
    order = np.lexsort((A.cols, A.rows))
    again = (np.diff(A.rows[order]) == 0) & (np.diff(A.cols[order]) == 0)
    for first, second in zip(order[:-1][again][:20].tolist(), order[1:][again][:20].tolist(), strict=True):
        note = draft.warn if A.values[first] == A.values[second] else draft.error
        place, message = A.where(max(first, second)), f"A({A.rows[first]},{A.cols[first]}) is given twice"
        note("MD307", message, place, help="give each partial derivative once")
    _idle(draft)
    if e * p > LARGEST_PARTIALS:
        from scipy.sparse import coo_array

        return coo_array((A.values, (A.rows - 1, A.cols - 1)), shape=(e, p)).tocsr()
    dense = np.zeros((e, p))
    dense[A.rows - 1, A.cols - 1] = A.values
    return dense


def _idle(draft: Draft) -> None:
    """Warn of elements that no property moves and of properties that move no element."""
    moving = draft.A.values != 0
    for i in sorted(set(range(1, len(draft.elements) + 1)) - set(draft.A.rows[moving].tolist()))[:20]:
        draft.warn(
            "MD308",
            f"no property moves listed element {i}, ({draft.elements.rows[i - 1]},{draft.elements.cols[i - 1]})",
            draft.elements.where(i - 1),
            help="leave the element out of the list, or give its row of A",
        )
    for j in sorted(set(range(1, len(draft.parameters) + 1)) - set(draft.A.cols[moving].tolist()))[:20]:
        parameter = draft.parameters[j - 1]
        draft.warn(
            "MD309",
            f"property {j} ({parameter.name}) moves no element of K or M; the test cannot revise it",
            parameter.span,
            help="give its column of A, or leave the property out",
        )
