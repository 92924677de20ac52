"""Rules for K and M: every element once, finite, and masses that are positive."""

from dataclasses import replace

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.draft import Draft, Entries
from mouse_cli.formats.rules.entries import finite, inside
from mouse_cli.model.arrays import Matrix, dense, is_sparse, sparse_symmetric

LARGEST_DENSE = 1500  # orders up to this are kept as dense arrays: eigh of the whole matrix is then the fastest way
_TWICE = 18  # elements given twice that are listed one by one
_LISTED = 3  # findings of one kind that are reported one by one where one cause is likely to make many
_SINGULAR = 1e-13  # smallest over largest eigenvalue of M, scaled to a unit diagonal, that rounding alone can make
_MASSIVE = "give the elements a density, add masses (with inertia where a node rotates), or keep fewer `directions`"


def matrix(draft: Draft, source: Entries | Matrix, name: str) -> Matrix | None:
    """K or M (n, n) as a whole symmetric matrix, from listed entries or from a file; None when a rule is broken."""
    if not isinstance(source, Entries):
        return source
    within = inside(draft, source, draft.order, draft.order, name)
    if not within.all() or draft.has_errors:
        return None
    finite(draft, source, name)
    _mirror_images(draft, source, name)
    return None if draft.has_errors else _symmetric(source, draft.order)


def _symmetric(entries: Entries, order: int) -> Matrix:
    """The full symmetric matrix (order, order) of diagonal and triangle entries; a place given twice counts once."""
    low, high = np.minimum(entries.rows, entries.cols) - 1, np.maximum(entries.rows, entries.cols) - 1
    if order > LARGEST_DENSE:
        _, first = np.unique(low.astype(np.int64) * order + high, return_index=True)
        return sparse_symmetric(low[first], high[first], entries.values[first], order)
    full = np.zeros((order, order))
    full[low, high] = entries.values
    full[high, low] = entries.values
    return full


def _mirror_images(draft: Draft, entries: Entries, name: str) -> None:
    """(i, j) and (j, i) are one place: equal values are a warning, unequal ones an error."""
    low, high = np.minimum(entries.rows, entries.cols), np.maximum(entries.rows, entries.cols)
    _, first, place = np.unique(np.stack([low, high]), axis=1, return_index=True, return_inverse=True)
    first = first[place.ravel()]
    twice = np.flatnonzero(first != np.arange(len(first)))
    alike = entries.values[first[twice]] == entries.values[twice]
    note = "an element and its mirror image are one element"
    for found, say, help in (
        (twice[~alike], draft.error, "delete one of the two"),
        (twice[alike], draft.warn, "give each element once"),
    ):
        for i in found[:_TWICE]:
            values = f"first as {entries.values[first[i]]:.8g}, then as {entries.values[i]:.8g}"
            at = f"{name}({entries.rows[i]},{entries.cols[i]})"
            say("MD303", f"{at} is given twice, {values}", entries.where(int(i)), note, help)
        if len(found) > _TWICE:
            say(
                "MD303",
                f"{len(found)} elements of {name} in all are given twice",
                entries.where(int(found[-1])),
                note,
                help,
            )


def positive_masses(draft: Draft, M: Matrix) -> None:
    """Every diagonal element of M must be positive: a massless degree of freedom has an infinite eigenvalue."""
    diagonal = M.diagonal()
    missing = np.flatnonzero(~(diagonal > 0))
    for i in missing[:_LISTED]:
        name = draft.labels[i] if draft.labels else str(i + 1)
        draft.error(
            "MD304",
            f"mass of degree of freedom {name} is {diagonal[i]:.8g}; it must be positive",
            _where_diagonal(draft.M, i + 1) or draft.where_order,
            help=_MASSIVE
            if draft.mesh
            else f"give M({i + 1},{i + 1}) a positive value, or condense that degree of freedom out",
        )
    if not len(missing):
        _definite(draft, M)
    if len(missing) > _LISTED:
        draft.error(
            "MD304",
            f"{len(missing)} of {draft.order} degrees of freedom have no positive mass",
            draft.where_order,
            help=_MASSIVE if draft.mesh else f"check the order of the model: is it {draft.order}?",
        )


