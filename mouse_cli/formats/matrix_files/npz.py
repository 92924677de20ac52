"""NumPy archives (.npz): scipy.sparse.save_npz, or numpy.savez."""

import zipfile
import zlib

import numpy as np

from mouse_cli.formats.matrix_files import MAX_BYTES, MatrixFormat, choose, real, reject, whole
from mouse_cli.model.arrays import Matrix

_HELP = "write it with scipy.sparse.save_npz, or with numpy.savez"
_DAMAGE = (
    ValueError,
    KeyError,
    TypeError,
    IndexError,
    EOFError,
    zipfile.BadZipFile,
    zlib.error,
    NotImplementedError,
    RuntimeError,  # a flag that says the archive is encrypted
)


def _read(path: str, variable: str | None) -> Matrix:
    try:
        _check_size(path)
        with np.load(path, allow_pickle=False) as archive:
            names = archive.files
            if "format" not in names or variable is not None:
                name = choose(path, variable, names)
                return real(path, archive[name], name)
        return real(path, _sparse(path))
    except _DAMAGE as error:
        reject("MD252", path, f"not a NumPy archive: {error}", _HELP)


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
    whole(matrix)
    return matrix


FORMAT = MatrixFormat("npz", _read, named=True)
