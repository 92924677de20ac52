"""Sound files (.wav) by SciPy: channels 1, 2, ...; whole numbers are brought to full scale 1."""

import os

import numpy as np

from mouse_cli.formats.data_files import FileFormat, reject
from mouse_cli.formats.recording_files import Column, Contents

_MOST_CHANNELS = 1000


def _read(path: str) -> Contents:
    from scipy.io import wavfile

    _check(path)
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
    """Refuse a head that promises more channels or samples than there are, for which SciPy would make room."""
    with open(path, "rb") as stream:
        head = stream.read(12)
        if head[:4] not in (b"RIFF", b"RIFX", b"RF64") or head[8:] != b"WAVE":
            raise ValueError("no RIFF WAVE head")
        order = "big" if head[:4] == b"RIFX" else "little"
        promised = 0
        while len(head := stream.read(8)) == 8:
            name, size, at = head[:4], int.from_bytes(head[4:], order), stream.tell()
            if name == b"fmt ":
                _check_channels(path, int.from_bytes(stream.read(4)[2:], order))
            elif name == b"ds64":  # sizes of a file beyond 4 GB: of the file, and of its samples
                promised = int.from_bytes(stream.read(16)[8:], order)
            elif name == b"data":
                _check_samples(path, promised or size, os.path.getsize(path) - at)
                size = promised or size
            stream.seek(at + size + size % 2)


def _check_channels(path: str, channels: int) -> None:
    if not 0 < channels <= _MOST_CHANNELS:
        message = f"the head promises {channels} channels; at most {_MOST_CHANNELS} are read"
        reject("MD258", path, message, "the head is damaged: write the file again")


def _check_samples(path: str, promised: int, held: int) -> None:
    if promised > held:
        message = f"the head promises {promised} bytes of samples; {held} follow"
        reject("MD252", path, message, "the file is cut short, or its head was never finished: write it again")


FORMAT = FileFormat("wav", _read)
