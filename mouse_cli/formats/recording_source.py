"""A recording of a file that no deck describes: its channels are told on the command line."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, RecordError
from mouse_cli._span import Span
from mouse_cli.formats.channels import listed
from mouse_cli.formats.own_names import own_picks, own_sensor
from mouse_cli.formats.record_drafts import Findings, Pick
from mouse_cli.formats.recording import recording
from mouse_cli.formats.recording_files import Column, Contents, read_contents
from mouse_cli.formats.sampling import is_time
from mouse_cli.formats.sensor import SensorDraft
from mouse_cli.model.recording import INPUT, OUTPUT, Recording


@dataclass(frozen=True)
class Choice:
    """forces, responses: each `channel` or `SENSOR=channel`; without responses all other channels. units: by channel.

    every: where no channel is chosen and none names its sensor, all are responses.
    """

    forces: tuple[str, ...] = ()
    responses: tuple[str, ...] = ()
    units: dict[str, str] = field(default_factory=dict)
    sample_rate_hz: float | None = None
    time: str | None = None
    segment: tuple[int, int] | None = None
    every: bool = False


def read_recording(path: str, choice: Choice) -> tuple[Recording, tuple[Diagnostic, ...]]:
    """The recording, and warnings. Raises RecordError with all that is wrong with it."""
    contents, say, where = read_contents(path), Findings(), Span(path, 1)
    picks = _picks(contents, choice, where)
    if not picks:
        say.error(
            "MD600",
            where,
            "no channel is chosen",
            "name forces and responses: --force NAME --response NAME; `mouse identify --output-only` takes all as responses",
            listed(contents),
        )
    found = None
    if picks:
        found = recording(
            contents, picks, path, "", say, where, sample_rate_hz=choice.sample_rate_hz, time=choice.time, segment=choice.segment
        )  # fmt: skip
    if found is None or any(d.severity == ERROR for d in say.diagnostics):
        raise RecordError(say.diagnostics)
    return found, tuple(say.diagnostics)


def _picks(contents: Contents, choice: Choice, where: Span) -> list[Pick]:
    chosen = [(INPUT, text) for text in choice.forces] + [(OUTPUT, text) for text in choice.responses]
    own = [] if chosen else own_picks(contents)
    if own or not (chosen or choice.every):
        return own
    picks = [_pick(role, text, choice, where) for role, text in chosen]
    if not choice.responses:
        used = {pick.channel.lower() for pick in picks} | {(choice.time or "").lower()}
        length = max((len(each.values) for each in contents.columns), default=0)
        others = [(i, each) for i, each in enumerate(contents.columns, 1) if not (_spellings(each, i) & used)]
        picks += [_pick(OUTPUT, each.name, choice, where) for _, each in others if _response(each, length)]
    return picks


def _spellings(each: Column, number: int) -> set[str]:
    """How a channel may be called."""
    return {each.name.lower(), each.name.rpartition(".")[2].lower(), str(number)}


def _response(each: Column, length: int) -> bool:
    """Whether a channel that nobody named is one of samples, and no time column."""
    return len(each.values) == length and not is_time(each.name) and not np.iscomplexobj(each.values)


def _pick(role: str, text: str, choice: Choice, where: Span) -> Pick:
    sensor, stroke, name = text.partition("=")
    name = name if stroke else text
    sensor = sensor if stroke else text
    draft = own_sensor(sensor, where) or SensorDraft(sensor, where)
    return Pick(draft, role, name, unit=choice.units.get(name, ""), where=where)
