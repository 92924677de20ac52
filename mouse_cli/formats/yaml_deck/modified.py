"""Decks of modified structures: `modify:` of a YAML deck."""

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.yaml_deck.connections import connections
from mouse_cli.formats.yaml_deck.coupled import lines, opened
from mouse_cli.formats.yaml_deck.coupled_places import Places
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.coupling import ABOVE, BELOW, EXACTLY, MASS, Modification, Substructure, Sweep, Target
from mouse_cli.model.problem import Problem


def read(text: str | bytes, path: str, problem: Problem | None = None, outside: bool = False) -> Modification:
    """The changes that a deck states, and the model they are of, which may be given.

    outside: files may lie outside of the folders of decks that name them. Raises DeckError with all that is wrong.
    """
    section = opened(text, path, "modify", outside)
    document, below = section.document, section.section("modify")
    node = None if below is None else below.nodes.get("deck")
    if problem is None and node is not None:
        problem = read_below(document, node, "modify.deck", read_deck, outside=outside)
    if problem is None:
        raise DeckError(document.diagnostics)
    places = Places(document, [Substructure("", problem)])
    changes = connections(below, "changes", places)
    targets = [_target(each, places) for each in below.listed("targets")]
    sweeps = [_sweep(each) for each in below.listed("sweeps")]
    candidates, responses, forces = (_places(below, key, places) for key in ("places", "responses", "forces"))
    asked, count = lines(below), below.value("count")
    if responses and asked.frequency_hz is None:
        help = "give lines: {band: [lowest, highest], step: Hz}"
        document.error("MD707", below.node, "FRFs are requested, but no lines", help)
    if document.incomplete:
        raise DeckError(document.diagnostics)
    return Modification(
        places.filled()[0], document.path, tuple(changes), tuple(targets), tuple(sweeps), candidates, responses,
        forces or responses, asked, below.value("kind", "receptance"), count, section.value("title", "") or problem.title,
        (*document.diagnostics, *problem.warnings),
    )  # fmt: skip


def _target(section: Section, places: Places) -> Target | None:
    given = [side for side in (BELOW, ABOVE, EXACTLY) if side in section]
    mode, at = section.value("mode"), None
    if len(given) > 1:
        section.error("MD217", f"gives {' and '.join(given)}", "give one of below, above, at")
    if "place" in section:
        found = places.point(section.nodes["place"], section.what("place"))
        at = None if found is None else found.place
    hz = section.value(given[0]) if given else None
    if hz is None or mode is None:
        return None
    if not 0 < hz < float("inf"):
        return section.document.error(
            "MD215", section.nodes[given[0]], f"{section.what(given[0])} is {hz:g} Hz", "give a positive one"
        )
    return Target(mode, given[0], hz, section.value("by", MASS), at, section.document.span(section.node))


def _sweep(section: Section) -> Sweep | None:
    mode, size = section.value("mode"), section.value("size")
    if size is not None and not 0 < size < float("inf"):
        return section.wrong("size", "MD215", f"is {size:g}", "give a positive number")
    return None if mode is None or size is None else Sweep(section.value("by", MASS), size, mode)


def _places(section: Section, key: str, places: Places) -> tuple[int, ...]:
    found = places.points(section.nodes[key], section.what(key)) if key in section else None
    return tuple(point.place for point in found or ())
