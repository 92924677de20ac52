"""A folder of raw files as recordings of a model: each channel is the sensor whose name it bears, or that it is said to be."""

import os
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace

from mouse_cli._errors import ERROR, WARNING, Diagnostic, MouseError, RecordError
from mouse_cli._span import Span
from mouse_cli.formats import below
from mouse_cli.formats.channels import bearing, called
from mouse_cli.formats.record_drafts import Findings, Pick
from mouse_cli.formats.recording import recording
from mouse_cli.formats.recording_files import Column, Contents, read_contents
from mouse_cli.formats.recording_source import Choice
from mouse_cli.formats.sampling import is_time
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.channel_units import unit
from mouse_cli.model.recording import FORCES, INPUT, OUTPUT, Recording

_TOKEN = re.compile(r"(?<![A-Za-z0-9])([0-9]+)([-+:_ ]?)([TR][XYZ])(?![A-Za-z0-9])", re.IGNORECASE | re.ASCII)
_SEVERAL = 3  # repeats, of which the last one is held out


@dataclass(frozen=True)
class Sensors:
    """What a channel may be: `named` in the deck's `test.sensors`, or a degree of freedom by its label."""

    named: tuple[str, ...]
    labels: tuple[str, ...]

    def of(self, channel: str) -> str | None:
        """The sensor whose name a channel bears: whole, as `run.12TY` after a group, or as the one `12TY` within `acc 12ty`."""
        own = (channel.strip().lower(), channel.rpartition(".")[2].strip().lower())
        words = [name for name in (*self.named, *self.labels) if not name.isdecimal()]
        whole = next((name for name in words if name.lower() in own), None)
        found = _TOKEN.findall(channel)
        if whole is not None or len(found) != 1:
            return whole
        node, sign, direction = found[0]
        label = f"{node}{direction.upper()}"
        return None if label not in self.labels else f"{node}-{direction.upper()}" if sign == "-" else label

    def knows(self, sensor: str) -> bool:
        """Whether the model has it: a name, a label, `12-TY`, or the number of a degree of freedom."""
        whole = sensor.isdecimal() and 1 <= int(sensor) <= len(self.labels)
        return whole or sensor in (*self.named, *self.labels) or self.of(sensor) == sensor


@dataclass(frozen=True)
class Raw:
    """A recording of the folder: its file, the stretch of it, and which channel is which sensor."""

    path: str
    picks: tuple[Pick, ...]
    recording: Recording
    segment: tuple[int, int] | None = None

    def channels(self, role: str) -> list[tuple[str, str]]:
        """Sensor and channel of each with this role."""
        return [(pick.sensor.name, pick.channel) for pick in self.picks if pick.role == role]


@dataclass(frozen=True)
class RawFolder:
    """records; held: title of the one that is kept from fits, empty where there are too few; unread: files of no such format;
    passed: why other files were passed over; unused: channels that are no sensor."""

    records: tuple[Raw, ...]
    held: str
    unread: tuple[str, ...]
    passed: tuple[Diagnostic, ...]
    unused: tuple[str, ...]


def read_folder(
    folder: str, choice: Choice, sensors: Sensors, outside: bool = False, notice: Callable[[str], None] = lambda text: None
) -> RawFolder:  # fmt: skip
    """All recordings in the files of `folder`, in the order of their names, numbers in them by size.

    Raises RecordError (MD626) where no file has channels that are sensors of the model.
    """
    names = sorted((name for name in os.listdir(folder) if not name.startswith(".")), key=_natural)
    records, unread, passed, unused, clipped = [], [], [], {}, {}
    for k, name in enumerate(names, 1):
        notice(f"reading {name}, {k} of {len(names)}")
        path = os.path.join(folder, name)
        try:
            below.found(folder, path, outside, "the folder of the recordings")
            found, others, clipped[path] = _recordings(path, choice, sensors)
        except below.Refused as error:
            passed.append(
                Diagnostic(error.code, WARNING, f"passed over: the file, {error}", Span(path, 1), help=error.help)
            )
        except MouseError as error:
            own = [each for each in error.diagnostics if each.severity == ERROR]
            strange = any(each.code == "MD251" for each in own)
            unread += [name] if strange else []
            passed += [] if strange else _passed(own)
        else:
            records += found
            unused |= dict.fromkeys(others)
    if not records:
        message = f"none of {len(names)} files in {folder} is a recording of the model"
        help = "map channels to sensors: --force SENSOR=CHANNEL --response SENSOR=CHANNEL"
        raise RecordError((Diagnostic("MD626", ERROR, message, Span(folder, 1), help=help), *passed))
    whole = [each for each in records if not clipped[each.path]]
    if whole:  # no fit needs what a channel has cut off where others have it whole
        passed += _passed([one for each in clipped.values() for one in each])
    records = _titled(whole or records)
    return RawFolder(tuple(records), _held(records), tuple(unread), tuple(passed), tuple(unused))


def _passed(why: list[Diagnostic]) -> list[Diagnostic]:
    return [replace(each, severity=WARNING, message=f"passed over: {each.message}") for each in why]


def _natural(name: str) -> list[tuple[bool, int, str]]:
    """run2 before run10."""
    return [
        (not part.isdecimal(), int(part) if part.isdecimal() else 0, part)
        for part in re.findall(r"[0-9]+|[^0-9]+", name)
    ]


