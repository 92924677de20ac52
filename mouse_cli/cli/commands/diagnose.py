"""mouse diagnose: what the model of a deck lacks."""

import os
from dataclasses import dataclass
from textwrap import fill

import click

from mouse_cli._texts import shown
from mouse_cli.cli._answers import answer_text
from mouse_cli.cli._arrangements import ARRANGEMENTS, Named, diagnosed, outcome, several, written
from mouse_cli.cli._options import QUIET, READING, answer_form, options, plotting, value_of
from mouse_cli.cli._raw_folder import RAW, refuse_idle

_WIDTH = 120  # columns of what is to be copied
_FORMS = {".json": "json", ".md": "markdown", ".html": "html"}
_CONSIDERED = (
    click.option(
        "--candidates", metavar="NAMES", help="Consider these alone, with commas between; see `mouse list candidates`."
    ),
    click.option("--without", metavar="NAMES", help="Consider all but these."),
    click.option(
        "--causes",
        type=click.IntRange(1, 4),
        default=4,
        show_default=True,
        help="Largest number of mechanisms together.",
    ),
    click.option(
        "-j",
        "--jobs",
        type=click.IntRange(1, 64),
        default=1,
        show_default=True,
        help="Processes that share the search; the answer is the same.",
    ),
)


@click.command()
@click.argument("decks", nargs=-1, required=True)
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    help="Write the model with the mechanism in it as a YAML deck; of several configurations, to a folder.",
)
@options(answer_form("mouse.diagnosis/1"))
@click.option(
    "--report",
    "reports",
    metavar="FILE",
    multiple=True,
    help="Write the answer to FILE too: .json, .md, .html (a page), else the printout.",
)
@options(plotting("Write figures: to a folder, or to one file (.pdf, .png, .svg). Needs matplotlib."))
@options(_CONSIDERED, RAW, ARRANGEMENTS, QUIET, READING)
def command(
    decks: tuple[str, ...],
    output: str | None,
    reports: tuple[str, ...],
    candidates: str | None,
    without: str | None,
    causes: int,
    jobs: int,
    held_out: tuple[str, ...],
    changed: tuple[str, ...],
    common_sd: float | None,
    **raw: object,
) -> int:
    """Identify the physics missing from the model of DECKS.

    By its test, or by raw files (--recordings FOLDER). Several DECKS: configurations of one structure, such as moved masses.

    Site, mechanism, size, validation. Exit 0: nothing is missing. 1: something is. 2: no site. 4: rejected. 5: no answer.
    """
    from mouse_cli.cli._terminal import check_figures, deliver, drawn

    arranged = several(named := Named.of(decks, held_out, changed), output)
    for deck in (*named.fitted, *held_out):
        _check_places(deck, output, value_of("plot"), *reports)
    check_figures()
    refuse_idle(decks, arranged, output, raw)
    choice = _Asked(_names(candidates, without), without is not None, causes, jobs)
    problems, found = _answer(named, arranged, common_sd, choice, output, raw)
    files = _revised(found, output, problems[0] if raw["folder"] else None)
    for path in reports:
        form = _FORMS.get(os.path.splitext(path)[1].lower())
        deliver(_text(found, form, output, files), path, decks[0])
    deliver(_text(found, value_of("form"), output, files), None, decks[0])
    drawn(found)
    return found.exit_code


@dataclass(frozen=True)
class _Asked:
    """What is to be considered: names (None: all), or all without them; most causes together; processes."""

    names: tuple[str, ...] | None
    without: bool
    causes: int
    jobs: int

    def of(self, problem):
        """The same for the data of a deck. Raises click.UsageError for names that have no meaning for them."""
        from mouse_cli.diagnosis.names import chosen
        from mouse_cli.model.diagnosis import Choices

        if self.names is None:
            return Choices(causes=self.causes, jobs=self.jobs)
        try:
            return Choices(chosen(problem, self.names, self.without), self.causes, self.jobs)
        except ValueError as reason:
            raise click.UsageError(str(reason)) from reason


