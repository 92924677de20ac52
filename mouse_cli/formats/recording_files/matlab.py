"""MATLAB files (.mat): versions 4 to 7 by SciPy, 7.3 by h5py; fields of a struct are `struct.field`."""

from math import prod

import numpy as np

from mouse_cli.formats.data_files import FileFormat, check_memory
from mouse_cli.formats.matrix_files import hdf5 as hdf5_matrices
from mouse_cli.formats.matrix_files import matlab_elements
from mouse_cli.formats.recording_files import Contents, hdf5, spread

_DEEPEST = 6  # structs in structs


def _read(path: str) -> Contents:
    if hdf5_matrices.claims(path):
        return hdf5.read(path)
    from scipy.io import loadmat, whosmat

    source = matlab_elements.checked(path)
    check_memory(path, sum(8 * prod(shape) for _, shape, _ in whosmat(source)), "the unpacked file")
    found = loadmat(source)
    arrays: dict[str, np.ndarray] = {}
    for name, value in found.items():
        if not name.startswith("__"):
            _gather(name, value, arrays, _DEEPEST)
    return spread(path, arrays)


def _gather(name: str, value: object, arrays: dict[str, np.ndarray], depth: int) -> None:
    """Put the arrays of a variable into `arrays`; a struct of one element is opened."""
    if not isinstance(value, np.ndarray):
        return
    if value.dtype.names and value.size == 1 and depth:
        for field in value.dtype.names:
            _gather(f"{name}.{field}", value[field].item(), arrays, depth - 1)
    elif value.dtype.kind in "biufc":
        arrays[name] = value


FORMAT = FileFormat("mat", _read)
