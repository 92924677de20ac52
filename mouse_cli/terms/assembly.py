"""The matrices of a problem at any values of its parameters: the constant part and the sum of its terms."""

import numpy as np

from mouse_cli.model.arrays import Matrix, is_sparse
from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure
from mouse_cli.model.term import CONSTANT, MATRICES, Places, Slopes, Term
from mouse_cli.terms.matrix_entries import MatrixEntries


class Assembly:
    """K, M (and C, D where there are any) as sums over `terms`; p parameters.

    Dense when the constant part is; else over one sparsity pattern that stays the same for all theta, so that a symbolic
    factorisation may be used again.
    """

    def __init__(self, structure: Structure, terms: tuple[Term, ...], p: int):
        self.n, self.p, self.terms = structure.n, p, terms
        patterns: dict[tuple, _Pattern] = {}
        self._sums = {name: _sum(structure, name, terms, patterns) for name in MATRICES}

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
        """dK/dtheta and dM/dtheta at theta (p,), and of C and D where they move; all terms together; large, and not kept here."""
        parts = [term.slopes(theta) for term in self.terms]
        named = [name for name in MATRICES if name in ("K", "M") or any(name in part for part in parts)]
        return {name: _joined([part[name] for part in parts if name in part]) for name in named}

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


def _sum(
    structure: Structure, name: str, terms: tuple[Term, ...], patterns: dict[tuple, "_Pattern"]
) -> "_Constant | None":
    """How the matrix `name` is summed; None when nothing contributes to it. `patterns`: those of matrices that came before."""
    constant, n = getattr(structure, name), structure.n
    own = [i for i, term in enumerate(terms) if name in term.places]
    if not own:
        return None if constant is None else _Constant(constant)
    places = [terms[i].places[name] for i in own]
    if not is_sparse(structure.K):
        flat = np.concatenate([place.row * np.int64(n) + place.col for place in places])
        return _Dense(np.zeros((n, n)) if constant is None else constant, name, own, flat)
    shared = constant is None or not constant.nnz
    key = (*(id(place) for place in places), *(() if shared else (name,)))
    if key not in patterns:
        patterns[key] = _Pattern(n, None if shared else constant, places)
    return _Sparse(name, own, patterns[key])


class _Constant:
    """A matrix that no term touches."""

    def __init__(self, constant: Matrix):
        self.constant = constant

    def at(self, values: list[dict[str, np.ndarray]]) -> Matrix:
        """The matrix, for the values of all terms."""
        return self.constant


class _Dense:
    """A dense matrix; flat (z,): places of all contributions."""

    def __init__(self, constant: np.ndarray, name: str, own: list[int], flat: np.ndarray):
        self.constant, self.name, self.own, self.flat = constant, name, own, flat

    def at(self, values: list[dict[str, np.ndarray]]) -> np.ndarray:
        """The matrix, for the values of all terms."""
        given, size = _gathered(values, self.own, self.name), self.constant.size
        return self.constant + np.bincount(self.flat, given, minlength=size).reshape(self.constant.shape)


class _Pattern:
    """Rows and columns of all places of a sparse matrix, explicit zeros included; position (z,) of each contribution in it.

    base: the constant part over this pattern, or None.
    """

    def __init__(self, n: int, constant: Matrix | None, places: list[Places]):
        self.n, self.base = n, None
        keys = [place.row * np.int64(n) + place.col for place in places]
        if constant is not None:
            constant = constant.tocoo()
            keys.append(constant.row * np.int64(n) + constant.col)
        pattern, position = np.unique(np.concatenate(keys), return_inverse=True)
        if constant is not None:
            position, at = position[: -constant.nnz], position[-constant.nnz :]
            self.base = np.bincount(at, constant.data, minlength=len(pattern))
        self.position, self.size = position, len(pattern)
        self.indices = (pattern % n).astype(np.int32)
        self.indptr = np.searchsorted(pattern, np.arange(n + 1, dtype=np.int64) * n).astype(np.int32)


class _Sparse:
    """A scipy.sparse.csr_array over one pattern."""

    def __init__(self, name: str, own: list[int], pattern: _Pattern):
        self.name, self.own, self.pattern = name, own, pattern

    def at(self, values: list[dict[str, np.ndarray]]) -> Matrix:
        """The matrix, for the values of all terms."""
        from scipy.sparse import csr_array

        pattern = self.pattern
        data = np.bincount(pattern.position, _gathered(values, self.own, self.name), minlength=pattern.size)
        if pattern.base is not None:
            data += pattern.base
        matrix = csr_array((data, pattern.indices, pattern.indptr), shape=(pattern.n, pattern.n))
        matrix.has_canonical_format = True
        return matrix


def _gathered(values: list[dict[str, np.ndarray]], own: list[int], name: str) -> np.ndarray:
    return values[own[0]][name] if len(own) == 1 else np.concatenate([values[i][name] for i in own])
