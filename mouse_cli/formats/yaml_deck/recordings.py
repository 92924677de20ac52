"""`test: recordings:` of a YAML deck."""

import os
from dataclasses import replace

from mouse_cli.formats.own_names import own_picks
from mouse_cli.formats.record_drafts import Pick, RecordingDraft
from mouse_cli.formats.recording import recording
from mouse_cli.formats.recording_files import Contents, read_contents
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.channel_maps import Known, picks, uncertain
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.recording import INPUT, OUTPUT, Recording
from mouse_cli.model.units import Units

Files = dict[str, Contents | None]


def recordings(test: Section, named: list[SensorDraft], files: Files, units: Units) -> list[RecordingDraft]:
    """Those that could be read; each file is read once."""
    known = {sensor.name: sensor for sensor in named}
    found = [_recording(section, known, files, units) for section in test.listed("recordings")]
    return [one for one in found if one is not None]


def contents(section: Section, files: Files) -> Contents | None:
    """The contents of the file that the section names; None after an error."""
    node = section.nodes.get("file")
    if node is None:
        return None
    name = yaml_values.text(section.document, node, section.what("file"))
    if name is not None and name not in files:
        files[name] = read_below(section.document, node, section.called, read_contents)
    return files.get(name)


def title(section: Section, segment: tuple[int, int] | None = None) -> str:
    """What the deck calls the data, else the name of their file with the segment."""
    name = os.path.splitext(os.path.basename(section.nodes["file"].value))[0] if "file" in section else ""
    return section.value("title", f"{name}[{segment[0]}:{segment[1]}]" if segment else name)


def span(section: Section) -> tuple[int, int] | None:
    """First and last sample; None where not given, or after an error."""
    node = section.nodes.get("segment")
    if node is None:
        return None
    words = KINDS["span"].words
    values = yaml_values.wholes(section.document, node, section.what("segment"), words)
    if values is not None and len(values) != 2:
        return yaml_values.mistyped(section.document, node, section.what("segment"), words)
    return None if values is None else (int(values[0]), int(values[1]))


def _recording(section: Section, known: Known, files: Files, units: Units) -> RecordingDraft | None:
    document, before = section.document, len(section.document.diagnostics)
    usual = uncertain(section)
    chosen = [*picks(section, "inputs", INPUT, known, usual), *picks(section, "outputs", OUTPUT, known, usual)]
    held = contents(section, files)
    segment, rate = span(section), section.value("sample_rate")
    if rate is not None and not 0 < rate < float("inf"):
        section.wrong("sample_rate", "MD215", f"is {rate}; it must be positive", "give it in Hz")
    if held is None or (len(document.diagnostics) > before and document.incomplete):
        return None
    chosen = chosen or own_picks(held)
    if not chosen:
        return section.error("MD211", "chooses no channel", "give outputs: {sensor: channel, ...}")
    where = document.span(section.nodes["file"])
    found = recording(
        held, chosen, section.nodes["file"].value, title(section, segment), document, where,
        sample_rate_hz=rate, time=section.value("time"), segment=segment, units=units,
    )  # fmt: skip
    if found is None or not _alone(section, chosen):
        return None
    mains, drift = (_below_half(section, key, found) for key in ("mains", "drift"))
    if mains is None or drift is None:
        return None
    found = replace(found, free=section.value("free_decay", False), mains_hz=mains, drift_hz=drift)
    return RecordingDraft(found, tuple(pick.sensor for pick in chosen), where)


def _below_half(section: Section, key: str, found: Recording) -> float | None:
    """A frequency below half of the sample rate, Hz; 0 where not given; None after an error."""
    value, most = section.value(key, 0.0), found.sample_rate_hz / 2
    if key not in section or 0 < value < most:
        return value
    message = f"{section.what(key)} is {value:g}; it must be between 0 and half of the sample rate, {most:g}"
    return section.document.error("MD215", section.nodes[key], message, "give it in Hz, or delete it")


def _alone(section: Section, chosen: list[Pick]) -> bool:
    """Whether a free decay has no inputs beside it; an error where it has."""
    if not section.value("free_decay", False) or all(pick.role == OUTPUT for pick in chosen):
        return True
    message = f"{section.called} is a free decay, and has inputs"
    section.document.error("MD645", section.node, message, "delete free_decay where a force acts; else delete inputs")
    return False
