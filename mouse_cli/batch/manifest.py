"""Manifests: jobs, their options and what is expected of them, in YAML."""

import os
from dataclasses import asdict
from typing import Any

from mouse_cli._errors import DeckError
from mouse_cli.batch.decks import found
from mouse_cli.batch.expectation import Expectation, Unreadable, expectation
from mouse_cli.batch.job import RUN, Job
from mouse_cli.formats import below, file_bytes
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.kinds import KINDS
from mouse_cli.formats.yaml_deck.nodes import Document, Node, compose
from mouse_cli.formats.yaml_deck.run import run_options
from mouse_cli.formats.yaml_deck.sections import Section

_OWN = "the folder of the manifest"


def read(path: str, outside: bool = False) -> list[Job]:
    """The jobs of the manifest `path`, in its order; `outside`: files may lie outside of the folders of those who name them.

    Raises DeckError with all that is wrong with it.
    """
    document, root = compose(file_bytes(path), path, outside)
    whole = Section(document, root, "manifest")
    whole.value("mouse")
    whole.value("title")
    command, options = whole.value("command", RUN), _options(whole)
    nodes = whole.nodes.get("batch")
    each = yaml_values.items(document, nodes, "batch", "a list of jobs") if nodes is not None else None
    if each is not None and not each:
        document.error("MD211", nodes, "batch holds no jobs", "give at least one: - {decks: chain.yaml}")
    jobs = [
        _jobs(Section(document, node, "job", f"batch[{i}]"), command, options) for i, node in enumerate(each or [], 1)
    ]
    if document.incomplete or document.diagnostics:
        raise DeckError(document.diagnostics)
    return [job for some in jobs for job in some]


def _jobs(section: Section, command: str, options: dict[str, Any]) -> list[Job]:
    own = options | _options(section) | _considered(section)
    command, expected = section.value("command", command), _expected(section)
    return [Job(deck, command, own, expected, section.document.outside) for deck in _decks(section)]


def _options(section: Section) -> dict[str, Any]:
    """The run options that are given below `options`, and no others."""
    below = section.section("options")
    if below is None:
        return {}
    run, places = run_options(below)
    values = asdict(run)
    given = {key: values[key] for key in places}
    if values["total_mass_dofs"]:
        given["total_mass_dofs"] = list(values["total_mass_dofs"])
    return given


def _considered(section: Section) -> dict[str, Any]:
    """Options of a diagnosis."""
    causes, names = section.value("causes"), section.value("candidates")
    if names:
        from mouse_cli.diagnosis.likelihoods.candidates import OWN
        from mouse_cli.diagnosis.mechanisms import registry

        known = sorted(registry() | OWN)
        for name in names:
            if name not in known:
                help = f"the candidates are {', '.join(known)}"
                section.document.error("MD907", section.nodes["candidates"], f"there is no candidate '{name}'", help)
    given = {"causes": causes, "candidates": list(names) if names else None}
    return {key: value for key, value in given.items() if value is not None}


def _decks(section: Section) -> list[str]:
    """Paths of the decks; each name must stand for one at least."""
    node, document = section.nodes.get("decks"), section.document
    if node is None:
        return []
    nodes, paths = node.value if yaml_values.is_list(node) else [node], []
    for each in nodes:
        name = yaml_values.text(document, each, section.what("decks"), KINDS["word or words"].words)
        if name is None:
            continue
        try:
            some = _found(document, name)
        except below.Refused as error:
            document.error(error.code, each, f"{section.what('decks')} is '{name[:80]}', {error}", error.help)
            continue
        if not some or not all(os.path.exists(path) for path in some):
            message = f"'{name[:80]}' stands for no deck"
            document.error("MD900", each, message, "names are from the folder of the manifest; check the spelling")
        paths += some
    return paths


def _found(document: Document, name: str) -> list[str]:
    """The decks that `name` stands for. Raises Refused for one that the manifest may not name, before folders are searched."""
    own = os.path.dirname(document.path)
    if not name or "\0" in name or os.path.isabs(name) or os.path.normpath(name).startswith(".."):
        below.named(own, name, document.outside, _OWN)
    some = found(os.path.normpath(os.path.join(own, name)), document.outside)
    for path in some:
        below.found(own, path, document.outside, _OWN)
    return some


def _expected(section: Section) -> tuple[Expectation, ...]:
    node, document, what = section.nodes.get("expect"), section.document, section.what("expect")
    if node is None:
        return ()
    if not yaml_values.is_mapping(node) or ":" in node.tag:
        yaml_values.mistyped(document, node, what, KINDS["expectations"].words)
        return ()
    seen: set[str] = set()
    found = [_expectation(document, key, value, what, seen) for key, value in node.value]
    return tuple(each for each in found if each is not None)


def _expectation(document: Document, key: Node, value: Node, what: str, seen: set[str]) -> Expectation | None:
    name = yaml_values.text(document, key, f"a name in {what}")
    nodes = value.value if yaml_values.is_list(value) else [value]
    words = [
        yaml_values.text(document, each, f"{what}.{name}", "a word, or a number with its tolerance") for each in nodes
    ]
    if name is None or None in words:
        return None
    if name in seen:
        return document.error("MD207", key, f"{what} gives '{name}' twice", "delete one of the two")
    seen.add(name)
    try:
        return expectation(name, tuple(words), document.span(value))
    except Unreadable as error:
        return document.error("MD901", value if words else key, str(error), error.help)
