"""mouse report: an answer in JSON as a page to look at."""

import click


@click.command()
@click.argument("result")
@click.option("-o", "--output", metavar="FILE", help="Write the page to FILE instead of standard output.")
def command(result: str, output: str | None) -> int:
    """Make an HTML page of RESULT, which `mouse run --json` or `mouse diagnose --json` wrote.

    One file that needs no network: verdict, frequencies, parameters, shapes, causes, places, convergence. Exit 0 whatever the
    verdict is.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import deliver
    from mouse_cli.page import page, read

    deliver(page(read(deck_bytes(result), shown(result))), output, result)
    return 0
