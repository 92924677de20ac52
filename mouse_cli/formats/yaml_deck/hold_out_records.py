"""What `test: hold_out:` of a YAML deck keeps of recordings and frequency response functions."""

from mouse_cli._span import Span
from mouse_cli.formats.hold_out_draft import HoldOutDraft
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.frf import pair
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.recordings import span
from mouse_cli.formats.yaml_deck.sections import Section


def read_records(section: Section, found: HoldOutDraft) -> None:
    """Put titles, stretches and bands into `found`."""
    document = section.document
    found.recordings, found.frf = _titles(section, "recordings"), _titles(section, "frf")
    for what, item in _items(section, "segments", "a list, one item for each stretch"):
        each = Section(document, item, "held_segment", what)
        name, samples = each.value("recording"), span(each)
        if name is not None and samples is not None:
            found.segments.append((name, samples, document.span(item)))
    for what, item in _items(section, "lines", KINDS["pairs of numbers"].words):
        band = pair(section, item, what)
        if band is not None:
            found.lines.append((band, document.span(item)))


def _titles(section: Section, key: str) -> list[tuple[str, Span]]:
    found = section.value(key) or []
    return [
        (name, section.document.span(node))
        for name, node in zip(found, section.nodes[key].value if found else [], strict=True)
    ]


def _items(section: Section, key: str, words: str):
    """The items of a list, each with its full name."""
    if key not in section:
        return []
    what = section.what(key)
    nodes = yaml_values.items(section.document, section.nodes[key], what, words) or []
    return [(f"{what}[{i}]", node) for i, node in enumerate(nodes, 1)]
