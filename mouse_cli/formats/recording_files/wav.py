"""Sound files (.wav) by SciPy: channels 1, 2, ...; whole numbers are brought to full scale 1."""

import warnings

import numpy as np

from mouse_cli.formats.recording_files import MAX_BYTES, Column, Contents, RecordingFormat, reject

_MOST_CHANNELS = 1000


def _read(path: str) -> Contents:
    from scipy.io import wavfile

    _check(path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", wavfile.WavFileWarning)
        rate, samples = wavfile.read(path)
    if not 0 < rate < 1e9 or not samples.size:
        raise ValueError(f"{samples.shape[0]} samples at {rate} a second")
    table = samples.reshape(len(samples), -1)
    full = (
        1.0 if table.dtype.kind == "f" else 128.0 if table.dtype == np.uint8 else float(2 ** (8 * table.itemsize - 1))
    )
    with np.errstate(invalid="ignore"):
        scaled = (table - (128.0 if table.dtype == np.uint8 else 0.0)) / full
    return Contents(tuple(Column(str(j + 1), scaled[:, j]) for j in range(table.shape[1])), float(rate))


def _check(path: str) -> None:
    """Refuse a head that promises more channels than there are, for which SciPy would make room."""
    with open(path, "rb") as stream:
        head = stream.read(64)
    if head[:4] not in (b"RIFF", b"RIFX", b"RF64") or head[8:12] != b"WAVE":
        raise ValueError("no RIFF WAVE head")
    if head[12:16] == b"fmt ":
        channels = int.from_bytes(head[22:24], "big" if head[:4] == b"RIFX" else "little")
        if not 0 < channels <= _MOST_CHANNELS:
            reject(
                "MD258",
                path,
                f"the head promises {channels} channels; at most {_MOST_CHANNELS} are read",
                f"{MAX_BYTES} bytes are read",
            )


FORMAT = RecordingFormat("wav", _read)
