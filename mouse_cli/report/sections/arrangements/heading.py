"""What was diagnosed: the decks of all arrangements, and how well theory is held to know them."""

from collections.abc import Iterator

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.report.blocks import Block, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import counted, deck_table
from mouse_cli.report.theory import stated


def heading(found: ArrangementsDiagnosis, options: Options) -> Iterator[Block]:
    """Decks, data, what they share."""
    first = found.problem
    yield deck_table(first)
    data = sum(each.test.m for each in found.problems)
    unseen = 0 if found.held_out is None else len(found.held_out.labels)
    yield Text(
        f"{counted(len(found.problems), 'configuration')} of one structure, {counted(data, 'measured mode')} in all, fitted "
        f"together; {counted(unseen, 'frequency', 'frequencies')} of other configurations held out. They share "
        f"{counted(len(first.parameters), 'parameter')} and every mechanism."
    )
    yield Text(f"{stated(found)} What the decks state of their tests comes in addition, independent in each.")
    yield Text(f"Fitted: {', '.join(each.source.path for each in found.problems)}.")
    if found.changed is not None:
        own = [each.source.path for each, has in zip(found.problems, found.changed, strict=True) if has]
        yield Text(f"Mechanisms are sought in the changed configurations only: {', '.join(own)}.")


SECTION = Section("arrangements-heading", 20, "Decks", heading, (ArrangementsDiagnosis,))
