"""mouse run: revise the model of a deck by its test."""

import click

from mouse_cli.cli._options import QUIET, READING, RUN, answer, options, reading, run_changes


@click.command()
@click.argument("deck")
@options(answer("mouse.result/1"))
@click.option("--stacked", is_flag=True, help="The file holds several card decks, one after another.")
@click.option(
    "--plot", metavar="PATH", help="Write figures of fitted FRFs: to a folder, or to one file (.pdf, .png, .svg)."
)
@options(QUIET)
@options(RUN, READING)
def command(
    deck: str,
    output: str | None,
    form: str | None,
    numbers: str | None,
    stacked: bool,
    plot: str | None,
    quiet: bool,
    legacy: bool,
    strip_73_80: bool,
    overrides: tuple[str, ...],
    **given: object,
) -> int:
    """Revise the model of DECK (cards or YAML, '-': standard input) by its test.

    Exit 0: converged, and the model explains the data. 1: do not trust the answer. 4: deck rejected. 5: no answer.
    """
    from mouse_cli.cli._decks import read_cases, read_problem
    from mouse_cli.cli._terminal import deliver, progress, show_diagnostics
    from mouse_cli.updating import run

    if plot:
        from mouse_cli.plots import require

        require()
    changes, how = run_changes(given), reading(legacy, strip_73_80, overrides)
    problems = read_cases(deck, changes, **how) if stacked else [read_problem(deck, changes, **how)]
    results = []
    for problem in problems:
        if not quiet:
            show_diagnostics(problem.warnings)
        with progress() as (show, say):
            results.append(run(problem, show, say))
    if plot:
        from mouse_cli.plots import draw

        draw(results[-1], plot)
    deliver(_text(results, form, numbers, stacked), output, deck)
    return max((result.exit_code for result in results), default=0)


def _text(results: list, form: str | None, numbers: str | None, stacked: bool) -> str:
    """The answer in the form asked for."""
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document, written

    if form == "json":
        documents = [document(result) for result in results]
        return json_text({"schema": "mouse.results/1", "cases": documents} if stacked else documents[0])
    return "\n".join(written(result, form or "printout", numbers) for result in results)
