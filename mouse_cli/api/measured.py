"""Measured data of files, the frequency response functions of recordings, and the modes of both."""

import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from mouse_cli._errors import Diagnostic, RecordError
from mouse_cli._span import Span
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.identification import Identification
from mouse_cli.model.recording import Recording
from mouse_cli.model.spectra import SpectraOptions, SpectraResult


def read_recording(
    path: str | os.PathLike[str], *, forces: Sequence[str] = (), responses: Sequence[str] = (),
    units: Mapping[str, str] | None = None, sample_rate_hz: float | None = None, time: str | None = None,
) -> Recording:  # fmt: skip
    """The recording in a file of time histories: CSV, universal file, LabVIEW, MATLAB, HDF5, NumPy or WAV.

    forces, responses: channels by name or number from 1, each also as `SENSOR=CHANNEL`; without responses all other channels.
    units: by channel. time: the channel that holds the time. Faults of channels that do not forbid their use are warnings of
    Python. Raises RecordError with all that is wrong with the file.

    >>> import mouse_cli, numpy, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     samples = numpy.random.default_rng(1).normal(size=(4096, 2))
    ...     numpy.savetxt(f"{folder}/hit.csv", samples, delimiter=",", header="force,a1", comments="")
    ...     found = mouse_cli.read_recording(f"{folder}/hit.csv", forces=["force"], responses=["1X+=a1"],
    ...         units={"force": "N", "a1": "m/s^2"}, sample_rate_hz=512)
    >>> found.samples.shape, [channel.quantity for channel in found.channels]
    ((4096, 2), ['force', 'acceleration'])
    """
    from mouse_cli.formats.recording_source import Choice, read_recording

    # a file whose channels nobody names is read as responses alone, as `mouse identify --output-only` does
    choice = Choice(tuple(forces), tuple(responses), dict(units or {}), sample_rate_hz, time, every=True)
    found, remarks = read_recording(os.fspath(path), choice)
    _warn(remarks)
    return found


def read_frf(path: str | os.PathLike[str], kind: str = "") -> FrfTest:
    """The frequency response functions of a file that names the response and the force of each, such as a universal file.

    kind: `receptance`, `mobility`, `accelerance`, ... where the file does not say. Raises RecordError, also where the file holds
    none.

    >>> import mouse_cli, tempfile
    >>> from mouse_cli.formats.frf_files import write_frf
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     measured = mouse_cli.read_deck("decks/chain_functions.yaml").frf[0]
    ...     write_frf(measured, f"{folder}/chain.unv", mouse_cli.read_deck("decks/chain_functions.yaml").units)
    ...     found = mouse_cli.read_frf(f"{folder}/chain.unv")
    >>> found.kind, found.H.shape
    ('accelerance', (288, 3, 1))
    """
    from mouse_cli.formats.frf_source import read_frf

    name = os.fspath(path)
    held = read_frf(name, kind)
    if held is None:
        help = "read time histories by read_recording"
        message = "the file holds no frequency response functions"
        raise RecordError.of("MD659", message, Span(name, 1), help=help)
    _warn(held[1])
    return held[0]


def spectra(recordings: Recording | Iterable[Recording], **options: Any) -> SpectraResult:
    """Frequency response functions of recordings with their variance, as `mouse spectra` estimates them.

    Recordings of the same channels are averaged together. options: fields of `SpectraOptions`, such as `estimator="hv"`,
    `window="hann"` or `lines=800`. Raises RecordError where no recording has a force, TypeError for an unknown option.

    >>> import mouse_cli, numpy, tempfile
    >>> force = numpy.random.default_rng(1).normal(size=4096)
    >>> with tempfile.TemporaryDirectory() as folder:  # a mass of 4 kg
    ...     numpy.savetxt(f"{folder}/hit.csv", numpy.c_[force, force / 4], delimiter=",", header="force,a1", comments="")
    ...     recording = mouse_cli.read_recording(f"{folder}/hit.csv", forces=["1X+=force"], responses=["1X+=a1"],
    ...         units={"force": "N", "a1": "m/s^2"}, sample_rate_hz=512)
    >>> functions = mouse_cli.spectra(recording, window="hann", lines=64).measured[0].frf
    >>> abs(functions.H[10:13, 0, 0]).round(3).tolist()
    [0.25, 0.25, 0.25]
    """
    from mouse_cli.records.measurements import measure

    return measure(_each(recordings), SpectraOptions(**options))


def identify(
    measured: FrfTest | Recording | Iterable[FrfTest | Recording], *, band: tuple[float, float] | None = None,
    orders: int | None = None,
) -> Identification:  # fmt: skip
    """Natural frequencies, damping and mode shapes with their covariance, as `mouse identify` finds them.

    measured: functions and recordings, repeats or one force each. Recordings with forces become functions first (`spectra`);
    without any function, responses are identified alone. band: Hz. orders: highest order of the stabilisation diagram. Raises
    RecordError where the data allow no identification.

    >>> import mouse_cli
    >>> modes = mouse_cli.identify(mouse_cli.read_deck("decks/chain_functions.yaml").frf).modes
    >>> modes.frequency_hz.round(1).tolist()
    [12.3, 30.0, 47.4, 59.9, 69.0]
    """
    from mouse_cli.records.identify import identify_frf, identify_recordings

    every = _each(measured)
    functions = [each for each in every if isinstance(each, FrfTest)]
    recordings = [each for each in every if isinstance(each, Recording)]
    forced = [each for each in recordings if len(each.inputs)]
    if forced:
        functions += [each.frf for each in spectra(forced).measured]
    if functions:
        return identify_frf(functions, band, orders)
    if not recordings:
        raise RecordError.of("MD659", "there are no functions and no recordings to identify modes from")
    return identify_recordings(recordings, band, orders)


def _each(measured: Any) -> list[Any]:
    return [measured] if isinstance(measured, FrfTest | Recording) else list(measured)


def _warn(remarks: Iterable[Diagnostic]) -> None:
    for each in remarks:
        warnings.warn(each.headline, stacklevel=3)
