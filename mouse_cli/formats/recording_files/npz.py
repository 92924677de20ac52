"""NumPy archives (.npz) and arrays (.npy): vectors are channels, tables are channels side by side.

An archive with frequency_hz (f,), H (f, o, i), output_names (o,) and input_names (i,) holds frequency response functions; `mouse
spectra` writes such ones, with kind, variance (f, o, i) and coherence (f, o), and the window of the blocks, their length block_s.
"""

import sys

import numpy as np

from mouse_cli.formats.data_files import FileFormat
from mouse_cli.formats.matrix_files import npz as npz_matrices
from mouse_cli.formats.recording_files import Contents, Function, spread
from mouse_cli.model.block_window import WINDOWS, BlockWindow

_LONGEST = 200  # characters of a name or a unit
_OWN = ("frequency_hz", "H", "output_names", "input_names")


def _read(path: str) -> Contents:
    if path.lower().endswith(".npy"):
        npz_matrices.check_array(path)
        return spread(path, {"data": np.load(path, allow_pickle=False)})
    npz_matrices.check(path)
    with np.load(path, allow_pickle=False) as archive:
        arrays = {name: archive[name] for name in archive.files}
    if all(name in arrays for name in _OWN):
        return Contents(functions=functions(arrays))
    return spread(path, arrays)


def functions(arrays: dict[str, np.ndarray]) -> tuple[Function, ...]:
    """The functions of an archive that names responses and forces. Raises ValueError where its shapes do not fit."""
    hz, H = np.asarray(arrays["frequency_hz"], float), np.asarray(arrays["H"], complex)
    outputs, inputs = (_texts(arrays[key]) for key in ("output_names", "input_names"))
    shape = (len(hz), len(outputs), len(inputs))
    variance, coherence = (
        np.asarray(arrays[key], float) if key in arrays else None for key in ("variance", "coherence")
    )
    wrong = H.shape != shape or (variance is not None and variance.shape != shape)
    if wrong or (coherence is not None and coherence.shape != shape[:2]):
        raise ValueError(
            f"H, variance and coherence do not fit {shape[0]} lines, {shape[1]} responses and {shape[2]} forces"
        )
    kind, unit = ("".join(_texts(arrays.get(key, ""))) for key in ("kind", "unit"))
    rate = float(arrays["decay_rate"]) if "decay_rate" in arrays else 0.0
    window = _window(arrays) if "window" in arrays else None
    return tuple(
        Function(
            output, force, hz, H[:, o, i], kind, unit,
            None if variance is None else variance[:, o, i],
            None if coherence is None else coherence[:, o], rate, window,
        )
        for i, force in enumerate(inputs)
        for o, output in enumerate(outputs)
    )  # fmt: skip


def _window(arrays: dict[str, np.ndarray]) -> BlockWindow:
    """The window of an archive. Raises ValueError for one that is not known."""
    name = "".join(_texts(arrays["window"]))
    seconds, burst = (float(arrays.get(key, default)) for key, default in (("block_s", np.nan), ("burst", 1.0)))
    if name not in WINDOWS or not 0 < seconds < np.inf or not 0 <= burst <= 1:
        raise ValueError(f"window '{name}' of blocks of {seconds:g} s, burst {burst:g}: none that is known")
    return BlockWindow(name, seconds, burst)


def _texts(array: object) -> list[str]:
    """The texts of an array. Raises ValueError for what is no character, of which Python makes a text nevertheless."""
    words = np.ravel(array)
    if words.dtype.kind == "U" and words.size and words.dtype.itemsize:
        letters = np.frombuffer(words.tobytes(), words.dtype.byteorder.replace("|", "=") + "u4")
        if letters.max() > sys.maxunicode:
            raise ValueError("a text of the archive holds what is no character")
    return [str(word)[:_LONGEST] for word in words]


FORMAT = FileFormat("npz", _read, ("npz", "npy"))
