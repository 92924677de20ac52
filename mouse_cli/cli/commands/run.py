"""mouse run: revise the model of a deck by its test."""

from collections.abc import Callable, Iterable

import click

from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._methods import METHOD, by_method, chosen
from mouse_cli.cli._options import PRIOR, QUIET, READING, RUN, answer, earlier, options, plotting, run_changes, value_of


@click.command()
@click.argument("deck")
@options(answer("mouse.result/1"))
@click.option("--stacked", is_flag=True, help="The file holds several card decks, one after another.")
@options(plotting("Write figures of fitted FRFs or recordings: to a folder, or to one file (.pdf, .png, .svg)."))
@options(METHOD, PRIOR, QUIET)
@options(RUN, READING)
def command(deck: str, stacked: bool, **given: object) -> int:
    """Update the model of DECK by its test.

    DECK is cards or YAML; '-': standard input.

    Exit 0: converged, and the model explains the data. 1: do not trust the answer. 4: deck rejected. 5: no answer.
    """
    from mouse_cli.cli._terminal import check_figures, deliver, drawn

    check_figures()
    method, expansion = chosen(given.pop("method"), given.pop("expand"))
    problems = _problems(deck, stacked, run_changes(given))
    results = by_method(problems, method, expansion) if method else _run(problems)
    if results:
        drawn(results[-1])
    deliver(_text(results, stacked), value_of("output"), deck)
    return max((result.exit_code for result in results), default=0)


def _run(problems: Iterable) -> list:
    """The results of the loop, or for decks of recordings of their update."""
    from mouse_cli.cli._decks import without_laws
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.updating import run

    results = []
    for problem in problems:
        warn((*problem.warnings, *without_laws(problem)))
        with progress() as (show, say):
            results.append(_by_recordings(problem, say) if problem.by_recordings else run(problem, show, say))
    return results


def _by_recordings(problem, say: Callable[[str], None]):
    """The update by recordings, loaded where a deck has some: a small card deck must not wait for it."""
    from mouse_cli.updating.recordings.update import update_records

    return update_records(problem, say)


def _problems(deck: str, stacked: bool, changes: dict) -> Iterable:
    """The problem of the deck, or of all that are stacked in its file."""
    from mouse_cli.cli._decks import read_cases, read_problem

    begun = earlier()
    if not stacked:
        return [read_problem(deck, changes, **begun)]
    if begun["prior"]:
        raise click.UsageError("--prior is for one deck, --stacked for several")
    return read_cases(deck, changes)


def _text(results: list, stacked: bool) -> str:
    """The answer in the form asked for."""
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document

    if value_of("form") == "json":
        documents = [document(result) for result in results]
        return json_text({"schema": "mouse.results/1", "cases": documents} if stacked else documents[0])
    return "\n".join(answer_text(result, None, _of_1972(result.problem)) for result in results)


def _of_1972(problem) -> bool:
    """Whether the printout is to be that of 1972: of its cards, and within its limits."""
    return problem.source.format == "cards" or problem.run.legacy
