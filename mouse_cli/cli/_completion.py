"""What shells complete beside commands, options and choices: files, names that `mouse list` lists, parameters of a deck."""

import os
from collections.abc import Callable, Iterable

import click
from click.shell_completion import CompletionItem

_FILES = {"FILE", "PATH", "FOLDER", "RESULT", "DECK"}  # what options call a file
_TOPIC = "topic"  # the argument that is no file
_LISTS = {  # options whose values `mouse list` lists
    "--estimator": "estimators",
    "--method": "methods",
    "--expand": "expansions",
    "--candidates": "candidates",
    "--without": "candidates",
    "--figure": "plots",
}
_OF_DECK = {"--loosen", "--vary"}  # options whose values begin with a parameter of the deck
_LARGEST = 1_000_000  # bytes of a deck that is read while somebody waits for a word


def completing(command: click.Command) -> click.Command:
    """`command`, whose parameters tell shells what may stand there."""
    for parameter in command.params:
        if parameter.type is click.STRING:
            parameter.shell_complete = _of(parameter)
    return command


def _of(parameter: click.Parameter) -> Callable[[click.Context, str], list[CompletionItem]]:
    """What completes a parameter, by what it is called."""
    listed = next((_LISTS[each] for each in parameter.opts if each in _LISTS), "")
    if listed:
        return lambda context, begun: _parted(begun, _keys(listed))
    if parameter.name == _TOPIC:
        return lambda context, begun: _items(begun, _topics())
    if _OF_DECK & set(parameter.opts):
        return lambda context, begun: _items(begun, _parameters(context))
    if isinstance(parameter, click.Argument) or parameter.metavar in _FILES:
        return lambda context, begun: [CompletionItem(begun, type="file")]
    return lambda context, begun: []


def _items(begun: str, words: Iterable[str], before: str = "") -> list[CompletionItem]:
    return [CompletionItem(f"{before}{word}") for word in words if word.startswith(begun)]


def _parted(begun: str, words: Iterable[str]) -> list[CompletionItem]:
    """The last of names with commas between."""
    before, comma, last = begun.rpartition(",")
    return _items(last, words, before + comma)


def _keys(kind: str) -> list[str]:
    from mouse_cli.cli.commands.list import entries

    return [key for key, _ in entries(kind)]


def _topics() -> list[str]:
    from mouse_cli.cli.commands.explain import TOPICS

    kinds = ("codes", "estimators", "recursions", "statuses", "elements", "methods", "candidates")
    return sorted({*TOPICS, *(key for kind in kinds for key in _keys(kind))})


def _parameters(context: click.Context) -> list[str]:
    """Names of the parameters of the deck that stands in the line, each with what follows it."""
    from mouse_cli._errors import MouseError
    from mouse_cli.formats import file_bytes, read_draft

    given = (context.params.get("deck"), *context.args)  # the latter while the option has no value
    path = next((each for each in given if each and os.path.isfile(each)), None)
    try:
        if path is None or os.path.getsize(path) > _LARGEST:
            return []
        return [f"{each.name}=" for each in read_draft(file_bytes(path), path).parameters]
    except (OSError, MouseError):
        return []
