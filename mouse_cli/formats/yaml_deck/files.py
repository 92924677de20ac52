"""Files that a deck names: where it may name them, and read at once."""

import os
from collections.abc import Callable

from mouse_cli._errors import DeckError, Diagnostic
from mouse_cli.formats import below
from mouse_cli.formats.yaml_deck import values as yaml_values
from mouse_cli.formats.yaml_deck.nodes import Document, Node
from mouse_cli.formats.yaml_deck.sections import Section


def read_below(document: Document, node: Node, what: str, read: Callable, **limits: object):
    """What `read(path, **limits)` finds in the file that `node` names; None after an error."""
    path = _path(document, node, what)
    if path is None:
        return None
    try:
        return read(path, **limits)
    except DeckError as error:
        note = f"the file is named at {document.span(node)}"
        for found in error.diagnostics:
            document.diagnostics.append(
                Diagnostic(found.code, found.severity, found.message, found.span, note, found.help)
            )
        document.incomplete = True
        return None


def read_kept(document: Document, node: Node, what: str, read: Callable, **limits: object):
    """What `read` finds in the file of `{file: path}`, or of `{file: path, variable: name}`; None after an error."""
    section = Section(document, node, "file", what)
    if "variable" in section:
        limits["variable"] = section.value("variable")
    return read_below(document, section.nodes["file"], what, read, **limits) if "file" in section else None


def named(document: Document, node: Node, what: str) -> Node | None:
    """The node of the path in `{file: path}`."""
    section = Section(document, node, "file", what)
    return section.nodes.get("file")


def _path(document: Document, node: Node, what: str) -> str | None:
    """Path of the file, where the deck may name it."""
    name = yaml_values.text(document, node, f"{what}.file", "the name of a file")
    if name is None:
        return None
    try:
        path = below.named(document.folder, name, document.outside)
    except below.Refused as error:
        return document.error(error.code, node, f"{what}.file is '{name[:200]}', {error}", error.help)
    return os.path.relpath(path) if path.startswith(os.path.join(os.getcwd(), "")) else path
