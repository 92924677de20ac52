"""What sweeps and bootstraps ask of the command line: the deck, options of its runs, where the table goes."""

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._options import run_changes

TABLE = (click.option("--csv", "csv_file", metavar="FILE", help="Write a long table, one line a run and quantity."),)


def deck_of(deck: str, given: dict[str, object], recordings: bool = False) -> tuple:
    """The problem of the deck, and the options of all jobs on it. recordings: they are a test too.

    Raises DeckError, click.UsageError.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import warn
    from mouse_cli.updating import refusals

    if deck == "-":
        raise click.UsageError("the deck must be a file: processes read it again")
    base = {name: value for name, value in run_changes(given).items() if value is not None}
    problem = read_problem(deck, dict(base))
    if not recordings if problem.by_recordings else problem.test is None and not problem.frf:
        raise refusals.no_test(problem)
    warn(problem.warnings)
    return problem, base


def deliver_campaign(found: object, csv_file: str | None) -> None:
    """Print the report or the document of a campaign, and write its table."""
    from mouse_cli.campaigns import tables
    from mouse_cli.cli._terminal import deliver

    if csv_file:
        deliver(tables.text(found), csv_file, "")
    deliver(answer_text(found), None, "")
