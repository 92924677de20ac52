"""What goes to the terminal besides the answer: diagnostics, progress, and where the answer itself goes."""

import os
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager

import click

from mouse_cli._errors import ERROR, WARNING, Diagnostic, frame
from mouse_cli._texts import line as on_line
from mouse_cli._texts import shown
from mouse_cli.cli._options import value_of
from mouse_cli.model.result import Cycle

_COLOURS = {ERROR: "red", "warning": "yellow"}
_MOST = 20  # findings of one code that are shown


def show_diagnostics(diagnostics: Iterable[Diagnostic], brief: bool = False) -> None:
    """Print diagnostics to standard error, each with the line it is about, errors first; `brief`: the headline alone.

    Of one code the first 20 are shown, and the others counted.
    """
    found = sorted(diagnostics, key=lambda each: each.severity != ERROR)
    counts: Counter[str] = Counter()
    for diagnostic in found:
        counts[diagnostic.code] += 1
        if counts[diagnostic.code] > _MOST:
            continue
        text = on_line(diagnostic.headline) if brief else frame(diagnostic)
        mark = f"{diagnostic.severity}[{diagnostic.code}]"
        if _coloured(sys.stderr):
            text = text.replace(mark, click.style(mark, fg=_COLOURS[diagnostic.severity], bold=True), 1)
        click.echo(text, err=True)
    for code, count in counts.items():
        if count > _MOST:
            click.echo(f"... and {count - _MOST} more of {code}: `mouse explain {code}`", err=True)


def warn(diagnostics: Iterable[Diagnostic]) -> None:
    """The same, but nothing with --quiet."""
    if not value_of("quiet"):
        show_diagnostics(diagnostics)


def _coloured(stream) -> bool:
    """Colour only on a terminal, and never where NO_COLOR is set (no-color.org)."""
    return stream.isatty() and "NO_COLOR" not in os.environ


def json_text(document: dict[str, object]) -> str:
    """A document of the report as text."""
    import json

    return json.dumps(document, indent=1, allow_nan=False)


def say(text: str, end: str = "\n", commands: bool = False) -> None:
    """Print `text`, whatever names of decks and recordings stand in it; commands: to a server are meant."""
    click.echo(shown(text, commands) + end, nl=False)


def deliver(text: str, output: str | None, deck: str) -> None:
    """Print `text`, or write it to the file `output`, whole or not at all; never over the deck it came from.

    Raises WrittenError.
    """
    if not text.endswith("\n"):
        text += "\n"
    text = shown(text)
    if output in (None, "-"):
        click.echo(text, nl=False)
        return
    if os.path.exists(output) and os.path.exists(deck) and os.path.samefile(output, deck):
        raise click.UsageError(f"-o {output} would overwrite the deck")
    from mouse_cli._atomic import write_text_atomically

    write_text_atomically(output, text)


def check_figures() -> None:
    """Refuse figures that cannot be drawn where --plot says. Raises MouseError (MD530), WrittenError (MD531)."""
    path = value_of("plot")
    if path:
        from mouse_cli.plots import require

        require(path)


def drawn(found: object, path: str | None = None, only: tuple[str, ...] = ()) -> None:
    """Write the figures of an answer to `path`, or where --plot says, or say (MD532) that there are none. Raises WrittenError."""
    path = path or value_of("plot")
    if not path:
        return
    from mouse_cli.plots import draw

    if not draw(found, path, only):
        message = f"nothing was written to {path}: there is nothing to draw of this answer"
        show_diagnostics([Diagnostic("MD532", WARNING, message, help="see `mouse explain MD532`")])


@contextmanager
def progress() -> Iterator[tuple[Callable[[Cycle], None], Callable[[str], None]]]:
    """Shows each cycle, and each phase of a large model, while they run, on a terminal only, and leaves no trace of them."""
    if not sys.stderr.isatty():
        yield lambda cycle: None, lambda text: None
        return
    line = "\r\033[K"  # back to its beginning, and cleared

    def tell(text: str) -> None:
        click.echo(f"{line}{on_line(text)}", err=True, nl=False)

    try:
        yield lambda cycle: tell(f"cycle {cycle.index}: chi2 {cycle.chi2:.6g}"), tell
    finally:
        click.echo(line, err=True, nl=False)
