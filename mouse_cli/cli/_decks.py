"""From a name on the command line to problems: files, standard input, options that replace what the deck says."""

import os
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.cli._options import outside, reading
from mouse_cli.formats import bounded, file_bytes, holds, is_yaml, read_draft
from mouse_cli.formats.assemble import assemble
from mouse_cli.formats.draft import Draft
from mouse_cli.model.problem import Problem, RunOptions

if TYPE_CHECKING:  # a deck of a model does not load what couples models
    from mouse_cli.model.coupling import Coupling, Modification

_OF_MODES = {"pairing", "scale"}  # options that concern measured modes


def deck_bytes(path: str) -> bytes:
    """Content of the file `path`, or of standard input for '-'. Raises DeckError."""
    return bounded(sys.stdin.buffer, shown(path)) if path == "-" else file_bytes(path)


def shown(path: str) -> str:
    """The name under which a deck appears in messages."""
    return "<stdin>" if path == "-" else path


def read_problem(
    path: str,
    changes: dict[str, object] | None = None,
    prior: str | None = None,
    loosened: dict[str, float] | None = None,
) -> Problem:
    """The problem of one deck; `changes` are options of the command line that replace those of the deck.

    prior: file with the result of an earlier run, which replaces its prior; loosened: sd by which properties may have changed.
    """
    data, how = deck_bytes(path), reading()
    if is_yaml(data, path) and (how["overrides"] or how["strip_73_80"]):
        raise click.UsageError("--set and --strip-73-80 are for card decks; a YAML deck has keys and options for that")
    draft = read_draft(data, shown(path), outside=outside(), **how)
    problem = assemble(changed(draft, changes or {}))
    if changes is not None:
        problem = replace(problem, warnings=problem.warnings + _idle_options(problem, changes))
    if prior is None:
        return problem
    from mouse_cli.updating.earlier import after

    return after(problem, prior, loosened or {})


def _idle_options(problem: Problem, changes: dict[str, object]) -> tuple[Diagnostic, ...]:
    """The warning (MD643) that options of the command line, or of the deck's `run:`, do nothing for its test."""
    usual = vars(RunOptions())
    given = {name for name, value in vars(problem.run).items() if value != usual[name]} - {"legacy", "total_mass_dofs"}
    given |= {name for name, value in changes.items() if value is not None}
    if not problem.by_recordings:
        given &= _OF_MODES if problem.test is None and problem.frf else set()
    if not given:
        return ()
    what = "recordings alone" if problem.by_recordings else "FRFs alone"
    message = f"{', '.join(sorted(given))}: without meaning for a run on {what}"
    return (
        Diagnostic("MD643", WARNING, message, problem.place("run"), help="leave it out; see `mouse explain MD643`"),
    )


def without_laws(problem: Problem, modes: bool = False) -> tuple[Diagnostic, ...]:
    """The warning (MD642) that local laws of a deck are left out: of `modes`, and of what is revised by more than recordings."""
    linear = modes or problem.test is not None or problem.frf
    if not problem.laws or not linear:
        return ()
    laws = ", ".join(dict.fromkeys(one.law for one in problem.laws))
    message = f"the laws of the deck ({laws}) are not in its matrices: the modes are those of the structure without them"
    help = "see `mouse explain MD642`; recordings alone are simulated with the laws"
    return (Diagnostic("MD642", WARNING, message, problem.place("laws"), help=help),)


def read_cases(path: str, changes: dict[str, object]) -> Iterator[Problem]:
    """The problems of a file of stacked card decks, one after another."""
    for draft in read_drafts(path, stacked=True):
        yield assemble(changed(draft, changes))


def read_other(path: str) -> "Coupling | Modification | None":
    """What a file holds that is no model with its test: coupled structures, or changes; None for all others. Raises DeckError."""
    data = b"" if path == "-" else file_bytes(path)
    found = holds(data, path)
    if found == "model":
        return None
    from mouse_cli.formats.yaml_deck import coupled, modified

    return {"couple": coupled, "modify": modified}[found].read(data, path, outside=outside())


def after_result(problem: Problem, prior: str | None, loosened: dict[str, float]) -> Problem:
    """With the posterior of an earlier result as its prior; of the same test too, where nothing is fitted to that again."""
    if prior is None:
        return problem
    from mouse_cli.updating.earlier import after

    return replace(after(replace(problem, test=None), prior, loosened), test=problem.test)


def read_drafts(path: str, stacked: bool) -> Iterator[Draft]:
    """The deck of a file, or all of them where card decks are stacked."""
    data = deck_bytes(path)
    if not stacked or is_yaml(data, path):
        yield read_draft(data, shown(path), outside=outside(), **reading())
        return
    from mouse_cli.formats import cards

    yield from cards.read_all(data, shown(path), stacked=True, **reading())


def changed(draft: Draft, changes: dict[str, object]) -> Draft:
    """`draft` with run options, and the scale of its test, replaced by those that were given."""
    given = {name: value for name, value in changes.items() if value is not None}
    scale = given.pop("scale", None)
    if scale and draft.test:
        draft = replace(draft, test=replace(draft.test, scale=scale))
    return draft.with_run(**given)


def expanded(paths: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Files as named; for a folder every deck in it, sorted, and that folder."""
    for path in paths:
        if os.path.isdir(path):
            for folder, _, names in sorted(os.walk(path)):
                found = (n for n in sorted(names) if n.endswith((".dat", ".yaml", ".yml")))
                yield from ((os.path.join(folder, n), path) for n in found)
        else:
            yield path, ""
