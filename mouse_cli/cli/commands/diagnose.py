"""mouse diagnose: what the model of a deck lacks."""

import os

import click

from mouse_cli.cli._options import READING, answer_form, options, reading

_FORMS = {".json": "json", ".md": "markdown"}


@click.command()
@click.argument("deck")
@click.option("-o", "--output", metavar="FILE", help="Write the model with the named cause in it as a YAML deck.")
@options(answer_form("mouse.diagnosis/1"))
@click.option(
    "--report",
    "reports",
    metavar="FILE",
    multiple=True,
    help="Write the answer to FILE too: .json, .md, else the printout.",
)
@click.option(
    "--plot", metavar="PATH", help="Write figures: to a folder, or to one file (.pdf, .png, .svg). Needs matplotlib."
)
@click.option("-q", "--quiet", is_flag=True, help="No warnings on standard error.")
@options(READING)
def command(
    deck: str,
    output: str | None,
    form: str | None,
    numbers: str | None,
    reports: tuple[str, ...],
    plot: str | None,
    quiet: bool,
    **how: object,
) -> int:
    """Say what the model of DECK lacks, judged by its test.

    Where, what, how much, and whether it is true. Exit 0: nothing is missing. 1: something is. 4: deck rejected. 5: no answer.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import deliver, progress, show_diagnostics
    from mouse_cli.diagnosis.diagnose import diagnose

    _check_places(deck, output, plot, reports)
    problem = read_problem(deck, **reading(**how))
    if not quiet:
        show_diagnostics(problem.warnings)
    with progress() as (_, say):
        found = diagnose(problem, say)
    files = _revised(found, output)
    for path in reports:
        shape = _FORMS.get(os.path.splitext(path)[1].lower(), "printout")
        deliver(_text(found, shape, numbers, output, files), path, deck)
    if plot:
        from mouse_cli.plots import draw

        draw(found, plot)
    deliver(_text(found, form or "printout", numbers, output, files), None, deck)
    return found.exit_code


def _check_places(deck: str, output: str | None, plot: str | None, reports: tuple[str, ...]) -> None:
    """Refuse, before anything is computed, to write over the deck, and figures that cannot be drawn."""
    for path in (output, plot, *reports):
        if path and os.path.exists(path) and os.path.exists(deck) and os.path.samefile(path, deck):
            raise click.UsageError(f"{path} is the deck itself")
    if plot:
        from mouse_cli.plots import require

        require()


def _revised(found, output: str | None) -> list[str]:
    """Names of the files of the extended deck; none where no cause is named."""
    from mouse_cli.formats import write_deck
    from mouse_cli.model.diagnosis import NAMED

    if output is None or found.kind != NAMED or found.extended is None:
        return []
    return write_deck(found.extended, output)


def _text(found, form: str, numbers: str | None, output: str | None, files: list[str]) -> str:
    """The answer in the form asked for, and what became of `-o`."""
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document, written

    if form == "json":
        return json_text(document(found) | {"revised_deck": files[-1] if files else None})
    text = written(found, form, numbers or "modern")
    return text if output is None else f"{text}\n{_written(found, output, files)}\n"


def _written(found, output: str, files: list[str]) -> str:
    from mouse_cli.model.diagnosis import NAMED

    if files:
        return f"The extended model is in {files[-1]}; `mouse run` accepts it."
    why = "its cause cannot be put into a deck" if found.kind == NAMED else "no cause is named"
    return f"Nothing was written to {output}: {why}."
