"""Supports of imported matrices, by name, and what the model is without them; element sets and what each gives to K and M."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from mouse_cli.model.arrays import Matrix, freeze, is_sparse
from mouse_cli.model.structure import ListedElements, Structure

if TYPE_CHECKING:
    from mouse_cli.model.problem import Problem


@dataclass(frozen=True)
class Thickness:
    """Of shells, nominal t_0: K(t) = sum_n K_n (t / t_0)^n with K_n (N, N) by n, and M likewise."""

    nominal: float
    unit: str
    K: dict[float, Matrix]
    M: dict[float, Matrix]

    @property
    def powers(self) -> tuple[float, ...]:
        """Those of K or M, 1 first."""
        return tuple(dict.fromkeys((1.0, *self.K, *self.M)))


@dataclass(frozen=True)
class ElementGroup:
    """An element set by its name: K and M (N, N), None where it gives nothing; nodes (numbers) that its elements join.

    They are in the degrees of freedom of the model without supports, where it has any. thickness: of shells, else None. missing:
    what K and M lose without it, where that is more than it gives, as others are held by it; else None.
    """

    name: str
    K: Matrix | None = None
    M: Matrix | None = None
    nodes: tuple[int, ...] = ()
    thickness: Thickness | None = None
    missing: tuple[Matrix | None, Matrix | None] | None = None


@dataclass(frozen=True)
class Support:
    """dofs (k,): degrees of freedom (from 0) of the model without supports that it holds."""

    name: str
    dofs: np.ndarray

    def __post_init__(self) -> None:
        freeze(self, int, dofs=(len(self.dofs),))


@dataclass(frozen=True)
class Held:
    """structure: the constant part (N, N) without supports; kept (n,): its degrees of freedom that the deck's model has.

    elements, A (e, p): listed elements with a row or column that a support holds, in the numbers of `structure`.
    """

    structure: Structure
    supports: tuple[Support, ...]
    kept: np.ndarray
    elements: ListedElements
    A: Matrix

    def __post_init__(self) -> None:
        freeze(self, int, kept=(len(self.kept),))


def applied(structure: Structure, kept: np.ndarray) -> Structure:
    """The structure with all held but the degrees of freedom `kept` (n,)."""
    parts = {name: getattr(structure, name) for name in ("K", "M", "C", "D")}
    parts = {name: None if each is None else each[kept][:, kept] for name, each in parts.items()}
    at = structure.geometry
    geometry = None if at is None else replace(at, node=at.node[kept], direction=at.direction[kept])
    return replace(structure, **parts, labels=tuple(structure.labels[i] for i in kept), geometry=geometry)


def places(problem: "Problem") -> np.ndarray:
    """Which degree of freedom (n,) without supports each of the model is; those that were added since come last."""
    held = problem.held
    return np.append(held.kept, held.structure.n + np.arange(problem.structure.n - len(held.kept)))


def freed(problem: "Problem") -> "Problem":
    """The model without its supports, as it is now; test, functions and recordings still count by the degrees of freedom before."""
    held, now = problem.held, problem.structure
    to, total = places(problem), held.structure.n + now.n - len(held.kept)
    before = applied(held.structure, held.kept)
    changed = {
        name: _embedded(getattr(held.structure, name), getattr(before, name), getattr(now, name), to, total)
        for name in ("K", "M", "C", "D")
        if getattr(now, name) is not None
    }
    geometry = held.structure.geometry
    if geometry is not None:
        more = np.full(total - len(geometry.node), -1)
        geometry = replace(
            geometry, node=np.append(geometry.node, more), direction=np.append(geometry.direction, np.abs(more))
        )
    labels = held.structure.labels + now.labels[len(held.kept) :]
    listed = problem.elements
    elements = [(listed.is_mass, to[listed.row], to[listed.col])]
    elements.append((held.elements.is_mass, held.elements.row, held.elements.col))
    is_mass, row, col = (np.concatenate(part) for part in zip(*elements, strict=True))
    order = np.argsort(is_mass, kind="stable")
    A = _stacked(problem.A, held.A)[order]
    low, high = np.minimum(row, col)[order], np.maximum(row, col)[order]
    structure = Structure(**changed, labels=labels, geometry=geometry)
    return replace(problem, structure=structure, elements=ListedElements(is_mass[order], low, high), A=A, held=None)


def _embedded(full: Matrix, before: Matrix, now: Matrix, to: np.ndarray, total: int) -> Matrix:
    """full (N, N) with what became of its kept part `before` since, `now` (n, n), at the places `to` of `total`."""
    from scipy.sparse import coo_array, csr_array

    k = before.shape[0]
    old, new, all_ = (csr_array(each).tocoo() for each in (before, now, full))
    row = np.concatenate([all_.row, to[:k][old.row], to[new.row]])
    col = np.concatenate([all_.col, to[:k][old.col], to[new.col]])
    values = np.concatenate([all_.data, -old.data, new.data])
    found = coo_array((values, (row, col)), shape=(total, total)).tocsr()
    found.eliminate_zeros()
    return found if is_sparse(now) else found.toarray()


def _stacked(A: Matrix, border: Matrix) -> Matrix:
    """A (e, p) above `border`, whose missing columns are those of parameters that were added since."""
    from scipy.sparse import csr_array, hstack, vstack

    wide = A.shape[1] - border.shape[1]
    if not is_sparse(A) and not is_sparse(border):
        return np.vstack([A, np.hstack([border, np.zeros((border.shape[0], wide))])])
    border = hstack([csr_array(border), csr_array((border.shape[0], wide))])
    return csr_array(vstack([csr_array(A), border]))