def _recordings(path: str, choice: Choice, sensors: Sensors) -> tuple[list[Raw], list[str], list[Diagnostic]]:
    """Those of one file, its channels that are no sensor, and what is clipped. Raises RecordError with what forbids its use."""
    contents, say, where = read_contents(path), Findings(), Span(path, 1)
    if not contents.columns:
        _refuse(where, "the file holds functions, no recording", "name it in a deck: test: {frf: [{file: ...}]}")
    choice = _whole(choice, contents)
    picks, unused = _picks(contents, choice, sensors, where)
    found = []
    for segment in contents.stretches or (None,):
        one = recording(
            contents, picks, path, "", say, where, sample_rate_hz=choice.sample_rate_hz, time=choice.time, segment=segment
        )  # fmt: skip
        found += [] if one is None else [Raw(path, tuple(picks), one, segment)]
    if any(each.severity == ERROR for each in say.diagnostics):
        raise RecordError(say.diagnostics)
    return found, unused, [each for each in say.diagnostics if each.code == "MD606"]


def _refuse(where: Span, message: str, help: str) -> None:
    raise RecordError.of("MD627", message, where, help=help)


def _picks(contents: Contents, choice: Choice, sensors: Sensors, where: Span) -> tuple[list[Pick], list[str]]:
    """The channels that are sensors, forces first, and the names of those that are none."""
    names = _names(contents)
    here = [text for text in choice.forces if called(contents, text.rpartition("=")[2])]  # a hammer goes from place to place
    said = [(INPUT, text) for text in here or choice.forces] + [(OUTPUT, text) for text in choice.responses]
    picks = [_named(contents, names, role, text, choice, sensors, where) for role, text in said]
    used, unused = {pick.channel for pick in picks}, []
    for name, column in zip(names, contents.columns, strict=True):
        spelled = unit(choice.units.get(column.name, column.unit))
        force = spelled is not None and spelled.quantity in FORCES
        if name in used or _is_time(column, choice) or (choice.responses and not force):
            continue
        sensor = sensors.of(column.name)
        if sensor is not None:
            picks.append(_pick(INPUT if force else OUTPUT, sensor, column, name, choice, where))
        elif force and not choice.forces:
            message = f"channel '{column.name}' is one of {spelled.quantity}, and nothing says where that acts"
            _refuse(where, message, f"say so: --force SENSOR={column.name}")
        else:
            unused.append(column.name)
    if not any(pick.role == OUTPUT for pick in picks):
        listed = ", ".join(column.name for column in contents.columns[:8])
        message = f"no response among its channels has the name of a sensor of the model: {listed}"
        _refuse(
            where,
            message,
            "map them: --response SENSOR=CHANNEL; or name them in the deck: test: {sensors: [...]}",
        )
    return sorted(picks, key=lambda pick: pick.role != INPUT), unused


def _is_time(column: Column, choice: Choice) -> bool:
    return column.name.strip().lower() == (choice.time or "").lower() or is_time(column.name)


def _whole(choice: Choice, contents: Contents) -> Choice:
    """The choice with whole names of the file for its time and for those to which it gives units."""
    names = [each.name for each in contents.columns]
    time = called(contents, choice.time) if choice.time else []
    units = {names[i]: text for name, text in choice.units.items() for i in bearing(names, name)}
    return replace(choice, time=names[time[0]] if len(time) == 1 else choice.time, units=units)


def _names(contents: Contents) -> list[str]:
    """How a deck names each column: by its name, by its number where another bears that too."""
    borne = Counter(each.name.lower() for each in contents.columns)
    return [each.name if borne[each.name.lower()] == 1 else str(i) for i, each in enumerate(contents.columns, 1)]


def _named(
    contents: Contents, names: list[str], role: str, text: str, choice: Choice, sensors: Sensors, where: Span
) -> Pick:  # fmt: skip
    """A channel that the command line names, `CHANNEL` or `SENSOR=CHANNEL`."""
    sensor, stroke, name = text.partition("=")
    name = name if stroke else text
    at = called(contents, name)
    if len(at) != 1:
        listed, count = ", ".join(each.name for each in contents.columns[:8]), "several" if at else "no"
        message = f"the file has {count} channels '{name}'; it has {listed}"
        _refuse(where, message, "name another, or give its number, from 1")
    column = contents.columns[at[0]]
    own = sensor if stroke else sensors.of(column.name)
    if own is None:
        option = "--force" if role == INPUT else "--response"
        _refuse(where, f"nothing says which sensor channel '{name}' is", f"say so: {option} SENSOR={name}")
    return _pick(role, own, column, names[at[0]], choice, where)


def _pick(role: str, sensor: str, column: Column, name: str, choice: Choice, where: Span) -> Pick:
    return Pick(SensorDraft(sensor, where), role, name, unit=choice.units.get(column.name, ""), where=where)


def _titled(records: list[Raw]) -> list[Raw]:
    """Each called after its file, with the suffix where others bear the stem, and with its stretch."""
    stems = [each.recording.title for each in records]
    several = {each.path for each in records if sum(stem == each.recording.title for stem in stems) > 1}
    paths = {stem: {each.path for each in records if each.recording.title == stem} for stem in stems}
    titled = []
    for each in records:
        title = each.recording.title
        if each.path in several and len(paths[title]) > 1:
            title = os.path.basename(each.path)
        if each.segment:
            title = f"{title}[{each.segment[0]}:{each.segment[1]}]"
        titled.append(replace(each, recording=replace(each.recording, title=title)))
    return titled


def _held(records: list[Raw]) -> str:
    """Title of the last of those with the channels and the rate of the first, where there are several."""
    same = lambda each: (
        [(pick.role, pick.sensor.name) for pick in each.picks],
        round(each.recording.sample_rate_hz, 6),
    )
    alike = [each for each in records if same(each) == same(records[0])]
    return alike[-1].recording.title if len(alike) >= _SEVERAL else ""
