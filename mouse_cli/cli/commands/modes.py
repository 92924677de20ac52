"""mouse modes: natural frequencies and mode shapes with the uncertainty that the prior gives them."""

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._options import PRIOR, QUIET, READING, answer, earlier, options


@click.command()
@click.argument("deck")
@click.option("-n", "--count", type=click.IntRange(min=1), help="How many modes, from the lowest.")
@options(answer("mouse.modes/1"), PRIOR, QUIET, READING)
def command(deck: str, count: int | None) -> int:
    """Predict natural frequencies and mode shapes of DECK.

    Before any test, with their uncertainty. The standard deviations are propagated from those of the properties.
    """
    from mouse_cli.cli._decks import read_problem, without_laws
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.updating import forecast

    problem = read_problem(deck, **earlier())
    warn((*problem.warnings, *without_laws(problem, modes=True)))
    with progress() as (_, say):
        found = forecast(problem, count, say)
    deliver_answer(found, deck, None, problem.source.format == "cards")
    return 0
