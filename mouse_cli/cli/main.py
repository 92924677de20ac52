"""`mouse`: finds the command, runs it, and turns what went wrong into sentences and exit codes."""

import os
import re
import sys
from importlib import import_module
from inspect import cleandoc
from pathlib import Path

import click

from mouse_cli import __version__, _registry
from mouse_cli._errors import MouseError
from mouse_cli._texts import line

_COMMANDS = "mouse_cli.cli.commands"
_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
COMPLETION = "_MOUSE_COMPLETE"  # set by a shell that asks what may follow
INTERRUPTED = 130
_WORDS = re.compile(r'^def command\(.*?"""(.*?)"""', re.DOTALL | re.MULTILINE)


class _Commands(click.Group):
    """A group whose commands are files: listed without loading them, loaded when called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_registry.names(_COMMANDS))

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        if name not in _registry.names(_COMMANDS):
            return None
        command = import_module(f"{_COMMANDS}.{name}").command
        if COMPLETION not in os.environ:
            return command
        from mouse_cli.cli._completion import completing

        return completing(command)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """As click has it, but of the words in the files of the commands: to import all takes longer than to import numpy."""
        names = self.list_commands(ctx)
        limit = formatter.width - 6 - max(map(len, names))
        with formatter.section("Commands"):
            formatter.write_dl([(name, self._words(ctx, name).get_short_help_str(limit)) for name in names])

    def _words(self, ctx: click.Context, name: str) -> click.Command:
        """A command that has the words of one alone; itself where its file has no source."""
        try:
            source = (Path(__file__).with_name("commands") / f"{name}.py").read_text("utf-8")
        except OSError:
            source = ""
        found = _WORDS.search(source)
        return click.Command(name, help=cleandoc(found[1])) if found else self.get_command(ctx, name)

    def resolve_command(self, ctx: click.Context, args: list[str]):
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            import difflib

            near = difflib.get_close_matches(args[0], self.list_commands(ctx), 1)
            raise click.UsageError(error.message + (f" Did you mean '{near[0]}'?" if near else ""), ctx) from None


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, "-V", "--version", prog_name="mouse", message="%(prog)s %(version)s")
def cli() -> None:
    """Update a structural model from a modal test, and detect when its form is wrong.

    \b
    mouse run deck.dat       update the model of a card deck or YAML deck
    mouse check *.dat        look for errors, compute nothing
    mouse explain MD104      what a diagnostic means
    """


def main(arguments: list[str] | None = None) -> None:
    """Entry point. Exit codes: 0 to 5 and 130, as `mouse explain exit` lists them."""
    for name in _THREADS:  # more threads slow down the small matrices of most decks; the environment has the last word
        os.environ.setdefault(name, "1")
    sys.exit(_run(arguments))


def _run(arguments: list[str] | None) -> int:
    try:
        code = cli.main(arguments, prog_name="mouse", standalone_mode=False)
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except MouseError as error:
        from mouse_cli.cli._terminal import show_diagnostics

        show_diagnostics(error.diagnostics)
        return error.exit_code
    except click.ClickException as error:
        error.message = line(error.message)
        error.show()
        return error.exit_code
    except (KeyboardInterrupt, click.Abort):
        click.echo("mouse: interrupted", err=True)
        return INTERRUPTED
    except BrokenPipeError:  # the reader of our output has gone, e.g. `mouse show deck | head`
        _close_stdout()
        return 1
    except OSError as error:  # standard output cannot take the answer, e.g. the disk is full
        _close_stdout()
        click.echo(f"mouse: error[MD290]: the answer cannot be written: {error.strerror or error}", err=True)
        return 5
    except MemoryError:
        click.echo("mouse: error[MD512]: not enough memory for a model of this size", err=True)
        return 5
    except Exception as error:  # the last resort
        if "MOUSE_TRACEBACK" in os.environ:
            raise
        from mouse_cli._errors import fault
        from mouse_cli.cli._terminal import show_diagnostics

        show_diagnostics([fault(error)])
        return 5


def _close_stdout() -> None:
    """Send what is still to be flushed to nowhere, so that the interpreter does not fail on it at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
