"""Matrices kept in files: one module = one format; here, what every matrix of a model must be.

read(path, variable) of a format gives a real array, dense or sparse, or Contents; `variable` names one of several where `named`.
"""

from dataclasses import dataclass, replace
from math import prod

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats import data_files
from mouse_cli.formats.data_files import check_memory, reject
from mouse_cli.model.arrays import Matrix, dense, is_sparse, upper_triangle
from mouse_cli.model.dof_map import DofMap

MAX_ORDER = 1_000_000  # fits a workstation only when sparse; beyond it an order is a slip
LARGEST_DENSE = 500  # smaller matrices are kept dense: sparse bookkeeping would cost more than the zeros
# Mirror images may differ by so much of the geometric mean of their diagonals: printed digits, no slip.
ROUNDING = 1e-8
_BOTH_TRIANGLES = (
    "give both triangles, or declare it symmetric in the file: "
    "Matrix Market 'symmetric', Harwell-Boeing RSA, DMIG form 6"
)


@dataclass(frozen=True, slots=True)
class Contents:
    """A matrix, and the degrees of freedom that its file names for the rows; None: it names none.

    removed: labels of degrees of freedom that the file holds as constrained, and that were left out.
    """

    matrix: Matrix
    dofs: DofMap | None = None
    removed: frozenset[str] = frozenset()


def read_matrix(path: str, order: int | None = None, variable: str | None = None) -> Matrix:
    """A symmetric matrix (n, n), dense up to order 500, beyond that a scipy.sparse.csr_array.

    Raises DeckError (MD250 to MD262) that names the file, and its line where a text file has one.
    """
    return read_contents(path, order, variable).matrix


def read_contents(path: str, order: int | None = None, variable: str | None = None) -> Contents:
    """The matrix of `read_matrix`, and what its file says about its rows; `order` binds only a matrix that names no rows."""
    found = _read(path, variable)
    matrix = found.matrix
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not matrix.shape[0]:
        message = f"the matrix has shape {tuple(matrix.shape)}; it must be square"
        reject("MD254", path, message, "give all rows and columns")
    n = matrix.shape[0]
    if n > MAX_ORDER:
        reject("MD258", path, f"the matrix has order {n}; at most {MAX_ORDER} is read", "condense the model")
    if order is not None and n != order and found.dofs is None:
        message = f"the matrix has order {n}, but the model has {order}"
        reject("MD257", path, message, f"give a matrix of order {order}")
    kept = dense(matrix) if n <= LARGEST_DENSE else _csr(matrix)
    return replace(found, matrix=_symmetric(path, _finite(path, kept)))


def read_table(path: str, variable: str | None = None) -> np.ndarray:
    """A dense table of any shape, NaN where a value is missing, e.g. mode shapes."""
    table = _read(path, variable).matrix
    check_memory(path, 8 * prod(table.shape), f"the table of shape {tuple(table.shape)}", "give a smaller table")
    table = np.asarray(dense(table), dtype=float)
    if table.ndim != 2:
        message = f"the array has shape {table.shape}; a table has rows and columns"
        reject("MD254", path, message, "save a 2-D array")
    return table


def choose(path: str, variable: str | None, names: list[str]) -> str:
    """Which of the matrices `names` of a file is meant: the one called `variable`, or the only one."""
    known = ", ".join(name[:40] for name in names[:12]) + (", ..." if len(names) > 12 else "")
    if variable is None and len(names) == 1:
        return names[0]
    if not names:
        reject("MD259", path, "the file holds no matrix; expected one", "write the file again, or give another one")
    if variable is None:
        message = f"the file holds {len(names)} matrices ({known}); expected one"
        reject("MD259", path, message, "select one: {file: ..., variable: NAME}")
    same = [name for name in names if name == variable] or [n for n in names if n.lower() == variable.lower()]
    if len(same) != 1:
        reject("MD260", path, f"the file holds no '{variable[:40]}'; it holds {known}", "give one of these")
    return same[0]


def real(path: str, array: Matrix, name: str = "") -> Matrix:
    """The array, when its values are real numbers; MD253 else."""
    if array.dtype.kind not in "fiub":
        what = f"'{name}' is" if name else "the values are"
        reject("MD253", path, f"{what} of type {array.dtype}; K and M are real", "save real numbers")
    return array


def whole(matrix: Matrix) -> None:
    """Raise ValueError when the indices of a sparse matrix do not fit one another; compiled code trusts them."""
    if not hasattr(matrix, "indptr"):
        return
    if (np.diff(matrix.indptr) < 0).any():  # SciPy does not look at those of a matrix without entries
        raise ValueError("the pointers of a sparse matrix descend")
    matrix.check_format(full_check=True)


def _read(path: str, variable: str | None) -> Contents:
    found = data_files.reader(__name__, path, "a matrix file")
    if variable is not None and not found.named:
        message = f"a file of the format '{found.key}' holds one matrix; variable '{variable[:40]}' cannot be looked up"
        reject("MD260", path, message, "delete variable")
    contents = data_files.opened(found, path, variable)
    return contents if isinstance(contents, Contents) else Contents(contents)


def _csr(matrix: Matrix) -> Matrix:
    from scipy.sparse import csr_array

    stored = csr_array(matrix)
    stored.sum_duplicates()
    stored.eliminate_zeros()
    return stored


def _finite(path: str, matrix: Matrix) -> Matrix:
    """The matrix as float64, none of its values NaN or infinite."""
    with np.errstate(over="ignore"):  # of numbers wider than float64, which are infinite then
        matrix = matrix.astype(float)
    if is_sparse(matrix):
        stored = matrix.tocoo()
        bad = np.flatnonzero(~np.isfinite(stored.data))
        at = [(int(stored.row[i]), int(stored.col[i])) for i in bad[:1]]
    else:
        bad = np.argwhere(~np.isfinite(matrix))
        at = [tuple(index) for index in bad[:1].tolist()]
    for i, j in at:
        message = f"{len(bad)} values are not finite, first the one at ({i + 1},{j + 1})"
        reject("MD256", path, message, "give finite numbers")
    return matrix


def _symmetric(path: str, matrix: Matrix) -> Matrix:
    """The matrix with mirror images made equal, when they differ by rounding alone."""
    with np.errstate(over="ignore"):  # a difference beyond the largest number is infinite, and no rounding
        difference = abs(matrix - matrix.T)
    row, col, gap = upper_triangle(difference)
    if not len(row):
        return matrix
    diagonal = np.sqrt(np.abs(matrix.diagonal()))
    scale = np.maximum(diagonal[row] * diagonal[col], np.abs(np.ravel(matrix[row, col])))
    wrong = np.flatnonzero(gap > ROUNDING * scale)
    if len(wrong):
        i, j = int(row[wrong[0]]), int(col[wrong[0]])
        message = (
            f"the matrix is not symmetric: ({i + 1},{j + 1}) is {matrix[i, j]:.10g}, "
            f"but ({j + 1},{i + 1}) is {matrix[j, i]:.10g}; {len(wrong)} such pairs"
        )
        reject("MD255", path, message, _BOTH_TRIANGLES, Span(path, 1))
    return matrix / 2 + matrix.T / 2
