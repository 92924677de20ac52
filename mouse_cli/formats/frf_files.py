"""Frequency response functions written to files that `test.frf` of a deck reads: NumPy archives and universal files."""

import io
import os

import numpy as np

from mouse_cli._atomic import write_bytes_atomically
from mouse_cli._errors import WrittenError
from mouse_cli.formats.frf_values import response_unit
from mouse_cli.formats.own_names import direction_code
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.units import UNDECLARED, Units

SUFFIXES = (".npz", ".unv", ".uff")
_DATA_TYPES = {"receptance": 8, "mobility": 11, "accelerance": 12}
_FORCE, _FREQUENCY, _FRF, _COHERENCE = 13, 18, 4, 6


def write_frf(frf: FrfTest, path: str, units: Units = UNDECLARED) -> None:
    """Write all functions to `path`, whole or not at all: .npz with variance and coherence, .unv or .uff with coherence alone.

    Raises WrittenError for another suffix, for sensors that universal files cannot name, and where the file cannot be written.
    """
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in SUFFIXES:
        message = f"functions are not written to '{os.path.basename(path)}'"
        raise WrittenError.of("MD290", message, help=f"give a name that ends in {', '.join(SUFFIXES)}")
    write_bytes_atomically(path, _npz(frf, units) if suffix == ".npz" else _universal(frf, units))


def _npz(frf: FrfTest, units: Units) -> bytes:
    stream = io.BytesIO()
    arrays = {
        "frequency_hz": frf.frequency_hz,
        "H": frf.H,
        "variance": frf.variance,
        "output_names": np.array(frf.output_names),
        "input_names": np.array(frf.input_names),
        "kind": np.array(frf.kind),
        "unit": np.array(response_unit(frf.kind, units)),
        "title": np.array(frf.title),
        "decay_rate": np.array(frf.decay_rate),
    }
    if frf.coherence is not None:
        arrays["coherence"] = frf.coherence
    if frf.window is not None:
        own = {"window": frf.window.name, "block_s": frf.window.seconds, "burst": frf.window.burst}
        arrays |= {key: np.array(value) for key, value in own.items()}
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def _universal(frf: FrfTest, units: Units) -> bytes:
    """Data sets 58 in double precision: each function, and its coherence where there is one force."""
    sets = []
    for i, force in enumerate(frf.input_names):
        for o, response in enumerate(frf.output_names):
            sets.append(_data_set(frf, response, force, frf.H[:, o, i], _FRF, units))
            if frf.coherence is not None and len(frf.input_names) == 1:
                sets.append(_data_set(frf, response, force, frf.coherence[:, o], _COHERENCE, units))
    return "".join(sets).encode("utf-8")


def _data_set(frf: FrfTest, response: str, force: str, values: np.ndarray, type: int, units: Units) -> str:
    """One data set 58: eleven lines of head, numbers as 4E20.12 or, for uneven lines, E13.5 and 2E20.12."""
    hz, is_complex = frf.frequency_hz, np.iscomplexobj(values)
    step = np.diff(hz)
    even = len(step) > 0 and float(np.ptp(step)) <= 1e-9 * hz[-1]
    (node, direction), (reference, along) = (_place(name) for name in (response, force))
    above, _, below = response_unit(frf.kind, units).rpartition("/")
    data = (_DATA_TYPES[frf.kind], above.strip("()")) if type == _FRF else (0, "NONE")
    count = f"{6 if is_complex else 4:10d}{len(hz):10d}"
    head = [
        (frf.title or "NONE")[:80].replace("\n", " "), "NONE", "NONE", "NONE", "NONE",
        f"{type:5d}{0:10d}{1:5d}{0:10d} {'NONE':<10}{node:10d}{direction:4d} {'NONE':<10}{reference:10d}{along:4d}",
        f"{count}{0:10d}{0:13.5e}{0:13.5e}{0:13.5e}",
        _axis(_FREQUENCY, "Hz"), _axis(*data), _axis(*((_FORCE, below) if type == _FRF else (0, "NONE"))), _axis(0, "NONE"),
    ]  # fmt: skip
    if even:
        line = (
            f"{count}{1:10d}"
            + "".join(f"{_short(x):>13}" for x in (hz[0], (hz[-1] - hz[0]) / (len(hz) - 1)))
            + f"{0:13.5e}"
        )
        even, head[6] = (True, line) if _exact(line, hz) else (False, head[6])
    return "\n".join(["    -1", "    58", *head, *_rows(hz, np.nan_to_num(values), even), "    -1", ""])


def _short(value: float) -> str:
    """As many digits as 13 columns hold."""
    return next(text for digits in range(12, 0, -1) if len(text := f"{value:.{digits}g}") <= 12)


def _exact(line: str, hz: np.ndarray) -> bool:
    """Whether the start and the step of a head give the frequencies back."""
    start, step = float(line[30:43]), float(line[43:56])
    return bool(np.abs(start + step * np.arange(len(hz)) - hz).max() <= 1e-9 * hz[-1])


def _rows(hz: np.ndarray, values: np.ndarray, even: bool) -> list[str]:
    parts = np.stack([values.real, values.imag], axis=1) if np.iscomplexobj(values) else values[:, None]
    if even:
        flat = [f"{value:20.12e}" for value in parts.ravel()]
        return ["".join(flat[i : i + 4]) for i in range(0, len(flat), 4)]
    return [f"{f:13.6e}" + "".join(f"{value:20.12e}" for value in row) for f, row in zip(hz, parts, strict=True)]


def _axis(kind: int, unit: str) -> str:
    return f"{kind:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {unit:<20}"


def _place(name: str) -> tuple[int, int]:
    """Node and direction of a sensor. Raises WrittenError for one that is not at a node."""
    found = direction_code(name)
    if found is None:
        message = f"universal files name a node and a direction; '{name}' is none"
        raise WrittenError.of("MD290", message, help="write .npz, or name sensors as 12TY")
    return found
