"""mouse compare: methods of updating side by side, as in lecture 21-1."""

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._options import QUIET, READING, answer, options, reading


@click.command()
@click.argument("deck")
@click.option(
    "--method",
    "keys",
    multiple=True,
    metavar="METHOD",
    help="Only this one, and others named so; see `mouse list methods`.",
)
@click.option(
    "--expand", "how", metavar="EXPANSION", help="How measured shapes are expanded; see `mouse list expansions`."
)
@options(answer("mouse.comparison/1"))
@options(QUIET)
@options(READING)
def command(
    deck: str,
    keys: tuple[str, ...],
    how: str | None,
    output: str | None,
    form: str | None,
    numbers: str | None,
    quiet: bool,
    legacy: bool,
    strip_73_80: bool,
    overrides: tuple[str, ...],
) -> int:
    """Compare methods of updating on DECK.

    Predictive error of each on held-out data. Fits the modes of the test, predicts those of `hold_out`, then the changed
    structures. Judges nothing: exit 0.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._methods import checked
    from mouse_cli.cli._terminal import deliver, progress, show_diagnostics
    from mouse_cli.methods.update import compare

    how = checked(keys, how)
    problem = read_problem(deck, **reading(legacy, strip_73_80, overrides))
    if not quiet:
        show_diagnostics(problem.warnings)
    with progress() as (_, say):
        found = compare(problem, keys, how, say)
    deliver(answer_text(found, form, numbers or "modern"), output, deck)
    return 0
