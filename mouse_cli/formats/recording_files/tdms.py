"""Files of LabVIEW (.tdms) by nptdms: channels are `group.channel`, with unit and time step of their properties."""

import os
from typing import Any, BinaryIO

import numpy as np

from mouse_cli.formats.data_files import FileFormat, check_memory, kept, reject
from mouse_cli.formats.recording_files import MOST_COLUMNS, Column, Contents

_UNITS = ("unit_string", "NI_UnitDescription", "Unit", "unit")
_SCALES, _MOST_SCALES = "NI_Number_Of_Scales", 100
# Bytes before a segment; flags: channels are listed, most significant byte first
_LEAD, _LISTS, _BIG_ENDIAN = 28, 2, 64
_MOST_LISTED = 10_000_000
_STEP = "wf_increment"


def _read(path: str) -> Contents:
    try:
        from nptdms import TdmsFile
    except ImportError:
        message = "reading TDMS needs the package nptdms, which is not installed"
        reject("MD261", path, message, "pip install 'mouse-cli[tdms]'")
    from nptdms.log import log_manager

    log_manager.set_level("CRITICAL")  # it would write of damage to standard error
    with open(path, "rb") as stream:  # by its name an index beside it would be read too
        _fragments(path, stream)
        return _contents(path, TdmsFile.open(stream))


def _contents(path: str, opened: Any) -> Contents:
    with opened as file:
        channels = [channel for group in file.groups() for channel in group.channels()]
        if len(channels) > MOST_COLUMNS:
            reject(
                "MD258", path, f"the file has {len(channels)} channels; at most {MOST_COLUMNS} are read", "divide it"
            )
        kept(path, sum(len(channel) * _bytes(channel) for channel in channels), "what its channels promise")
        check_memory(path, sum(8 * len(channel) for channel in channels), "the file as numbers")
        columns = [_column(channel) for channel in channels]
    return Contents(tuple(column for column in columns if column is not None))


def _fragments(path: str, stream: BinaryIO) -> None:
    """Refuse (MD258) a file of so many segments with so many channels that to list them takes longer than to read them."""
    at = segments = most = 0
    while True:
        stream.seek(at)
        head = stream.read(_LEAD + 4)
        if len(head) < _LEAD + 4 or head[:4] != b"TDSm":
            break
        contents = int.from_bytes(head[4:8], "little")
        order = "big" if contents & _BIG_ENDIAN else "little"
        segments += 1
        most = max(
            most, min(int.from_bytes(head[_LEAD:], order), os.path.getsize(path) // 8) if contents & _LISTS else 0
        )
        at += _LEAD + int.from_bytes(head[12:20], order)
    stream.seek(0)
    if segments * most > _MOST_LISTED:
        message = f"the file has {segments} segments of up to {most} channels; at most {_MOST_LISTED} are listed in all"
        reject("MD258", path, message, "defragment it, with TDMS Defragment of LabVIEW")


def _bytes(channel) -> int:
    """Bytes of one value in the file at least. Raises ValueError for scales that would be looked for without end."""
    if channel.properties.get(_SCALES, 0) > _MOST_SCALES:
        raise ValueError(f"channel '{channel.name[:40]}' has {channel.properties[_SCALES]} scales")
    return getattr(channel.data_type, "size", None) or 1


def _column(channel) -> Column | None:
    values = channel[:]
    if not isinstance(values, np.ndarray) or values.dtype.kind not in "biufc" or not values.size:
        return None
    properties = channel.properties
    step = properties.get(_STEP)
    unit = next((str(properties[key]) for key in _UNITS if properties.get(key)), "")
    sound = isinstance(step, int | float) and 0 < step < np.inf
    return Column(f"{channel.group_name}.{channel.name}", values, unit, float(step) if sound else None)


FORMAT = FileFormat("tdms", _read)
