"""mouse correlate: the test of a deck beside its model."""

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._options import QUIET, READING, answer, options


@click.command()
@click.argument("deck")
@click.option("--expand", "method", metavar="METHOD", help="Expand the measured shapes; see `mouse list expansions`.")
@click.option("--exact", is_flag=True, help="Keep measured components as they are where METHOD would smooth them.")
@options(answer("mouse.correlation/1"), QUIET, READING)
def command(deck: str, method: str | None, exact: bool) -> int:
    """Test-analysis correlation of DECK before any update.

    Mode pairs, MAC, COMAC, orthogonality, sensors that look faulty, modes without partner. Judges nothing: exit 0.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.updating.correlate import correlate

    _check_method(method, exact)
    problem = read_problem(deck)
    with progress() as (_, say):
        found = correlate(problem, method, exact, say)
    warn((*problem.warnings, *found.warnings))
    deliver_answer(found, deck)
    return 0


def _check_method(method: str | None, exact: bool) -> None:
    """Refuse an expansion that there is not, and `--exact` where it cannot act."""
    from mouse_cli.dynamics.expansion import expansion

    if method is None:
        if exact:
            raise click.UsageError("--exact belongs to --expand")
        return
    try:
        smooths = expansion(method).smooths
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--expand") from None
    if exact and smooths == "always":
        raise click.UsageError(f"{method} always smooths: it gives combinations of model modes")
