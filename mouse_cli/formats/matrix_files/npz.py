"""NumPy archives (.npz): scipy.sparse.save_npz, or numpy.savez."""

import zipfile
import zlib
from math import prod
from typing import BinaryIO

import numpy as np

from mouse_cli.formats.data_files import FileFormat, check_memory, kept, reject
from mouse_cli.formats.matrix_files import choose, real, whole
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
        check(path)
        with np.load(path, allow_pickle=False) as archive:
            names = archive.files
            if "format" not in names or variable is not None:
                name = choose(path, variable, names)
                return real(path, archive[name], name)
        return real(path, _sparse(path))
    except _DAMAGE as error:
        reject("MD252", path, f"not a NumPy archive: {str(error)[:200]}", _HELP)


def check(path: str) -> None:
    """Refuse an archive that unpacks to more than memory holds (MD258), or whose arrays promise more than is packed (MD252).

    NumPy makes room for the shape that an array states before it reads its values. Raises ValueError for damage.
    """
    with zipfile.ZipFile(path) as archive:
        check_memory(path, sum(item.file_size for item in archive.infolist()), "the unpacked archive")
        for item in archive.infolist():
            with archive.open(item) as stream:
                promised = stated(stream)
            if promised > item.file_size:
                message = f"'{item.filename[:60]}' states {promised} bytes of values and holds {item.file_size}"
                reject("MD252", path, message, _HELP)


def check_array(path: str) -> None:
    """The same of an array alone (.npy)."""
    with open(path, "rb") as stream:
        promised = stated(stream)
        if not stream.tell() > len(np.lib.format.MAGIC_PREFIX):
            raise ValueError("no array of NumPy")
    kept(path, promised, "the array")


def stated(stream: BinaryIO) -> int:
    """Bytes of values that the head of a NumPy array states; 0 of what is no array. Raises ValueError."""
    head = np.lib.format
    if stream.read(len(head.MAGIC_PREFIX)) != head.MAGIC_PREFIX:
        return 0
    version = tuple(stream.read(2))
    if version not in ((1, 0), (2, 0)):
        raise ValueError(f"version {version} of arrays is not read")
    shape, _, kind = (head.read_array_header_1_0 if version == (1, 0) else head.read_array_header_2_0)(stream)
    return prod(shape) * max(1, kind.itemsize)


def _sparse(path: str) -> Matrix:
    """A sparse matrix whose indices lie within its shape; scipy's compiled loops take that for granted."""
    from scipy.sparse import load_npz

    matrix = load_npz(path)
    whole(matrix)
    return matrix


FORMAT = FileFormat("npz", _read, named=True)
