"""All recordings of a test become frequency response functions: those with the same channels are averaged together."""

from collections.abc import Iterable

from mouse_cli._errors import WARNING, Diagnostic, RecordError
from mouse_cli.model.recording import Recording
from mouse_cli.model.spectra import SpectraOptions, SpectraResult
from mouse_cli.records.spectra import functions


def measure(
    recordings: Iterable[Recording], options: SpectraOptions, n: int = 0, title: str = "", source: str = "",
    warnings: tuple[Diagnostic, ...] = (),
) -> SpectraResult:  # fmt: skip
    """The functions of each set of recordings with the same channels; n: degrees of freedom of the model, 0 without one.

    Recordings without a force are passed over with a warning. Raises RecordError (MD603, MD618 to MD620).
    """
    groups: dict[tuple, list[Recording]] = {}
    remarks = list(warnings)
    for each in recordings:
        if not len(each.inputs):
            message = f"the recording '{each.title}' has no force, and is passed over"
            remarks.append(Diagnostic("MD618", WARNING, message, help="name its force among the inputs"))
            continue
        channels = tuple((c.role, c.sensor or c.name, c.quantity, c.unit) for c in each.channels)
        groups.setdefault(channels, []).append(each)
    if not groups:
        raise RecordError.of("MD618", "no recording has a force", help="name forces: inputs, or --force NAME")
    found = [functions(group, options, n) for group in groups.values()]
    for _, more in found:
        remarks += more
    return SpectraResult(title, source, options, tuple(measured for measured, _ in found), tuple(remarks))
