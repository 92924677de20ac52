"""The matrices of a problem at any values of its parameters: the constant part and the sum of its terms."""

from functools import cached_property

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure
from mouse_cli.model.term import CONSTANT, Slopes, Term
from mouse_cli.terms.matrix_entries import MatrixEntries


class Assembly:
    """K, M (and C, D where there are any) as sums over `terms`; p parameters.

    Dense when the constant part is; else over one sparsity pattern that stays the same for all theta, so that a symbolic
    factorisation may be used again.
    """

    def __init__(self, structure: Structure, terms: tuple[Term, ...], p: int):
        self.n, self.p, self.terms = structure.n, p, terms
        constant = {name: getattr(structure, name) for name in ("K", "M", "C", "D")}
        self._sums = {name: _sum(structure, constant[name], name, terms) for name in constant}

    def matrices(self, theta: np.ndarray) -> tuple[Matrix, Matrix]:
        """K and M (n, n) at theta (p,)."""
        values = [term.values(theta) for term in self.terms]
        return self._sums["K"].at(values), self._sums["M"].at(values)

    def damping(self, theta: np.ndarray) -> tuple[Matrix | None, Matrix | None]:
        """C and D (n, n) at theta (p,); None where no term and no constant part damps."""
        values = [term.values(theta) for term in self.terms]
        return tuple(None if self._sums[name] is None else self._sums[name].at(values) for name in ("C", "D"))

    @property
    def linear(self) -> bool:
        """Whether every derivative is the same for all theta."""
        return all(term.linear for term in self.terms)

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """dK/dtheta and dM/dtheta at theta (p,), all terms together."""
        return self._constant_slopes if self.linear else self._slopes(theta)

    @cached_property
    def _constant_slopes(self) -> dict[str, Slopes]:
        return self._slopes(np.zeros(self.p))

    def _slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        parts = [term.slopes(theta) for term in self.terms]
        return {name: _joined([part[name] for part in parts if name in part]) for name in ("K", "M")}

    def total_mass(self, theta: np.ndarray, dofs: np.ndarray) -> np.ndarray:
        """d(total mass)/d(parameters) (p,): the mass that moves along when `dofs` translate together by 1."""
        M = self.slopes(theta)["M"]
        counted = np.isin(M.row, dofs) & np.isin(M.col, dofs)
        return np.bincount(M.parameter[counted], M.value[counted], minlength=self.p)


def assembly(problem: Problem) -> Assembly:
    """The assembly of `problem`: its listed elements first, then its terms."""
    listed = (MatrixEntries(problem.elements, problem.A, problem.prior.mean),) if len(problem.elements) else ()
    return Assembly(problem.structure, listed + problem.terms, len(problem.parameters))


def _joined(parts: list[Slopes]) -> Slopes:
    if len(parts) < 2:
        return parts[0] if parts else CONSTANT
    return Slopes(*(np.concatenate([getattr(part, f) for part in parts]) for f in ("parameter", "row", "col", "value")))


def _sum(structure: Structure, constant: Matrix | None, name: str, terms: tuple[Term, ...]) -> "_Constant | None":
    """How the matrix `name` is summed; None when nothing contributes to it."""
    own = [i for i, term in enumerate(terms) if name in term.places]
    if not own:
        return None if constant is None else _Constant(constant)
    n = structure.n
    row, col = (np.concatenate([getattr(terms[i].places[name], f) for i in own]) for f in ("row", "col"))
    if is_sparse(structure.K):
        return _Sparse(n, constant, name, own, row, col)
    return _Dense(n, np.zeros((n, n)) if constant is None else constant, name, own, row * n + col)


class _Constant:
    """A matrix that no term touches."""

    def __init__(self, constant: Matrix):
        self.constant = constant

    def at(self, values: list[dict[str, np.ndarray]]) -> Matrix:
        """The matrix, for the values of all terms."""
        return self.constant


class _Dense(_Constant):
    """A dense matrix; flat (z,): places of all contributions."""

    def __init__(self, n: int, constant: np.ndarray, name: str, own: list[int], flat: np.ndarray):
        super().__init__(constant)
        self.n, self.name, self.own, self.flat = n, name, own, flat

    def at(self, values: list[dict[str, np.ndarray]]) -> np.ndarray:
        given = _gathered(values, self.own, self.name)
        return self.constant + np.bincount(self.flat, given, minlength=self.n**2).reshape(self.n, self.n)


class _Sparse(_Constant):
    """A scipy.sparse.csr_array whose pattern is the union of all places, explicit zeros included."""

    def __init__(self, n: int, constant: Matrix | None, name: str, own: list[int], row: np.ndarray, col: np.ndarray):
        super().__init__(constant)
        self.n, self.name, self.own = n, name, own
        base = None if constant is None else constant.tocoo()
        places = [row.astype(np.int64) * n + col]
        if base is not None:
            places.insert(0, base.row.astype(np.int64) * n + base.col)
        pattern, position = np.unique(np.concatenate(places), return_inverse=True)
        known = 0 if base is None else base.nnz
        self.base = np.bincount(position[:known], None if base is None else base.data, minlength=len(pattern)).astype(
            float
        )
        self.position = position[known:]
        self.indices = (pattern % n).astype(np.int32)
        self.indptr = np.searchsorted(pattern, np.arange(n + 1, dtype=np.int64) * n).astype(np.int32)

    def at(self, values: list[dict[str, np.ndarray]]) -> Matrix:
        from scipy.sparse import csr_array

        given = _gathered(values, self.own, self.name)
        data = self.base + np.bincount(self.position, given, minlength=len(self.base))
        matrix = csr_array((data, self.indices, self.indptr), shape=(self.n, self.n))
        matrix.has_canonical_format = True
        return matrix


def _gathered(values: list[dict[str, np.ndarray]], own: list[int], name: str) -> np.ndarray:
    return values[own[0]][name] if len(own) == 1 else np.concatenate([values[i][name] for i in own])
