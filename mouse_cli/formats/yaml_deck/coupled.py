"""Decks of coupled structures: `couple:` of a YAML deck."""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.frf_source import read_frf
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.connections import connections
from mouse_cli.formats.yaml_deck.coupled_places import Places
from mouse_cli.formats.yaml_deck.files import read_below
from mouse_cli.formats.yaml_deck.frf import pair
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import compose
from mouse_cli.formats.yaml_deck.sections import Section
from mouse_cli.model.coupling import Coupling, Lines, Point, Substructure, Synthesis
from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.problem import Problem
from mouse_cli.model.units import SYSTEMS, UNDECLARED, Units

COUNT, MOST_LINES = 10, 20_000
_REMOVED = 1e-9  # truncation where a part is taken away: what is left of its inside is rounding


def read(text: str | bytes, path: str, outside: bool = False) -> Coupling:
    """The coupled structures that a deck states; `outside`: files may lie outside of the folders of decks that name them.

    Raises DeckError with all that is wrong.
    """
    section = opened(text, path, "couple", outside)
    document, below = section.document, section.section("couple")
    if below is None:
        raise DeckError(document.diagnostics)
    parts = [part for name, each in below.named("substructures").items() if (part := _part(each, name)) is not None]
    places = Places(document, parts)
    interfaces = [] if document.incomplete else _interfaces(below, places)
    joined = [] if document.incomplete else connections(below, "connections", places)
    points = {key: [] if document.incomplete else _points(below, key, places) for key in ("responses", "forces")}
    truncate = below.value("truncate", _REMOVED if any(part.removed for part in parts) else 0.0)
    synthesis = _synthesis(below)
    coupling = Coupling(
        section.value("title", ""), document.path, places.filled(), tuple(interfaces), tuple(joined), tuple(points["responses"]),
        tuple(points["forces"] or points["responses"]), lines(below), below.value("kind", "receptance"), truncate, synthesis,
        _units(section, parts),
    )  # fmt: skip
    if not document.incomplete:
        _sense(below, coupling)
    if document.incomplete:
        raise DeckError(document.diagnostics)
    own = tuple(dict.fromkeys(w for part in parts if part.problem is not None for w in part.problem.warnings))
    return replace(coupling, warnings=(*document.diagnostics, *own))


def opened(text: str | bytes, path: str, key: str, outside: bool = False) -> Section:
    """The top of a deck that holds `key` instead of a model. Raises DeckError."""
    document, root = compose(text, path, outside)
    section = Section(document, root, "deck")
    section.value("mouse")
    if key not in section:
        other = next((k for k in ("couple", "modify", "model") if k in section), "none of these")
        commands = {"couple": "`mouse couple`", "modify": "`mouse modify`", "model": "`mouse run` and the like"}
        message = f"the deck holds {other}, not {key}: {commands.get(other, 'no command')} reads it"
        document.error("MD700", root, message, f"give {key}: {section.definition.keys[key].meaning}")
        raise DeckError(document.diagnostics)
    for alien in (
        "model",
        "couple",
        "modify",
        "parameters",
        "elements",
        "test",
        "prior",
        "laws",
        "run",
        "modal_damping",
        "theory",
    ):
        if alien in section and alien != key:
            message = f"{alien} stands beside {key}; parts have decks of their own"
            document.error("MD700", section.nodes[alien], message, f"move {alien} into the deck of a part")
    return section


def _part(section: Section, name: str) -> Substructure | None:
    """One substructure, its files read; None after an error."""
    document = section.document
    if "deck" in section and "functions" in section:
        return section.error(
            "MD217", "gives both deck and functions", "give deck, with measured: true for its functions; or functions"
        )
    how = {"removed": section.value("remove", False), "reciprocal": section.value("reciprocal", True)}
    if "functions" in section:
        frf = _functions(section)
        return None if frf is None else Substructure(name, None, _named(frf, None), **how)
    problem = None
    if "deck" in section:
        problem = read_below(document, section.nodes["deck"], section.called, read_deck, outside=document.outside)
    if problem is None:
        return None
    if not section.value("measured", False):
        return Substructure(name, problem, **how)
    frf = _chosen(section, problem)
    return None if frf is None else Substructure(name, problem, _named(frf, problem), **how)


def _functions(section: Section) -> FrfTest | None:
    found = read_below(
        section.document, section.nodes["functions"], section.called, read_frf, kind=section.value("kind", "")
    )
    if found is None and not section.document.incomplete:
        message = f"{section.what('functions')} holds no functions that name response and force"
        section.document.error("MD704", section.nodes["functions"], message, "describe the file in test.frf of a deck")
    return None if found is None else found[0]


