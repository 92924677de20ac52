"""mouse report: an answer in JSON as a page to look at."""

import click


@click.command()
@click.argument("result")
@click.option("--markdown", is_flag=True, help="In short, in GitHub's Markdown: for a merge request.")
@click.option("-o", "--output", metavar="FILE", help="Write the page to FILE instead of standard output.")
def command(result: str, markdown: bool, output: str | None) -> int:
    """Make an HTML page of RESULT.

    RESULT is the JSON of `run`, `diagnose`, `compare`, `correlate`, `identify`, `modes`, `spectra`, `couple`, `modify`, `sweep`,
    `bootstrap`, `sample`, or a job of `batch`. One file that needs no network: verdict, mode shapes drawn on the structure,
    frequencies, parameters, FRFs, mechanisms, sites, convergence. Exit 0 whatever the verdict is.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import deliver
    from mouse_cli.page import DOCUMENTS, page, read, summary

    document = read(deck_bytes(result), shown(result), DOCUMENTS)
    deliver(summary(document) if markdown else page(document), output, result)
    return 0
