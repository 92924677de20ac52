"""mouse modes: natural frequencies and mode shapes with the uncertainty that the prior gives them."""

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._options import PRIOR, QUIET, READING, answer, earlier, options, reading


@click.command()
@click.argument("deck")
@click.option("-n", "--count", type=click.IntRange(min=1), help="How many modes, from the lowest.")
@options(answer("mouse.modes/1"))
@options(PRIOR, QUIET)
@options(READING)
def command(
    deck: str,
    count: int | None,
    output: str | None,
    form: str | None,
    numbers: str | None,
    prior: str | None,
    loosen: tuple[str, ...],
    quiet: bool,
    legacy: bool,
    strip_73_80: bool,
    overrides: tuple[str, ...],
) -> int:
    """Predict natural frequencies and mode shapes of DECK.

    Before any test, with their uncertainty. The standard deviations are propagated from those of the properties.
    """
    from mouse_cli.cli._decks import read_problem, without_laws
    from mouse_cli.cli._terminal import deliver, progress, show_diagnostics
    from mouse_cli.updating import forecast

    problem = read_problem(deck, **earlier(prior, loosen), **reading(legacy, strip_73_80, overrides))
    if not quiet:
        show_diagnostics((*problem.warnings, *without_laws(problem, modes=True)))
    with progress() as (_, say):
        found = forecast(problem, count, say)
    deliver(answer_text(found, form, numbers, problem.source.format == "cards"), output, deck)
    return 0
