"""From a result to what people and programs read: printout, Markdown, JSON document. Reads results and computes nothing.

A subject is an answer of any of the `kinds`.
"""

from dataclasses import replace
from importlib import import_module
from typing import Any

from mouse_cli import __version__
from mouse_cli.report.kinds import kind
from mouse_cli.report.section import Options

__all__ = ["Options", "document", "markdown", "printout", "written"]


def written(
    subject: Any, form: str, numbers: str | None = None, options: Options | None = None, *, short: bool = False
) -> str:
    """The report of `subject` in a `form` of `report.renderers`, in its own style of numbers and to its own place, or to others.

    short: verdict and results alone. Raises ValueError for a form or a style that does not exist.

    >>> import mouse_cli
    >>> text = mouse_cli.written(mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml")), "markdown")
    >>> text.splitlines()[0]
    '## Verdict'
    """
    from mouse_cli.report.numbers import Numbers
    from mouse_cli.report.renderers import renderer
    from mouse_cli.report.section import RESULT, blocks

    chosen, options = renderer(form), options or Options()
    if short or options.level is None:
        options = replace(options, level=RESULT if short else chosen.level)
    return chosen.render(blocks(subject, options), Numbers(numbers or chosen.numbers))


def printout(subject: Any, numbers: str = "legacy", options: Options | None = None) -> str:
    """The report of `subject` as the line printer gave it, no line longer than 132 columns."""
    return written(subject, "printout", numbers, options)


def markdown(subject: Any, numbers: str = "modern", options: Options | None = None) -> str:
    """The report of `subject` in GitHub's Markdown."""
    return written(subject, "markdown", numbers, options)


def document(subject: Any) -> dict[str, Any]:
    """The report of `subject` as JSON can hold it: no NaN, no infinity, plain Python values."""
    from mouse_cli.report.json_values import plain

    body = import_module(f"{__name__}.{kind(type(subject)).document}").document(subject)
    return plain({"schema": body["schema"], "version": __version__, **body})