def carried_masses(draft: Draft, K: Matrix, M: Matrix) -> None:
    """A structure has mass; what of it has none, as rotations or bars without density, has stiffness and follows statically."""
    mass, stiffness = M.diagonal(), K.diagonal()
    massless = mass == 0
    if massless.all() or (mass < 0).any() or (massless & ~(stiffness > 0)).any():
        return positive_masses(draft, M)
    moving = [label for label, none in zip(draft.labels, massless.tolist(), strict=True) if none and label[-2] == "T"]
    if moving:
        message = f"{', '.join(moving[:_LISTED])} {'have' if len(moving) > 1 else 'has'} no mass"
        what = f"{message} ({len(moving)} of {draft.order} degrees of freedom); motion there follows that of the masses statically"
        draft.warn("MD304", what, draft.where_order, help=_MASSIVE)
    held = np.flatnonzero(~massless)
    _definite(draft, M[held][:, held], held, K)
    return None


def _definite(draft: Draft, M: Matrix, held: np.ndarray | None = None, K: Matrix | None = None) -> None:
    """No motion may be without mass though every degree of freedom has one: entries beside the diagonal are then wrong.

    held (n,): the degrees of freedom that M is of, where not of all. K: of all; with it, motions without mass are allowed, as of
    a point mass off its node, that have stiffness.
    """
    if is_sparse(M) or np.count_nonzero(M) == len(M):
        return
    scale = 1 / np.sqrt(M.diagonal())
    scaled = M * scale[:, None] * scale
    if _pivot(scaled) > 10 * len(M) * _SINGULAR:
        return
    eigenvalues, motions = np.linalg.eigh(scaled)
    if eigenvalues[0] > _SINGULAR * eigenvalues[-1]:
        return
    if K is not None and eigenvalues[0] > -_SINGULAR * eigenvalues[-1]:
        free = motions[:, eigenvalues <= _SINGULAR * eigenvalues[-1]] * scale[:, None]
        resisted = free.T @ dense(K[held][:, held]) @ free
        size = 1 / np.sqrt(resisted.diagonal())
        if _pivot(resisted * size[:, None] * size) > _SINGULAR:
            return
    size = np.abs(motions[:, 0])
    moving = np.flatnonzero(size > 0.3 * size.max())
    moving = moving if held is None else held[moving]
    names = [draft.labels[i] if draft.labels else str(i + 1) for i in moving[:6]]
    what = "no" if eigenvalues[0] > -_SINGULAR * eigenvalues[-1] else "a negative"
    message = f"a motion of the degrees of freedom {', '.join(names)} has {what} mass: M is not positive definite"
    help = "check the entries of M beside its diagonal"
    draft.error("MD304", message, _where_coupled(draft.M, moving) or draft.where_order, help=help)


def _pivot(scaled: Matrix) -> float:
    """The smallest pivot of a matrix with unit diagonal; 0 where there is one that is not positive."""
    try:
        return float(np.linalg.cholesky(scaled).diagonal().min()) ** 2
    except np.linalg.LinAlgError:
        return 0.0


def _where_coupled(source: Entries | Matrix, moving: np.ndarray) -> Span | None:
    """Place of the first entry beside the diagonal that couples two of the degrees of freedom `moving`."""
    if not isinstance(source, Entries):
        return None
    among = np.isin(source.rows - 1, moving) & np.isin(source.cols - 1, moving) & (source.rows != source.cols)
    return source.where(int(np.flatnonzero(among)[0])) if among.any() else None


def _where_diagonal(source: Entries | Matrix, index: int) -> Span | None:
    """Place of the diagonal entry `index`, when it was listed at all."""
    if not isinstance(source, Entries):
        return None
    listed = np.flatnonzero((source.rows == index) & (source.cols == index))
    return source.where(int(listed[0])) if len(listed) else None


def total_mass_dofs(draft: Draft) -> None:
    """The degrees of freedom whose mass is summed must exist; labels become their numbers."""
    if not draft.order:
        return
    place = {label: i for i, label in enumerate(draft.labels)}
    numbers = [place.get(dof, dof) for dof in draft.run.total_mass_dofs]
    for dof in numbers:
        named, where = isinstance(dof, str), draft.where_total_mass
        if named:
            message = f"fix_total_mass names '{dof[:40]}', which is no label of the model"
            draft.error("MD225", message, where, help=f"give one of {', '.join(draft.labels[:12]) or '1, 2, ...'}")
        elif not 0 <= dof < draft.order:
            message = f"degree of freedom {dof + 1} of fix_total_mass is outside 1 to {draft.order}"
            draft.error("MD317", message, where, help=f"give numbers from 1 to {draft.order}")
    draft.run = replace(draft.run, total_mass_dofs=tuple(numbers))


def nominal(draft: Draft) -> np.ndarray:
    """Values (p,) of the parameters before the test."""
    return np.array([parameter.nominal for parameter in draft.parameters])
