"""mouse plot: figures of an answer in JSON."""

import click


@click.command()
@click.argument("result")
@click.option(
    "-o", "--output", metavar="PATH", required=True, help="A folder, or one file (.pdf, .png, .svg) for all figures."
)
@click.option("--figure", "figures", metavar="NAME", multiple=True, help="Draw this figure; may be repeated.")
def command(result: str, output: str, figures: tuple[str, ...]) -> int:
    """Draw figures of RESULT.

    RESULT is what `mouse run --json` or `mouse diagnose --json` wrote. Frequencies, parameters, MAC, mechanisms, sites,
    mode shapes, convergence: those for which RESULT has values. A single figure by --figure. Exit 0 whatever the verdict
    is.
    """
    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import drawn
    from mouse_cli.plots import figures_of, require
    from mouse_cli.report.reading import Part, read

    known = figures_of(Part)
    for name in figures:
        if name not in known:
            raise click.BadParameter(f"'{name}' is none of {', '.join(known)}", param_hint="'--figure'")
    require(output)
    drawn(read(deck_bytes(result), shown(result)), output, figures)
    return 0
