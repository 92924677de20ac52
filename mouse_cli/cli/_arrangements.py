"""Several decks as arrangements of one structure: what the command line may ask of them, and where their decks are written."""

import os
from collections.abc import Callable
from dataclasses import dataclass

import click

from mouse_cli.cli._options import value_of
from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import Choices
from mouse_cli.model.problem import Problem

ARRANGEMENTS = (
    click.option(
        "--held-out",
        metavar="DECK",
        multiple=True,
        help="Of several configurations: one that is held out of every fit, for validation. Repeatable.",
    ),
    click.option(
        "--changed",
        metavar="DECK",
        multiple=True,
        help="Of several configurations: one that was measured after a change. The change is sought in these only; the "
        "others give the reference state. Repeatable; one that is held out too is named by both.",
    ),
    click.option(
        "--common-sd",
        metavar="PERCENT",
        type=click.FloatRange(0, 50, min_open=True),
        help="Of several configurations: sd of the model error of each frequency, common to all of them. "
        "[default: theory.configurations of the decks, 1 where they give none]",
    ),
)


@dataclass(frozen=True)
class Named:
    """Names of decks: those fitted, those held out, and which of either were measured after something changed."""

    fitted: tuple[str, ...]
    unseen: tuple[str, ...]
    changed: tuple[str, ...]

    @classmethod
    def of(cls, decks: tuple[str, ...], held_out: tuple[str, ...], changed: tuple[str, ...]) -> "Named":
        """From the command line, where a deck that changed may be among DECKS too."""
        apart = {os.path.realpath(deck) for deck in (*decks, *held_out)}
        return cls((*decks, *(deck for deck in changed if os.path.realpath(deck) not in apart)), held_out, changed)

    def having(self, decks: tuple[str, ...]) -> tuple[bool, ...]:
        """Which of `decks` have the causes that are sought: those that changed, or all."""
        changed = {os.path.realpath(deck) for deck in self.changed}
        return tuple(not changed or os.path.realpath(deck) in changed for deck in decks)


def several(named: Named, output: str | None) -> bool:
    """Whether decks are arrangements. Raises click.UsageError for what has no meaning, or where names would collide."""
    decks = named.fitted
    seen: set[str] = set()
    for deck in (*decks, *named.unseen):
        if (place := os.path.realpath(deck)) in seen:
            raise click.UsageError(f"{deck} is given twice: a configuration counts once, to be fitted or held out")
        seen.add(place)
    if len(decks) == 1 and not named.unseen and not named.changed:
        return False
    if not any(named.having(decks)):
        raise click.UsageError("every deck of --changed is held out: leave some to the fit")
    if value_of("plot"):
        raise click.UsageError("--plot draws one deck, not several configurations")
    names = [os.path.basename(deck) for deck in decks]
    if output and len(set(names)) < len(names):
        raise click.UsageError("decks of one name in different folders cannot be written to one folder")
    if output and os.path.exists(output) and not os.path.isdir(output):
        raise click.UsageError(f"{output} is a file; the decks of several configurations are written to a folder")
    return True


def diagnosed(
    named: Named,
    problems: tuple[Problem, ...],
    unseen: tuple[Problem, ...],
    common_sd: float | None,
    say: Callable[[str], None],
    choices: Choices,
) -> ArrangementsDiagnosis:
    """What arrangements lack; common_sd in per cent, None: as the decks state it."""
    from mouse_cli.diagnosis.likelihoods.configurations.changes import diagnose_changes
    from mouse_cli.diagnosis.likelihoods.configurations.diagnose import Decks

    shared = problems[0].theory.configurations if common_sd is None else common_sd / 100
    fitted = Decks(problems, named.having(named.fitted), shared)
    held = Decks(unseen, named.having(named.unseen), shared)
    return diagnose_changes(fitted, held, say, choices)


def written(found: ArrangementsDiagnosis, folder: str) -> list[str]:
    """Names of the extended decks, one for each arrangement, in `folder`; none where nothing is missing."""
    from mouse_cli.formats import write_deck

    files: list[str] = []
    decks = found.extended or (found.problems if found.begun else ())
    if decks:
        os.makedirs(folder, exist_ok=True)
    having = found.changed or (True,) * len(found.problems)
    for given, deck, has in zip(found.problems, decks, having, strict=False):
        if not has and not found.begun:
            continue  # its parameters of the cause would be bound to nothing
        deck = deck if has else given
        name = os.path.splitext(os.path.basename(given.source.path))[0] + ".yaml"
        files.append(write_deck(deck, os.path.join(folder, name))[-1])
    return files


def outcome(files: list[str], folder: str) -> str:
    """What became of `-o`."""
    if not files:
        return f"Nothing was written to {folder}: nothing is missing, or nothing could be named."
    return f"The configurations with every named mechanism are in {folder}, {len(files)} decks."
