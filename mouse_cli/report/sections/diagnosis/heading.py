"""What was diagnosed: program, deck, model and test."""

from collections.abc import Iterator

from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.units import system
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table
from mouse_cli.report.sections.run.held_out import told
from mouse_cli.report.theory import stated


def heading(found: Diagnosis, options: Options) -> Iterator[Block]:
    """Program and deck, then the size of both."""
    problem = found.problem
    yield deck_table(problem)
    held = f" Held out: {told(problem.hold_out)}." if problem.hold_out else ""
    yield Text(
        f"{counted(problem.test.m, 'measured mode')} at {counted(problem.test.s, 'sensor')}; a model of "
        f"{counted(problem.structure.n, 'degree', 'degrees')} of freedom with "
        f"{counted(len(problem.parameters), 'parameter')}, which were revised beside each candidate.{held}"
    )
    yield Text(_how(found))
    yield Text(stated(found))


def _how(found: Diagnosis) -> str:
    """What was considered, and in which units."""
    run, asked = found.problem.run, found.choices
    causes = (
        "one mechanism at a time"
        if asked.causes == 1
        else f"up to {asked.causes} mechanisms together, as the data need"
    )
    which = "all candidates" if asked.candidates is None else f"of all candidates only {', '.join(asked.candidates)}"
    named = system(found.problem.units)
    units = (
        f"units of the deck: {named}" if named else "the deck declares no units: numbers are in those it is written in"
    )
    return f"Considered: {which}; {causes}. Estimator: {run.estimator}, recursion: {run.recursion}; {units}."


SECTION = Section("diagnosis-heading", 20, "Deck", heading, (Diagnosis,))
