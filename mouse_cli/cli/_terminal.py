"""What goes to the terminal besides the answer: diagnostics, progress, and where the answer itself goes."""

import sys
from collections.abc import Callable, Iterable

import click

from mouse_cli._errors import ERROR, Diagnostic, frame
from mouse_cli.model.result import Cycle

_COLOURS = {ERROR: "red", "warning": "yellow"}


def show_diagnostics(diagnostics: Iterable[Diagnostic], brief: bool = False) -> None:
    """Print diagnostics to standard error, each with the line it is about; `brief`: the headline alone."""
    for diagnostic in diagnostics:
        text = diagnostic.headline if brief else frame(diagnostic)
        mark = f"{diagnostic.severity}[{diagnostic.code}]"
        if _coloured(sys.stderr):
            text = text.replace(mark, click.style(mark, fg=_COLOURS[diagnostic.severity], bold=True), 1)
        click.echo(text, err=True)


def _coloured(stream) -> bool:
    """Colour only on a terminal, and never where NO_COLOR is set (no-color.org)."""
    import os

    return stream.isatty() and "NO_COLOR" not in os.environ


def json_text(document: dict[str, object]) -> str:
    """A document of the report as text."""
    import json

    return json.dumps(document, indent=1, allow_nan=False)


def deliver(text: str, output: str | None) -> None:
    """Print `text`, or write it to the file `output`, whole or not at all. Raises WrittenError."""
    if not text.endswith("\n"):
        text += "\n"
    if output in (None, "-"):
        click.echo(text, nl=False)
        return
    from mouse_cli._atomic import write_text_atomically

    write_text_atomically(output, text)


def progress() -> Callable[[Cycle], None]:
    """Shows each cycle while it runs, on a terminal only."""
    if not sys.stderr.isatty():
        return lambda cycle: None

    def show(cycle: Cycle) -> None:
        click.echo(f"\r\033[Kcycle {cycle.index}: chi2 {cycle.chi2:.6g}\r", err=True, nl=False)

    return show
