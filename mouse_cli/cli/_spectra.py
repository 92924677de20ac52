"""What `mouse spectra` is given: recordings of a deck or of a file, and how to make functions of them."""

from dataclasses import dataclass, fields

import click

from mouse_cli._errors import Diagnostic, RecordError
from mouse_cli._span import Span
from mouse_cli.model.recording import Recording
from mouse_cli.model.spectra import SpectraOptions
from mouse_cli.model.units import UNDECLARED, Units

_OF_FILES = ("forces", "responses", "units", "sample_rate", "time", "segment")


@dataclass(frozen=True)
class Data:
    """recordings; n: degrees of freedom of the model, 0 without one."""

    recordings: tuple[Recording, ...]
    title: str
    n: int = 0
    units: Units = UNDECLARED
    warnings: tuple[Diagnostic, ...] = ()


def spectra_options(given: dict[str, object]) -> SpectraOptions:
    """Those of the command line."""
    return SpectraOptions(**{field.name: given[field.name] for field in fields(SpectraOptions)})


def measured_data(source: str, titles: tuple[str, ...], given: dict[str, object]) -> Data:
    """The recordings of a deck, or of a file. Raises DeckError, RecordError and click.UsageError."""
    if source.lower().endswith((".yaml", ".yml")) or source == "-":
        if any(given[key] for key in _OF_FILES):
            raise click.UsageError("a deck names its channels itself; give --force, --unit, ... for files")
        return _of_deck(source, titles)
    if titles:
        raise click.UsageError("--recording chooses among those of a deck; a file is one recording")
    from mouse_cli.formats.recording_source import read_recording

    found, warnings = read_recording(source, file_choice(given))
    return Data((found,), found.title, warnings=warnings)


def file_choice(given: dict[str, object]):
    """What the options say of the channels of files. Raises click.BadParameter."""
    from mouse_cli.formats.recording_source import Choice

    return Choice(
        given["forces"],
        given["responses"],
        dict(_unit(text) for text in given["units"]),
        given["sample_rate"],
        given["time"],
        given.get("segment"),
        bool(given.get("output_only")),
    )


def _unit(text: str) -> tuple[str, str]:
    channel, stroke, unit = text.rpartition("=")
    if not stroke or not channel:
        raise click.BadParameter(f"'{text}' is not CHANNEL=UNIT", param_hint="--unit")
    return channel, unit


def _of_deck(source: str, titles: tuple[str, ...]) -> Data:
    from mouse_cli.cli._decks import read_problem

    problem = read_problem(source)
    kept = problem.held_records.recordings if problem.held_records and titles else ()
    all_of_it = (*problem.recordings, *kept)
    for title in titles:
        if title not in {each.title for each in all_of_it}:
            known = ", ".join(each.title for each in all_of_it) or "none"
            raise click.BadParameter(f"the deck has no recording '{title}'; it has {known}", param_hint="--recording")
    chosen = tuple(each for each in all_of_it if not titles or each.title in titles)
    if not chosen:
        message = "the deck has no recordings that fits use"
        raise RecordError.of("MD618", message, Span(source, 1), help="give test: {recordings: [...]}")
    return Data(chosen, problem.title.strip(), problem.structure.n, problem.units, problem.warnings)
