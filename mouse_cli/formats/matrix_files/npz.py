"""NumPy archives (.npz): scipy.sparse.save_npz, or numpy.savez with one array."""

import zipfile
import zlib

import numpy as np

from mouse_cli.formats.matrix_files import MAX_BYTES, MatrixFormat, reject
from mouse_cli.model.arrays import Matrix

_HELP = "write it with scipy.sparse.save_npz, or with numpy.savez and one array"
_DAMAGE = (
    ValueError,
    KeyError,
    TypeError,
    IndexError,
    EOFError,
    zipfile.BadZipFile,
    zlib.error,
    NotImplementedError,
)


def _read(path: str) -> Matrix:
    try:
        _check_size(path)
        with np.load(path, allow_pickle=False) as archive:
            names = archive.files
            array = archive[names[0]] if len(names) == 1 else None
        if array is None and "format" in names:
            array = _sparse(path)
    except _DAMAGE as error:
        reject("MD252", path, f"not a NumPy archive: {error}", _HELP)
    if array is None:
        reject(
            "MD259",
            path,
            f"the archive holds {len(names)} arrays ({', '.join(names[:6])}); expected one",
            _HELP,
        )
    if array.dtype.kind not in "fiu":
        reject("MD253", path, f"the values are of type {array.dtype}; K and M are real", "save real numbers")
    return array


def _check_size(path: str) -> None:
    """A small archive may unpack to more than memory holds."""
    with zipfile.ZipFile(path) as archive:
        size = sum(item.file_size for item in archive.infolist())
    if size > MAX_BYTES:
        reject(
            "MD258",
            path,
            f"the archive unpacks to {size} bytes; at most {MAX_BYTES} are read",
            "condense the model",
        )


def _sparse(path: str) -> Matrix:
    """A sparse matrix whose indices lie within its shape; scipy's compiled loops take that for granted."""
    from scipy.sparse import load_npz

    matrix = load_npz(path)
    if hasattr(matrix, "check_format"):
        matrix.check_format(full_check=True)
    return matrix


FORMAT = MatrixFormat("npz", _read)
