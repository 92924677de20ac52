"""mouse compare: methods of updating side by side, as in lecture 21-1."""

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._options import QUIET, READING, answer, options


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
@options(answer("mouse.comparison/1"), QUIET, READING)
def command(deck: str, keys: tuple[str, ...], how: str | None) -> int:
    """Compare methods of updating on DECK.

    Predictive error of each on held-out data. Fits the modes of the test, predicts those of `hold_out`, then the changed
    structures. Judges nothing: exit 0.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._methods import checked
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.methods.update import compare

    how = checked(keys, how)
    problem = read_problem(deck)
    warn(problem.warnings)
    with progress() as (_, say):
        found = compare(problem, keys, how, say)
    deliver_answer(found, deck)
    return 0
