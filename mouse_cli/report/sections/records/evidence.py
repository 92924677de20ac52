"""The evidence of a diagnosis by recordings: every law that was followed to its optimum."""

from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.report.section import RESULT, Section
from mouse_cli.report.sections.diagnosis.evidence import evidence

SECTION = Section("record-evidence", 40, "Evidence", evidence, (RecordDiagnosis,), place=RESULT)