def _answer(
    named: Named, arranged: bool, common_sd: float | None, choice: _Asked, output: str | None, raw: dict[str, object]
):
    """The problems of the decks fitted, and the diagnosis of one deck, or of configurations.

    Raises WrittenError, before anything is computed, where a deck in `output` could not name the recordings.
    """
    from mouse_cli.cli._decks import read_problem
    from mouse_cli.cli._terminal import progress, warn
    from mouse_cli.diagnosis.diagnose import diagnose
    from mouse_cli.diagnosis.names import NoSite
    from mouse_cli.formats import check_folder

    problems = (
        (_measured(named.fitted[0], raw),) if raw["folder"] else tuple(read_problem(deck) for deck in named.fitted)
    )
    unseen = tuple(read_problem(deck) for deck in named.unseen)
    if output is not None:
        for problem in problems:
            check_folder(problem, output if arranged else os.path.dirname(output))
    warn(each for problem in (*problems, *unseen) for each in problem.warnings)
    choices = choice.of(problems[0])
    with progress() as (_, say):
        if arranged:
            return problems, diagnosed(named, problems, unseen, common_sd, say, choices)
        try:
            return problems, diagnose(problems[0], say, choices)
        except NoSite as reason:
            raise click.UsageError(str(reason)) from reason


def _measured(deck: str, raw: dict[str, object]):
    """The problem of the deck with the recordings of a folder; says on standard error what was read."""
    from mouse_cli.cli._raw_folder import read_raw
    from mouse_cli.cli._terminal import progress, show_diagnostics

    said = []
    with progress() as (_, notice):
        problem = read_raw(deck, raw, notice, lambda *message: said.append(message))
    for lines, passed in said if not value_of("quiet") else ():
        click.echo(shown("\n".join(lines)), err=True)
        show_diagnostics(passed)
    return problem


def _names(candidates: str | None, without: str | None) -> tuple[str, ...] | None:
    """The names that were given, before any deck is read. Raises click.UsageError for those that do not exist."""
    if candidates is None and without is None:
        return None
    if candidates is not None and without is not None:
        raise click.UsageError("--candidates and --without exclude each other")
    from mouse_cli.diagnosis.names import known

    given = tuple(name.strip() for name in (candidates or without or "").split(","))
    for name in given:
        if name not in known():
            raise click.UsageError(f"there is no candidate '{name}'; there are {', '.join(known())}")
    return given


def _check_places(deck: str, *paths: str | None) -> None:
    """Refuse, before anything is computed, to write over the deck."""
    for path in paths:
        if path and os.path.exists(path) and os.path.exists(deck) and os.path.samefile(path, deck):
            raise click.UsageError(f"{path} is the deck itself")


def _revised(found, output: str | None, measured=None) -> list[str]:
    """Names of the files of the extended decks; none where there is none, but for the deck `measured` by a folder."""
    from mouse_cli.formats import write_deck

    if output is None or not (found.extended or measured):
        return []
    if not found.extended:
        return write_deck(measured, output)
    return written(found, output) if _arranged(found) else write_deck(found.extended, output)


def _arranged(found) -> bool:
    from mouse_cli.model.arrangements import ArrangementsDiagnosis

    return isinstance(found, ArrangementsDiagnosis)


def _text(found, form: str | None, output: str | None, files: list[str]) -> str:
    """The answer in the form asked for, and what became of `-o`."""
    from mouse_cli.cli._terminal import json_text
    from mouse_cli.report import document

    if form == "json":
        decks = {"revised_decks": files} if _arranged(found) else {"revised_deck": files[-1] if files else None}
        return json_text(document(found) | decks)
    if form == "html":
        from mouse_cli.page import page, read

        return page(read(json_text(document(found)).encode(), "the answer"))
    text = answer_text(found, "modern", form=form)
    if output is None:
        return text
    sentence = outcome(files, output) if _arranged(found) else _written(found, output, files)
    return f"{text}\n{fill(sentence, _WIDTH, break_long_words=False)}\n"


def _written(found, output: str, files: list[str]) -> str:
    from mouse_cli.model.diagnosis import NAMED, ONE_OF

    if files and not found.extended:
        return f"No mechanism is named. The deck with what was measured is in {files[-1]}; `mouse diagnose` accepts it."
    if files and found.kind == ONE_OF:
        lead = f"The model with {found.best.title}, the most probable one, not proved,"
        return f"{lead} is in {files[-1]}; `mouse run` accepts it."
    if files:
        return f"The extended model is in {files[-1]}; `mouse run` accepts it."
    why = "its mechanism cannot be put into a deck" if found.kind in (NAMED, ONE_OF) else "no mechanism is named"
    return f"Nothing was written to {output}: {why}."
