"""A folder of raw files on the command line: recordings of a deck that names none, and what was made of them."""

import os
from collections.abc import Callable
from dataclasses import replace

import click

from mouse_cli.cli._options import outside, reading
from mouse_cli.cli._recording_options import CHANNELS
from mouse_cli.model.problem import Problem

RAW = (
    click.option(
        "--recordings",
        "folder",
        metavar="FOLDER",
        type=click.Path(exists=True, file_okay=False),
        help="Raw files of the test, for a deck that names none: channels have the names of sensors, or options map them.",
    ),
    *CHANNELS,
)
_OF_RAW = {
    "forces": "--force",
    "responses": "--response",
    "units": "--unit",
    "sample_rate": "--sample-rate",
    "time": "--time",
}


def refuse_idle(decks: tuple[str, ...], arranged: bool, output: str | None, given: dict[str, object]) -> None:
    """Refuse options that mean nothing without a folder, and a folder where it means nothing. Raises click.UsageError."""
    folder = given["folder"]
    idle = [option for key, option in _OF_RAW.items() if given[key]]
    if folder is None:
        if idle:
            raise click.UsageError(f"{', '.join(idle)} without --recordings FOLDER: a deck names its channels itself")
        return
    if arranged:
        raise click.UsageError("--recordings gives one deck its test; name the files of several in their decks")
    home = "." if decks[0] == "-" else os.path.dirname(decks[0]) or "."
    if not (outside() or _below(folder, home)):
        raise click.UsageError(
            f"{folder} is not below the folder of the deck: put it there, or allow it: --allow-outside"
        )
    if output and not _below(folder, os.path.dirname(output) or "."):
        raise click.UsageError(f"-o {output}: a deck names files below its own folder, and {folder} would not be")


def _below(path: str, folder: str) -> bool:
    root = os.path.realpath(folder)
    return os.path.commonpath([root, os.path.realpath(path)]) == root


def read_raw(deck: str, given: dict[str, object], notice: Callable[[str], None], say: Callable) -> Problem:
    """The problem of the deck with the recordings of the folder as its test; say(lines, diagnostics): what was made of them.

    Raises DeckError, RecordError, and click.UsageError for sensors, channels and decks that the options do not fit.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._spectra import file_choice
    from mouse_cli.formats import is_yaml, read_draft
    from mouse_cli.formats.assemble import assemble
    from mouse_cli.formats.recording_folder import Sensors, read_folder
    from mouse_cli.formats.yaml_deck.add_recordings import sensor_names, with_recordings

    data, path, how = deck_bytes(deck), shown(deck), reading()
    if not is_yaml(data, path):
        raise click.UsageError("--recordings needs a deck in YAML: mouse convert DECK -o deck.yaml")
    if how["overrides"] or how["strip_73_80"]:
        raise click.UsageError("--set and --strip-73-80 are for card decks; --recordings needs one in YAML")
    bare = assemble(read_draft(data, path, outside=outside(), **how))
    named, own = sensor_names(data, path)
    if own:
        raise click.UsageError(f"{deck} names recordings or functions itself: leave out --recordings, or those")
    sensors, choice = Sensors(named, bare.structure.labels), file_choice(given)
    _known(choice, sensors)
    found = read_folder(str(given["folder"]), choice, sensors, outside(), notice)
    _used(choice, found)
    ambient = bare.test is None and not any(each.channels("input") for each in found.records)
    found = replace(found, held="") if ambient else found
    say(_contents(str(given["folder"]), found), found.passed)
    text = with_recordings(data, path, found.records, found.held, choice)
    problem = assemble(read_draft(text, path, outside=outside(), **how))
    return _with_modes(problem, notice, say) if ambient else problem


def _with_modes(problem: Problem, notice: Callable[[str], None], say: Callable) -> Problem:
    """The problem with the modes that its outputs alone show as its test: without forces there is nothing to simulate.

    Raises RecordError where they show none, and where the records are not of one set-up (MD655).
    """
    from mouse_cli._errors import RecordError
    from mouse_cli.cli._identify import of_outputs
    from mouse_cli.records.identify import alike

    try:
        alike(problem.recordings)
    except RecordError as error:
        help = "give those of each set-up a folder of their own: --recordings FOLDER"
        raise RecordError(replace(each, help=help) for each in error.diagnostics) from None
    found = of_outputs(problem, problem.recordings, None, None, notice)
    if found.test is None:
        raise RecordError(found.doubts)
    hz = ", ".join(f"{each:.6g}" for each in found.modes.frequency_hz)
    say(
        [f"  no force was measured: judged by the modes that the responses show, {hz} Hz"],
        (*found.doubts, *found.remarks),
    )
    return replace(problem, test=found.test, recordings=())


def _known(choice, sensors) -> None:
    """Refuse sensors that the model does not have."""
    for option, texts in (("--force", choice.forces), ("--response", choice.responses)):
        for text in texts:
            sensor, stroke, _ = text.partition("=")
            if stroke and not sensors.knows(sensor):
                listed = ", ".join((*sensors.named, *sensors.labels)[:12])
                raise click.BadParameter(f"the model has no sensor '{sensor}'; it has {listed}, ...", param_hint=option)


def _used(choice, found) -> None:
    """Refuse units of channels that no recording has."""
    from mouse_cli.formats.channels import bearing

    channels = sorted({channel.name for each in found.records for channel in each.recording.channels})
    for name in choice.units:
        if not bearing(channels, name):
            raise click.BadParameter(
                f"no recording uses a channel '{name}'; they use {', '.join(channels)}", param_hint="--unit"
            )


def _contents(folder: str, found) -> list[str]:
    """What was read, in lines."""
    files = len({each.path for each in found.records})
    lines = [f"{folder}: {len(found.records)} recordings in {files} files"]
    shapes: dict[tuple, list[str]] = {}
    for each in found.records:
        key = (
            f"{each.recording.sample_rate_hz:.6g} Hz",
            *(_channels(each.channels(role)) for role in ("input", "output")),
        )
        shapes.setdefault(key, []).append(f"{each.recording.title} ({len(each.recording.samples)} samples)")
    for (rate, forces, responses), titles in shapes.items():
        lines.append(f"  {', '.join(titles)}: {rate}, forces {forces or 'none'}, responses {responses}")
    if found.held:
        lines.append(f"  held out from every fit: {found.held}")
    if found.unused:
        lines.append(f"  channels of no sensor: {', '.join(found.unused)}")
    if found.unread:
        lines.append(f"  passed over, of no format of recordings: {', '.join(found.unread)}")
    return lines


def _channels(pairs: list[tuple[str, str]]) -> str:
    return ", ".join(sensor if sensor == channel else f"{sensor} = {channel}" for sensor, channel in pairs)
