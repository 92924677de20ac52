"""HDF5 files (.h5, .hdf5, and .mat of version 7.3), by h5py: a dense data set, or a group that holds a sparse matrix.

A sparse group has, in this order of search: ir, jc, data (MATLAB 7.3); indptr, indices, data with the shape in `shape` or an
attribute (SciPy, AnnData, h5sparse); cidx, ridx, data (Octave); or row, col, data from 0.
"""

import os
from collections.abc import Callable
from importlib.util import find_spec
from mmap import ACCESS_READ, mmap
from typing import Any

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats.data_files import FileFormat, check_memory, reject
from mouse_cli.formats.isolated import call
from mouse_cli.formats.matrix_files import MAX_ORDER, choose, real, whole
from mouse_cli.model.arrays import Matrix

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_HEAP = b"GCOL\x01\0\0\0"
_INSTALL = "pip install 'mouse-cli[hdf5]'"
_SHAPES = ("shape", "h5sparse_shape")  # names of attributes or data sets
_KEYS = ("data", "ir", "jc", "indptr", "indices", "row", "col", "shape")
_OCTAVE = {"jc": "cidx", "ir": "ridx", "nr": "nr"}
_FILTERS = (1, 2, 3, 4, 5, 6, 32000)  # deflate, shuffle, checksum, szip, n-bit, scale-offset; LZF, which h5py brings
_LAYOUTS = ("encoding-type", "format", "h5sparse_format")


def claims(path: str) -> bool:
    """Whether the file is HDF5; MATLAB puts 512 bytes before it."""
    with open(path, "rb") as stream:
        head = stream.read(520)
    return head.startswith(_SIGNATURE) or head[512:] == _SIGNATURE


def check_heaps(path: str) -> None:
    """Raise ValueError where a global heap, which holds texts, has an object without length: the library would not end on it.

    HDF5 File Format Specification 3.0, III.E: a head of 16 bytes, then objects of a head of 16 bytes and data, to 8 bytes.
    """
    with open(path, "rb") as stream, mmap(stream.fileno(), 0, access=ACCESS_READ) as data:
        at = data.find(_HEAP)
        while at >= 0:
            size, place = int.from_bytes(data[at + 8 : at + 16], "little"), at + 16
            while place + 16 <= min(at + size, len(data)):
                length = int.from_bytes(data[place + 8 : place + 16], "little")
                length = 16 + length + -length % 8 if data[place : place + 2] != b"\0\0" else length
                if length < 16 or place + length > at + size:
                    raise ValueError(f"the heap at byte {at} is damaged")
                place += length
            at = data.find(_HEAP, at + 1)


def isolated(read: Callable[..., Any], path: str, *arguments: object) -> Any:
    """What `read(path, *arguments)` gives, which uses h5py: the library may crash on damage. MD261 where it is not installed."""
    if find_spec("h5py") is None:
        reject("MD261", path, "reading HDF5 needs the package h5py, which is not installed", _INSTALL)
    check_heaps(path)
    return call(read, path, *arguments)


def read(path: str, variable: str | None) -> Matrix:
    """The matrix at `variable`, a path such as `model/K`, or the only one at the root."""
    if not claims(path):
        reject("MD252", path, "not an HDF5 file", "write it with h5py, or in MATLAB with save -v7.3")
    return isolated(_read, path, variable)


def _read(path: str, variable: str | None) -> Matrix:
    import h5py

    try:
        with h5py.File(path, "r") as file:
            return _matrix(path, h5py, file, variable)
    except DeckError:
        raise
    except Exception as error:  # h5py reports damage as whatever its parts raise
        reject("MD252", path, f"not a readable HDF5 file: {str(error)[:200]}", "write it again")


def _matrix(path: str, h5py: Any, file: Any, variable: str | None) -> Matrix:
    item = file
    parts = [part for part in (variable or "").replace(".", "/").split("/") if part] or [None]
    for part in parts:
        names = list(item) if isinstance(item, h5py.Group) else []
        if part is None:
            names = [name for name in names if not name.startswith("#")]  # MATLAB's own
        name = choose(path, part, names)
        item = own(path, h5py, item, name)
    if isinstance(item, h5py.Group) and {"type", "value"} == set(item):
        item = own(path, h5py, item, "value")  # as Octave wraps its variables
    if isinstance(item, h5py.Dataset):
        turned = "MATLAB_class" in item.attrs  # MATLAB writes column by column
        found = array(path, item)
        return found.T if turned else found
    return _sparse(path, h5py, item)


