"""Recordings of a folder put into the text of a deck that names none, for the reader and the writer of decks to find there."""

import os

from mouse_cli.formats.record_drafts import Pick
from mouse_cli.formats.recording_folder import Raw
from mouse_cli.formats.recording_source import Choice
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.nodes import Node, compose, is_null
from mouse_cli.formats.yaml_deck.text import word
from mouse_cli.model.recording import INPUT, OUTPUT


def sensor_names(data: bytes | str, path: str) -> tuple[tuple[str, ...], bool]:
    """Names that `test.sensors` of a deck defines, and whether it names recordings or functions itself. Raises DeckError."""
    _, root = compose(data, path)
    test = yaml_values.keys_of(yaml_values.keys_of(root).get("test"))
    sensors = test["sensors"].value if "sensors" in test and yaml_values.is_list(test["sensors"]) else []
    names = [yaml_values.keys_of(each).get("name") for each in sensors]
    own = tuple(name.value for name in names if name is not None and yaml_values.is_scalar(name))
    return own, "recordings" in test or "frf" in test


def with_recordings(data: bytes | str, path: str, records: tuple[Raw, ...], held: str, choice: Choice) -> str:
    """The text of the deck with the records under `test.recordings`, their files named from its folder; `held` is held out.

    Raises DeckError.
    """
    document, root = compose(data, path)
    listed = ",\n".join(f"    {_entry(each, document.folder, choice)}" for each in records)
    pieces = [("recordings", f"[\n{listed}\n  ]")]
    test = yaml_values.keys_of(root).get("test")
    kept = yaml_values.keys_of(test).get("hold_out")
    text = document.text
    if held and kept is not None and yaml_values.is_mapping(kept):
        text = _inserted(text, kept, [("recordings", f"[{word(held)}]")])
    elif held:
        pieces.append(("hold_out", f"{{recordings: [{word(held)}]}}"))
    if test is not None and yaml_values.is_mapping(test):
        return _inserted(text, test, pieces)  # before `hold_out`, so that its place has not moved
    whole = f"{{{', '.join(f'{key}: {value}' for key, value in pieces)}}}"
    if test is not None and is_null(test):
        return text[: test.start_mark.index] + f" {whole}" + text[test.end_mark.index :]
    return _inserted(text, root, [("test", whole)])


def _inserted(text: str, node: Node, pieces: list[tuple[str, str]]) -> str:
    """The text with keys and their values before all others of a mapping."""
    if node.flow_style:
        at = node.start_mark.index + 1
        return text[:at] + "".join(f"{key}: {value}, " for key, value in pieces) + text[at:]
    at, column = node.value[0][0].start_mark.index, node.value[0][0].start_mark.column
    margin = "\n" + " " * column
    return text[:at] + "".join(f"{key}: {value.replace(chr(10), margin)}{margin}" for key, value in pieces) + text[at:]


def _entry(raw: Raw, folder: str, choice: Choice) -> str:
    """An item of `test.recordings`."""
    name = os.path.relpath(os.path.realpath(raw.path), os.path.realpath(folder)).replace(os.sep, "/")
    keys = {"file": word(name), "title": word(raw.recording.title)}
    if choice.sample_rate_hz is not None:
        keys["sample_rate"] = repr(float(choice.sample_rate_hz))
    if choice.time is not None:
        keys["time"] = word(choice.time)
    if raw.segment is not None:
        keys["segment"] = f"[{raw.segment[0]}, {raw.segment[1]}]"
    for key, role in (("inputs", INPUT), ("outputs", OUTPUT)):
        items = [_channel(pick) for pick in raw.picks if pick.role == role]
        if items:
            keys[key] = f"[{', '.join(items)}]"
    return f"{{{', '.join(f'{key}: {value}' for key, value in keys.items())}}}"


def _channel(pick: Pick) -> str:
    sensor = pick.sensor.name if pick.sensor.name.isdecimal() else word(pick.sensor.name)
    stated = f", unit: {word(pick.unit)}" if pick.unit else ""
    return f"{{sensor: {sensor}, channel: {word(pick.channel)}{stated}}}"