def _chosen(section: Section, problem: Problem) -> FrfTest | None:
    """The measurement of the deck that is asked for, or the only one."""
    wanted, found = section.value("measurement"), problem.frf
    if wanted is not None:
        found = tuple(each for each in found if each.title == wanted)
    if len(found) == 1:
        return found[0]
    titles = ", ".join(each.title for each in problem.frf) or "none"
    message = f"{section.called} is to be measured, and its deck holds {len(problem.frf)} measurements: {titles}"
    node = section.nodes.get("measurement", section.nodes["deck"])
    return section.document.error("MD704", node, message, "name one of them: measurement: TITLE")


def _named(frf: FrfTest, problem: Problem | None) -> FrfTest:
    """With the names of its responses and forces, which of plain degrees of freedom are their labels."""
    if (frf.output_names and frf.input_names) or problem is None:
        return frf
    labels = problem.structure.labels
    return replace(
        frf,
        output_names=frf.output_names or tuple(labels[i] for i in frf.outputs),
        input_names=frf.input_names or tuple(labels[i] for i in frf.inputs),
    )


def _interfaces(section: Section, places: Places) -> list[tuple[Point, Point]]:
    nodes = section.read("interfaces", yaml_values.items, KINDS["joined"].words) or []
    pairs = (places.pairs(node, f"{section.what('interfaces')}[{i}]") for i, node in enumerate(nodes, 1))
    return [pair for each in pairs for pair in each or ()]


def _points(section: Section, key: str, places: Places) -> list[Point]:
    return (places.points(section.nodes[key], section.what(key)) or []) if key in section else []


def lines(section: Section) -> Lines:
    """The frequencies that a section asks for."""
    below = section.section("lines")
    if below is None:
        return Lines()
    band = below.read("band", pair)
    hz, step = below.value("frequency"), below.value("step")
    if hz is not None:
        if not (np.isfinite(hz).all() and (hz >= 0).all() and (np.diff(hz) > 0).all()):
            below.wrong("frequency", "MD614", "does not ascend from 0 on", "give ascending frequencies in Hz")
        return Lines(hz, band)
    if band is None or step is None:
        return Lines(None, band)
    if not 0 < step < np.inf or not np.isfinite(band).all() or (band[1] - band[0]) / step > MOST_LINES:
        message = f"{below.called} requests lines from {band[0]:g} to {band[1]:g} Hz, {step:g} Hz apart"
        below.document.error(
            "MD614", below.node, message, f"give a positive step that makes at most {MOST_LINES} lines"
        )
        return Lines()
    return Lines(band[0] + step * np.arange(int((band[1] - band[0]) / step + 1e-9) + 1), band)


def _synthesis(section: Section) -> Synthesis | None:
    below = section.section("modes")
    if below is None:
        return None
    keep = below.value("keep", np.zeros(0, int))
    if (np.asarray(keep) < 0).any():
        below.wrong("keep", "MD215", f"holds {int(keep.min())}", "keep 0 modes or more")
    return Synthesis(tuple(below.value("methods", ())), tuple(int(k) for k in keep), below.value("count", COUNT))


def _units(section: Section, parts: list[Substructure]) -> Units:
    """The units of all: those that the deck states, or its parts. Parts of different units are an error."""
    declared = {
        part.name: part.problem.units for part in parts if part.problem is not None and part.problem.units.declared
    }
    if "units" in section:
        declared = {"the deck": SYSTEMS.get(section.value("units", ""), UNDECLARED)} | declared
    if len(set(declared.values())) > 1:
        words = ", ".join(f"{name} in {units.length}, {units.mass}, {units.force}" for name, units in declared.items())
        section.document.error(
            "MD705", section.nodes["couple"], f"parts of different units: {words}", "write all decks in one system"
        )
    return next(iter(declared.values()), UNDECLARED)


def _sense(section: Section, coupling: Coupling) -> None:
    """What only the whole tells: something is joined, the answer can be asked of, functions have lines."""
    document, parts = section.document, coupling.substructures
    if not parts:
        document.error(
            "MD701", section.nodes["substructures"], "couple.substructures names no part", "give {name: {deck: file}}"
        )
    if all(part.removed for part in parts) and parts:
        document.error(
            "MD706", section.nodes["substructures"], "every part is taken away", "leave remove out for what they are in"
        )
    measured = any(part.measured for part in parts)
    if coupling.responses and coupling.lines.frequency_hz is None and not measured:
        message = "FRFs are requested, but no lines, and no part is measured"
        document.error("MD707", section.node, message, "give lines: {band: [lowest, highest], step: Hz}")
    if not coupling.responses and measured:
        message = "a part is given by FRFs, so that the result can only be FRFs, and none are requested"
        document.error("MD707", section.node, message, "give responses: {substructure: degrees of freedom}")
