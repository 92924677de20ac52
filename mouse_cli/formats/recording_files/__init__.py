"""Measured data kept in files: one module = one format; here, what each of them hands over, Contents."""

from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli._errors import DeckError, RecordError
from mouse_cli.formats import data_files
from mouse_cli.formats.data_files import reject
from mouse_cli.model.block_window import BlockWindow

MOST_COLUMNS = 20_000  # of one file
LARGEST = 1e75  # of a measured value: fourth powers of larger ones are beyond all floating-point numbers
RATE_NAMES = ("fs", "sample_rate", "samplerate", "sampling_rate", "samplingrate", "sampling_frequency", "rate")
STEP_NAMES = ("dt", "ts", "time_step", "sample_interval", "deltat", "delta_t")


@dataclass(frozen=True)
class Column:
    """One channel of a file as it stands there: values (k,), real or complex; unit as the file spells it, empty where it is silent.

    step_s: time between samples, None where the file does not say.
    """

    name: str
    values: np.ndarray
    unit: str = ""
    step_s: float | None = None


@dataclass(frozen=True)
class Function:
    """A frequency response function of a file that names its response and its force, as decks write a sensor: `12TY`, `12-TY`.

    frequency_hz, values (f,); kind: of model.frf_test.KINDS, empty where the file does not say; unit: as it spells it.
    variance: E|H - mean|^2 (f,); coherence (f,): both None where the file has none. decay_rate: that of an exponential window, 1/s.
    window: of the blocks that were averaged; None where the file does not say.
    """

    output: str
    input: str
    frequency_hz: np.ndarray
    values: np.ndarray
    kind: str = ""
    unit: str = ""
    variance: np.ndarray | None = None
    coherence: np.ndarray | None = None
    decay_rate: float = 0.0
    window: BlockWindow | None = None


@dataclass(frozen=True)
class Contents:
    """All channels and functions of a file; sample_rate_hz where it states one for all. remarks: what was passed over, and why.

    stretches: first sample and the one after the last of each record, where the file holds several one after another.
    """

    columns: tuple[Column, ...] = ()
    sample_rate_hz: float | None = None
    functions: tuple[Function, ...] = ()
    remarks: tuple[str, ...] = field(default_factory=tuple)
    stretches: tuple[tuple[int, int], ...] = ()


def read_contents(path: str) -> Contents:
    """What the file `path` holds. Raises RecordError (MD250 to MD261, MD601) for one that cannot be read or holds nothing."""
    try:
        form = data_files.reader(__name__, path, "a recording")
        contents = data_files.opened(form, path)
        if not contents.columns and not contents.functions:
            because = f": {'; '.join(contents.remarks[:3])}" if contents.remarks else ""
            reject("MD601", path, f"the file holds no channel of numbers{because}", "give a file with measured data")
    except DeckError as error:
        raise RecordError(error.diagnostics) from error
    return replace(
        contents,
        columns=tuple(replace(each, values=_measured(each.values)) for each in contents.columns),
        functions=tuple(replace(each, values=_measured(each.values)) for each in contents.functions),
    )


def _measured(values: np.ndarray) -> np.ndarray:
    """The values, those that nothing measures (1e75 and more) not a number."""
    with np.errstate(over="ignore"):
        beyond = np.abs(values) >= LARGEST if values.dtype.kind in "fc" else np.False_
    return np.where(beyond, np.nan, values) if beyond.any() else values


def spread(path: str, arrays: dict[str, np.ndarray]) -> Contents:
    """Channels of named arrays: a vector is one, and each column of a table (k, c), `name[1]` to `name[c]`, time along k > c.

    Those of an array (k, a, b) are `name[1,1]` to `name[a,b]`. A number called fs, dt or alike states the sample rate; other
    numbers, texts and empty arrays are passed over.
    """
    columns, rate, passed = [], None, []
    for name, array in arrays.items():
        values = np.squeeze(np.asarray(array))
        stem = name.rpartition(".")[2].lower()
        if values.dtype.kind not in "biufc" or values.ndim > 3 or not values.size:
            passed.append(f"'{name[:40]}' is no vector or table of numbers")
        elif values.ndim == 0:
            rate = _rate(stem, values) or rate
        elif values.ndim == 1:
            columns.append(Column(name, values))
        elif values.ndim == 3:
            table = np.moveaxis(values, int(np.argmax(values.shape)), 0)
            pairs = np.ndindex(table.shape[1:]) if values.size // len(table) <= MOST_COLUMNS else []
            columns += [Column(f"{name}[{i + 1},{j + 1}]", table[:, i, j]) for i, j in pairs]
        else:
            table = values if values.shape[0] >= values.shape[1] else values.T
            columns += [Column(f"{name}[{j + 1}]", table[:, j]) for j in range(min(table.shape[1], MOST_COLUMNS))]
    if len(columns) > MOST_COLUMNS:
        message = f"the file has more than {MOST_COLUMNS} channels"
        reject("MD258", path, message, "save tables with time along the longer side")
    return Contents(tuple(columns), rate, remarks=tuple(passed))


def _rate(name: str, value: np.ndarray) -> float | None:
    """The sample rate in Hz that a number called `name` states."""
    number = float(value.real)
    if not np.isfinite(number) or number <= 0:
        return None
    return number if name in RATE_NAMES else 1 / number if name in STEP_NAMES else None
