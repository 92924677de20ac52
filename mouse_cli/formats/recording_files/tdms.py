"""Files of LabVIEW (.tdms) by nptdms: channels are `group.channel`, with unit and time step of their properties."""

import numpy as np

from mouse_cli.formats.recording_files import MAX_BYTES, MOST_COLUMNS, Column, Contents, RecordingFormat, reject

_UNITS = ("unit_string", "NI_UnitDescription", "Unit", "unit")
_STEP = "wf_increment"


def _read(path: str) -> Contents:
    try:
        from nptdms import TdmsFile
    except ImportError:
        reject(
            "MD261",
            path,
            "reading TDMS needs the package nptdms, which is not installed",
            "pip install 'mouse-cli[tdms]'",
        )
    with TdmsFile.open(path) as file:
        channels = [channel for group in file.groups() for channel in group.channels()]
        if len(channels) > MOST_COLUMNS or sum(8 * len(channel) for channel in channels) > MAX_BYTES:
            reject("MD258", path, f"the file has {len(channels)} channels of more than {MAX_BYTES} bytes", "divide it")
        columns = [_column(channel) for channel in channels]
    return Contents(tuple(column for column in columns if column is not None))


def _column(channel) -> Column | None:
    values = channel[:]
    if not isinstance(values, np.ndarray) or values.dtype.kind not in "biufc" or not values.size:
        return None
    properties = channel.properties
    step = properties.get(_STEP)
    unit = next((str(properties[key]) for key in _UNITS if properties.get(key)), "")
    sound = isinstance(step, int | float) and 0 < step < np.inf
    return Column(f"{channel.group_name}.{channel.name}", values, unit, float(step) if sound else None)


FORMAT = RecordingFormat("tdms", _read)
