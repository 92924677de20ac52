"""What was diagnosed by recordings: deck, model, records and the accuracy that was taken for them."""

from collections.abc import Iterator

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.report.blocks import Block, Column, Table, Text
from mouse_cli.report.section import Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table
from mouse_cli.report.theory import stated


def heading(found: RecordDiagnosis | RecordUpdate, options: Options) -> Iterator[Block]:
    """Deck, size, and one line an output."""
    problem = found.problem
    excited = f"force at {', '.join(found.inputs)}" if found.inputs else "free decays"
    beside = " beside each law" if isinstance(found, RecordDiagnosis) else ""
    yield deck_table(problem)
    yield Text(
        f"{counted(len(found.fitted), 'recording')} fitted ({', '.join(found.fitted)}), "
        f"{counted(len(found.scores), 'record')} held out; "
        f"{excited}; a model of {counted(problem.structure.n, 'degree', 'degrees')} of freedom with "
        f"{counted(len(problem.parameters), 'parameter')}, which were revised{beside}."
    )
    columns = (Column("output", align=LEFT), Column("unit", align=LEFT), Column("sd taken"))
    yield Table(columns, tuple(zip(found.channels, found.units, (f"{sd:.3g}" for sd in found.sd), strict=True)))
    yield Text(
        "The sd is the floor of the spectrum of the output, and at least 1 % of its rms: no transducer is better."
    )
    yield Text(stated(found))


SECTION = Section("record-heading", 20, "Deck", heading, (RecordDiagnosis, RecordUpdate))
