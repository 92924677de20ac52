"""HDF5 files (.h5, .hdf5, .mat of version 7.3) by h5py: each data set is a channel, or a table of channels side by side.

A data set below groups is `group.name`. Its attribute `unit` or `units`, and `fs`, `sample_rate` or `dt` of it or of a group, are
taken at their word.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from mouse_cli.formats.matrix_files import hdf5 as hdf5_matrices
from mouse_cli.formats.recording_files import (
    MAX_BYTES,
    RATE_NAMES,
    STEP_NAMES,
    Contents,
    RecordingFormat,
    npz,
    reject,
    spread,
)

_UNITS = ("unit", "units", "Unit", "Units", "unit_string")


def read(path: str) -> Contents:
    """Every data set of numbers in the file."""
    if not hdf5_matrices.claims(path):
        raise ValueError("no HDF5 signature")
    try:
        import h5py
    except ImportError:
        reject(
            "MD261",
            path,
            "reading HDF5 needs the package h5py, which is not installed",
            "pip install 'mouse-cli[hdf5]'",
        )
    arrays: dict[str, np.ndarray] = {}
    units: dict[str, str] = {}
    with h5py.File(path, "r") as file:
        _stated(file, arrays, "")
        file.visititems(lambda name, item: _take(path, h5py, name, item, arrays, units))
    if all(name in arrays for name in ("frequency_hz", "H")) and "output_names" in arrays:
        return Contents(functions=npz.functions(arrays))
    contents = spread(path, arrays)
    columns = (replace(column, unit=units.get(column.name.partition("[")[0], "")) for column in contents.columns)
    return replace(contents, columns=tuple(columns))


def _take(path: str, h5py: Any, name: str, item: Any, arrays: dict[str, np.ndarray], units: dict[str, str]) -> None:
    name = name.replace("/", ".")
    if not isinstance(item, h5py.Dataset):
        _stated(item, arrays, f"{name}.")
        return
    if item.external or item.is_virtual:
        reject("MD252", path, f"'{name}' lies in another file", "copy it into this one")
    if item.dtype.kind == "V" and item.dtype.names == ("real", "imag"):  # complex numbers of MATLAB
        values = item[()]
        arrays[name] = values["real"] + 1j * values["imag"]
    elif item.dtype.kind in "biufc" and "#refs#" not in name and not _is_text(item):
        if sum(a.nbytes for a in arrays.values()) + 8 * item.size > MAX_BYTES:
            reject("MD258", path, f"the file unpacks to more than {MAX_BYTES} bytes", "divide it")
        arrays[name] = item[()]
        _stated(item, arrays, f"{name}.")
    elif item.dtype.kind in "OS" and item.size < 10_000:
        arrays[name] = np.array([_text(value) for value in np.ravel(item[()])])
    units[name] = next((_text(item.attrs[key]) for key in _UNITS if key in item.attrs), "")


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


FORMAT = RecordingFormat("h5", read, ("h5", "hdf5", "hdf"))
