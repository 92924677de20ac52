"""Files that a deck names: below the folder of the deck, and read at once."""

import os
from collections.abc import Callable

from mouse_cli._errors import DeckError, Diagnostic
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
    """A deck from elsewhere must not read beyond its own folder: no absolute path, `..` or link leads out."""
    name = yaml_values.text(document, node, f"{what}.file", "the name of a file")
    if name is None:
        return None
    if "\0" in name:
        return document.error("MD231", node, f"{what}.file holds a null character", "give the name of a file")
    folder = os.path.realpath(document.folder)
    path = os.path.realpath(os.path.join(folder, name))
    if os.path.isabs(name) or not path.startswith(os.path.join(folder, "")):
        message = f"{what}.file is '{name}', which is not below the folder of the deck"
        return document.error("MD231", node, message, "put the file beside the deck and give its name alone")
    return os.path.relpath(path) if path.startswith(os.path.join(os.getcwd(), "")) else path
