"""mouse batch: many decks at once, resumed where it was broken off."""

import click

from mouse_cli.cli._engine import CLUSTER, JOBS, done, folder
from mouse_cli.cli._options import OUTSIDE, QUIET, RUN, options, outside, run_changes, value_of

_REPORTS = (
    click.option("--csv", "csv_file", metavar="FILE", help="Write the table for spreadsheets."),
    click.option("--junit", "junit_file", metavar="FILE", help="Write JUnit XML for CI servers."),
    click.option(
        "--markdown", "markdown_file", metavar="FILE", help="Write the table in Markdown, for merge requests."
    ),
    click.option(
        "--html", "html_file", metavar="FILE", help="Write the table as a page with filters, and a page of each answer."
    ),
    click.option("--github", is_flag=True, help="Print annotations that GitHub shows beside the lines."),
)


@click.command()
@click.argument("decks", nargs=-1, required=True)
@options(folder("mouse-results"), JOBS)
@click.option(
    "--command", "asked", type=click.Choice(("run", "check", "diagnose")), default="run", show_default=True,
    help="Command for decks that no manifest names.",
)  # fmt: skip
@options(CLUSTER, _REPORTS, OUTSIDE, QUIET, RUN)
def command(
    decks: tuple[str, ...],
    output: str,
    jobs: int | None,
    scheduler: str | None,
    cluster: int | None,
    limit_s: float | None,
    asked: str,
    csv_file: str | None,
    junit_file: str | None,
    markdown_file: str | None,
    html_file: str | None,
    github: bool,
    **given: object,
) -> int:
    """Run, check or diagnose many DECKS.

    DECKS are files, folders, patterns and manifests. Existing answers of decks and files that have not changed are kept:
    the same command resumes a batch.

    Exit 3: a job missed what its manifest expects. Else the highest of the jobs' own: 5, 4, 1, 0.
    """
    from mouse_cli.batch.markdown import markdown_text
    from mouse_cli.batch.outcome import exit_code
    from mouse_cli.batch.summary import annotations, csv_text, junit_text, table
    from mouse_cli.cli._terminal import deliver, say

    changes = {name: value for name, value in run_changes(given).items() if value is not None}
    found = done(_listed(decks, asked, changes), output, jobs, scheduler, cluster, limit_s)
    for text, file in ((csv_text, csv_file), (junit_text, junit_file), (markdown_text, markdown_file)):
        if file:
            deliver(text(found), file, "")
    if html_file:
        _pages(found, html_file)
    if github:
        say(annotations(found), end="", commands=True)
    say(table(found, bool(value_of("quiet"))), end="")
    return exit_code(found)


def _pages(found: list, file: str) -> None:
    """A page of each answer, beside it, then the index of them in `file`. Raises WrittenError."""
    import os

    from mouse_cli.cli._decks import deck_bytes, shown
    from mouse_cli.cli._terminal import deliver
    from mouse_cli.page import DOCUMENTS, page, read
    from mouse_cli.page.index import index

    pages = {}
    for each in found:
        if each.answered:
            pages[each.result] = f"{os.path.splitext(each.result)[0]}.html"
            deliver(page(read(deck_bytes(each.result), shown(each.result), DOCUMENTS)), pages[each.result], "")
    deliver(index(found, pages, os.path.dirname(os.path.abspath(file))), file, "")


def _of_manifest(path: str) -> list:
    """Its jobs; what reads YAML is loaded for them alone."""
    from mouse_cli.batch import manifest

    return manifest.read(path, outside())


def _listed(decks: tuple[str, ...], asked: str, changes: dict) -> list:
    """The jobs of names and manifests, each once. Raises DeckError for all that is wrong with them."""
    from dataclasses import replace

    from mouse_cli._errors import ERROR, DeckError, Diagnostic, MouseError
    from mouse_cli.batch.decks import found, is_manifest
    from mouse_cli.batch.job import Job, once

    jobs, wrong = [], []
    for name in decks:
        some = found(name, outside())
        if not some:
            wrong.append(Diagnostic("MD900", ERROR, f"'{name}' stands for no deck", help="check the name"))
        for path in some:
            if not is_manifest(path):
                jobs.append(Job(path, asked, changes, outside=outside()))
                continue
            try:
                jobs += [replace(job, options=job.options | changes) for job in _of_manifest(path)]
            except MouseError as error:
                wrong += error.diagnostics
    if wrong:
        raise DeckError(wrong)
    return once(jobs)
