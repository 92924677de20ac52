"""mouse modes: natural frequencies and mode shapes with the uncertainty that the prior gives them."""

import click

from mouse_cli.cli._options import READING, options, reading


@click.command()
@click.argument("deck")
@click.option("-n", "--count", type=click.IntRange(min=1), help="How many modes, from the lowest.")
@click.option("-o", "--output", metavar="FILE", help="Write the answer to FILE instead of standard output.")
@click.option("--json", "form", flag_value="json", help="One JSON document (mouse.modes/1) in place of the printout.")
@click.option("--markdown", "form", flag_value="markdown", help="Markdown in place of the printout.")
@click.option("--numbers", type=click.Choice(["legacy", "modern"]), help="1.28872+04 as in 1972, or 12887.2.")
@click.option("-q", "--quiet", is_flag=True, help="No warnings on standard error.")
@options(READING)
def command(
    deck: str,
    count: int | None,
    output: str | None,
    form: str | None,
    numbers: str | None,
    quiet: bool,
    legacy: bool,
    strip_73_80: bool,
    overrides: tuple[str, ...],
) -> int:
    """Frequencies and shapes of DECK before any test, and their uncertainty.

    The standard deviations follow from those of the properties.
    """
    import json

    from mouse_cli import report
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import deliver, show_diagnostics
    from mouse_cli.updating import forecast

    problem = read_problem(deck, **reading(legacy, strip_73_80, overrides))
    if not quiet:
        show_diagnostics(problem.warnings)
    answer = forecast(problem, count)
    if form == "json":
        text = json.dumps(report.document(answer), indent=1, allow_nan=False)
    elif form == "markdown":
        text = report.markdown(answer, numbers or "modern")
    else:
        text = report.printout(answer, numbers or "legacy")
    deliver(text, output)
    return 0