def own(path: str, h5py: Any, group: Any, name: str, links: int = 16) -> Any:
    """The member `name` of a group, by way of links too as long as they stay in this file: MD252 else."""
    link = group.get(name, getlink=True)
    if isinstance(link, h5py.ExternalLink) or not links:
        reject("MD252", path, f"'{name}' lies in another file", "copy it into this one")
    if not isinstance(link, h5py.SoftLink):
        return group[name]
    item = group.file if link.path.startswith("/") else group
    for part in link.path.split("/"):
        item = own(path, h5py, item, part, links - 1) if part not in ("", ".") else item
    return item


def array(path: str, dataset: Any) -> np.ndarray:
    """A data set in memory, when it lies in this file, fits, and needs no code from elsewhere to be unpacked."""
    if dataset.external or dataset.is_virtual:
        reject("MD252", path, f"'{dataset.name}' lies in another file", "copy it into this one")
    kind = real(path, dataset, dataset.name).dtype if dataset.dtype.kind != "V" else dataset.dtype
    chunk = np.prod(dataset.chunks, dtype=float) if dataset.chunks else 0
    check_memory(path, int(kind.itemsize * max(dataset.size, chunk)), f"'{dataset.name}' of shape {dataset.shape}")
    plan = dataset.id.get_create_plist()
    strange = [code for code in (plan.get_filter(i)[0] for i in range(plan.get_nfilters())) if code not in _FILTERS]
    if strange:
        message = (
            f"'{dataset.name}' is packed by filter {strange[0]}, which only a plugin undoes; plugins are not loaded"
        )
        reject("MD252", path, message, "write it with gzip")
    if dataset.chunks:
        _check_chunks(path, dataset, plan.get_nfilters(), int(chunk) * dataset.dtype.itemsize)
    return dataset[()]


def _check_chunks(path: str, dataset: Any, filters: int, full: int) -> None:
    """Raise ValueError where a chunk lies outside of the file, is empty, or is not of `full` size though nothing unpacks it."""
    held = os.path.getsize(path)

    def look(chunk: Any) -> None:
        unpacked = chunk.filter_mask == 2**filters - 1
        sound = 0 < chunk.size <= held and chunk.byte_offset is not None and chunk.byte_offset + chunk.size <= held
        if not sound or chunk.filter_mask >= 2**filters or (unpacked and chunk.size != full):
            raise ValueError(f"the chunk of '{dataset.name}' at byte {chunk.byte_offset} is damaged")

    dataset.id.chunk_iter(look)


def _sparse(path: str, h5py: Any, group: Any) -> Matrix:
    from scipy.sparse import coo_array, csc_array, csr_array

    names = set(group)
    parts = {name: array(path, own(path, h5py, group, name)) for name in _KEYS if name in names}
    if {"cidx", "ridx", "nr"} <= names:
        other = {new: np.ravel(array(path, own(path, h5py, group, old))) for new, old in _OCTAVE.items()}
        parts |= other | {"data": np.ravel(parts["data"])}
    shape = _shape(path, group, parts)
    if "jc" in parts:
        found = csc_array((parts["data"], parts["ir"], parts["jc"]), shape=shape)
    elif "indptr" in parts:
        layout = " ".join(_text(group.attrs.get(name, "")) for name in _LAYOUTS)
        kind = csc_array if "csc" in layout else csr_array
        found = kind((parts["data"], parts["indices"], parts["indptr"]), shape=shape)
    elif {"row", "col", "data"} <= parts.keys():
        return coo_array((parts["data"], (parts["row"], parts["col"])), shape=shape)
    else:
        held = ", ".join(list(group)[:12]) or "nothing"
        message = (
            f"the group '{group.name}' holds {held}; expected ir, jc, data; or indptr, indices, data; or row, col, data"
        )
        reject("MD252", path, message, "name the matrix: {file: ..., variable: GROUP/NAME}")
    whole(found)
    return found


def _shape(path: str, group: Any, parts: dict[str, np.ndarray]) -> tuple[int, int]:
    if "jc" in parts:
        columns = len(parts["jc"]) - 1
        rows = int(parts["nr"].item() if "nr" in parts else group.attrs.get("MATLAB_sparse", columns))
    else:
        given = next((np.ravel(group.attrs[name]) for name in _SHAPES if name in group.attrs), parts.get("shape"))
        if given is None:
            given = [len(parts.get("indptr", [0])) - 1] * 2
        rows, columns = (int(x) for x in np.ravel(given))
    if not 0 <= max(rows, columns) <= MAX_ORDER:
        reject("MD258", path, f"'{group.name}' is {rows} x {columns}; at most {MAX_ORDER} is read", "condense it")
    return rows, columns


def _text(value: Any) -> str:
    return value.decode("latin-1") if isinstance(value, bytes) else str(value)


FORMAT = FileFormat("h5", read, ("h5", "hdf5", "hdf"), named=True)
