"""HDF5 files (.h5, .hdf5, .mat of version 7.3) by h5py: each data set is a channel, or a table of channels side by side.

A data set below groups is `group.name`. Its attribute `unit` or `units`, and `fs`, `sample_rate` or `dt` of it or of a group, are
taken at their word.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from mouse_cli.formats.data_files import FileFormat, check_memory, reject
from mouse_cli.formats.matrix_files import hdf5 as hdf5_matrices
from mouse_cli.formats.recording_files import RATE_NAMES, STEP_NAMES, Contents, npz, spread

_DEEPEST, _LONGEST = 32, 1_000_000  # groups in groups; characters of the texts of one data set
_UNITS = ("unit", "units", "Unit", "Units", "unit_string")


def read(path: str) -> Contents:
    """Every data set of numbers in the file."""
    if not hdf5_matrices.claims(path):
        raise ValueError("no HDF5 signature")
    return hdf5_matrices.isolated(_read, path)


def _read(path: str) -> Contents:
    import h5py

    arrays: dict[str, np.ndarray] = {}
    units: dict[str, str] = {}
    with h5py.File(path, "r") as file:
        _stated(file, arrays, "")
        for name, item in _members(path, h5py, file, set()):
            _take(path, h5py, name, item, arrays, units)
    if all(name in arrays for name in ("frequency_hz", "H")) and "output_names" in arrays:
        return Contents(functions=npz.functions(arrays))
    contents = spread(path, arrays)
    columns = (replace(column, unit=units.get(column.name.partition("[")[0], "")) for column in contents.columns)
    return replace(contents, columns=tuple(columns))


def _take(path: str, h5py: Any, name: str, item: Any, arrays: dict[str, np.ndarray], units: dict[str, str]) -> None:
    if not isinstance(item, h5py.Dataset):
        _stated(item, arrays, f"{name}.")
        return
    held = sum(a.nbytes for a in arrays.values())
    if item.dtype.kind == "V" and item.dtype.names == ("real", "imag"):  # complex numbers of MATLAB
        check_memory(path, held + item.size * item.dtype.itemsize, "the unpacked file")
        values = hdf5_matrices.array(path, item)
        arrays[name] = values["real"] + 1j * values["imag"]
    elif item.dtype.kind in "biufc" and "#refs#" not in name and not _is_text(item):
        check_memory(path, held + 8 * item.size, "the unpacked file")
        arrays[name] = hdf5_matrices.array(path, item)
        _stated(item, arrays, f"{name}.")
    elif item.dtype.kind in "OS" and item.size < 10_000 and not (item.external or item.is_virtual):
        arrays[name] = np.array(_texts(path, name, item))
    units[name] = next((_text(item.attrs[key]) for key in _UNITS if key in item.attrs), "")


def _members(
    path: str, h5py: Any, group: Any, seen: set[int], stem: str = "", depth: int = 0
) -> Iterator[tuple[str, Any]]:
    """`group.name` of every member, and the member itself, each once; links are passed over."""
    if depth > _DEEPEST:
        reject("MD252", path, f"groups are nested deeper than {_DEEPEST}", "write the file again")
    for name in group:
        if isinstance(group.get(name, getlink=True), h5py.HardLink):
            item = group[name]
            place = h5py.h5o.get_info(item.id).addr
            if place in seen:
                continue
            seen.add(place)
            yield f"{stem}{name}", item
            if isinstance(item, h5py.Group):
                yield from _members(path, h5py, item, seen, f"{stem}{name}.", depth + 1)


def _texts(path: str, name: str, item: Any) -> list[str]:
    """The texts of a data set, of which many may stand for one long text."""
    check_memory(path, item.size * item.dtype.itemsize, f"'{name}'")
    found, total = [], 0
    for index in np.ndindex(item.shape):
        found.append(_text(item[index]))
        total += len(found[-1])
        if total > _LONGEST:
            reject(
                "MD258", path, f"'{name}' holds texts of more than {_LONGEST} characters", "leave it out of the file"
            )
    return found


def _stated(item: Any, arrays: dict[str, np.ndarray], stem: str) -> None:
    """Sample rates among the attributes of a group or a data set."""
    for key in item.attrs:
        if key.lower() in RATE_NAMES + STEP_NAMES:
            arrays[f"{stem}{key}"] = np.asarray(item.attrs[key])


def _is_text(item: Any) -> bool:
    return _text(item.attrs.get("MATLAB_class", "")) in ("char", "cell", "logical")


def _text(value: Any) -> str:
    value = value.item() if isinstance(value, np.ndarray) and value.size == 1 else value
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


FORMAT = FileFormat("h5", read, ("h5", "hdf5", "hdf"))
