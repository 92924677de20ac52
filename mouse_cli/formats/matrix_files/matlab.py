"""MATLAB files (.mat): versions 4 to 7 by SciPy, 7.3 by the HDF5 reader; a field of a struct is `struct.field`."""

from math import prod

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats.data_files import FileFormat, check_memory, reject
from mouse_cli.formats.matrix_files import choose, hdf5, matlab_elements, real, whole
from mouse_cli.model.arrays import Matrix, is_sparse

_NUMBERS = ("double", "single", "sparse", "logical", *(f"{u}int{bits}" for u in ("", "u") for bits in (8, 16, 32, 64)))


def _read(path: str, variable: str | None) -> Matrix:
    if hdf5.claims(path):
        return hdf5.read(path, variable)
    try:
        return _version_5(path, variable)
    except (DeckError, MemoryError):
        raise
    except Exception as error:  # SciPy's reader of damaged files raises whatever its parts do
        message = f"cut short, or not a MATLAB file: {str(error)[:200]}"
        reject("MD252", path, message, "write it again: save('model.mat', 'K', 'M')")


def _version_5(path: str, variable: str | None) -> Matrix:
    from scipy.io import loadmat, whosmat

    source = matlab_elements.checked(path)
    found = {name: (shape, kind) for name, shape, kind in whosmat(source)}
    head, _, rest = (variable or "").partition(".")
    if rest and variable not in found:
        name = choose(path, head, list(found))
    else:
        rest, numbers = "", [n for n in found if found[n][1] in _NUMBERS]
        name = choose(path, variable, numbers if variable is None else list(found))
    shape, kind = found[name]
    if kind != "sparse":
        check_memory(path, 8 * prod(shape), f"'{name}' of shape {shape}", "save it as sparse")
    value = loadmat(source, variable_names=[name], spmatrix=False)[name]
    for field in rest.split(".") if rest else []:
        value = value[choose(path, field, list(value.dtype.names or []))].item(0)
    if not (isinstance(value, np.ndarray) or is_sparse(value)):
        reject("MD253", path, f"'{variable}' is no matrix", "name a matrix of numbers")
    whole(value)
    return real(path, value, variable or name)


FORMAT = FileFormat("mat", _read, named=True)
