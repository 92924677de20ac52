"""`test: hold_out:` of a YAML deck: what it keeps of modes, recordings and frequency response functions, and its way back."""

from collections.abc import Iterable

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.draft import AlteredDraft, HoldOutDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.frf import pair
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.modes import frequency_sd, matching
from mouse_cli.formats.yaml_deck.recordings import span
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.formats.yaml_deck.sensors import place, weights
from mouse_cli.formats.yaml_deck.text import flow, real, word, wrapped
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.hold_out import HoldOut


def hold_out(test: Section | None) -> HoldOutDraft | None:
    """What the deck holds out; None where it holds out nothing."""
    section = test.section("hold_out") if test else None
    if section is None:
        return None
    document, nodes = section.document, section.nodes
    found = HoldOutDraft(document.span(section.node))
    numbers = section.value("modes")
    if numbers is not None:
        found.modes = [(int(n), document.span(node)) for n, node in zip(numbers, nodes["modes"].value, strict=True)]
    if "sensors" in section:
        what = section.what("sensors")
        items = yaml_values.items(document, nodes["sensors"], what, KINDS["dofs"].words) or []
        found.sensors = [(str(place(document, item, what)), document.span(item)) for item in items]
    if any(key in section for key in ("recordings", "segments", "frf", "lines")):
        read_records(section, found)
    if "altered" in section:
        each = [_altered(one) for one in section.listed("altered")]
        found.altered = [one for one in each if one is not None]
    return found


def _altered(section: Section) -> AlteredDraft | None:
    title, hz, document = section.value("title"), section.value("frequency"), section.document
    if title is None or hz is None:
        return None
    number = section.value("number", np.arange(1, len(hz) + 1))
    if not matching(section, "number", len(number), len(hz)):
        return None
    added = [section.read(key, weights) or {} for key in ("mass", "spring")]
    return AlteredDraft(title, document.span(section.node), *added, number, hz, frequency_sd(section, hz))


def hold_out_lines(held: HoldOut, items: list[str], geometry: Geometry | None) -> list[str]:
    """The lines below `hold_out:`; items: how `dofs` names the sensors of the whole test."""
    lines = []
    if len(held.modes):
        lines.append(f"    modes: {flow(map(str, held.whole.number[held.modes]))}")
    if len(held.sensors):
        lines.append(f"    sensors: {wrapped((items[i] for i in held.sensors), 4)}")
    labels = None if geometry is None else geometry.labels()
    if held.altered:
        lines.append("    altered:")
    for one in held.altered:
        lines.append(f"      - title: {word(one.title, flow=False)}")
        for key, added in (("mass", one.masses), ("spring", one.springs)):
            if added:
                lines.append(f"        {key}: {_places(added, labels)}")
        lines.append(f"        number: {flow(map(str, one.number))}")
        lines += [
            f"        frequency: {_numbers(one.frequency_hz)}",
            f"        frequency_sd: {_numbers(one.frequency_sd_hz)}",
        ]
    return lines


def _places(added: dict[int, float], labels: tuple[str, ...] | None) -> str:
    each = (f"{dof + 1 if labels is None else labels[dof]}: {real(value)}" for dof, value in added.items())
    return f"{{{', '.join(each)}}}"


def _numbers(values: Iterable[float]) -> str:
    return wrapped(map(real, values), 8)


def read_records(section: Section, found: HoldOutDraft) -> None:
    """Put titles, stretches and bands into `found`."""
    document = section.document
    found.recordings, found.frf = _titles(section, "recordings"), _titles(section, "frf")
    for each in section.listed("segments"):
        name, samples = each.value("recording"), span(each)
        if name is not None and samples is not None:
            found.segments.append((name, samples, document.span(each.node)))
    for i, item in enumerate(section.read("lines", yaml_values.items, KINDS["pairs of numbers"].words) or [], 1):
        band = pair(document, item, f"{section.what('lines')}[{i}]")
        if band is not None:
            found.lines.append((band, document.span(item)))


def _titles(section: Section, key: str) -> list[tuple[str, Span]]:
    found = section.value(key) or []
    return [
        (name, section.document.span(node))
        for name, node in zip(found, section.nodes[key].value if found else [], strict=True)
    ]
