"""mouse modify: masses, springs, dashpots and absorbers added to a model, and which of them move a mode where it should be."""

from dataclasses import replace

import click

from mouse_cli.cli._answers import deliver_answer
from mouse_cli.cli._changes import CHANGES, changes_text
from mouse_cli.cli._options import PRIOR, QUIET, READING, answer, earlier, options, outside, plotting


@click.command()
@click.argument("deck")
@options(CHANGES)
@click.option("-n", "--count", type=click.IntRange(min=1), help="How many modes, from the lowest.")
@options(plotting(), answer("mouse.modification/1"), PRIOR, QUIET, READING)
def command(deck: str, count: int | None, **given: object) -> int:
    """Predict the effect of structural modifications of DECK.

    With the uncertainty of its properties. DECK is a model with changes as options, or a YAML deck that holds `modify:`.

    Exit 1: a target cannot be met.
    """
    from mouse_cli.cli._decks import without_laws
    from mouse_cli.cli._terminal import check_figures, progress, warn
    from mouse_cli.coupling import modify

    check_figures()
    modification = _read(deck, given, count)
    with progress() as (_, say):
        found = modify(modification, say)
    warn((*found.warnings, *without_laws(modification.problem, modes=True)))
    deliver_answer(found, deck)
    return int(_missed(found))


def _read(deck: str, given: dict[str, object], count: int | None):
    """The changes of a deck that holds `modify:`, or those of the options."""
    from mouse_cli.cli._decks import after_result, deck_bytes, read_problem, shown
    from mouse_cli.formats import holds
    from mouse_cli.formats.yaml_deck import modified

    begun, data = earlier(), b"" if deck == "-" else deck_bytes(deck)
    if holds(data, deck) == "model":
        problem = after_result(read_problem(deck), **begun)
        return replace(modified.read(changes_text(given, count), "<options>", problem), path=shown(deck))
    if any(value for value in given.values()):
        raise click.UsageError(
            "changes as options are for a deck with a model; this one holds modify: write them there"
        )
    found = modified.read(data, shown(deck), outside=outside())
    problem = after_result(found.problem, **begun)
    warnings = tuple(dict.fromkeys((*found.warnings, *problem.warnings)))
    return replace(found, part=replace(found.part, problem=problem), warnings=warnings, count=count or found.count)


def _missed(found) -> bool:
    """Whether no place meets some target."""
    met: dict = {}
    for need in found.needs:
        met[need.target] = met.get(need.target, False) or need.value == need.value
    return not all(met.values())
