"""Kinds of answers: where the sections of each are, and which module makes its document.

By the name of the type, so that the report of one kind does not load the others.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    """sections: file or folder of `report/sections`. document: module of `report`."""

    sections: str
    document: str


KINDS = {
    "ArrangementsDiagnosis": Kind("arrangements", "arrangements_document"),
    "Bootstrap": Kind("campaign", "campaign_document"),
    "Compared": Kind("comparison", "update_document"),
    "Correlation": Kind("correlation", "correlation_document"),
    "Coupled": Kind("coupling", "coupling_document"),
    "Diagnosis": Kind("diagnosis", "diagnosis_document"),
    "Forecast": Kind("run", "modes_document"),
    "Identification": Kind("identification", "identification_document"),
    "Modified": Kind("coupling", "modification_document"),
    "RecordDiagnosis": Kind("records", "record_document"),
    "RecordUpdate": Kind("records", "record_update_document"),
    "Result": Kind("run", "result_document"),
    "Sampled": Kind("sample", "sample_document"),
    "SpectraResult": Kind("spectra", "spectra_document"),
    "Sweep": Kind("campaign", "campaign_document"),
    "Updated": Kind("update", "update_document"),
}


def kind(subject: type) -> Kind:
    """The kind of a type of answers. Raises KeyError for what is no answer."""
    return KINDS[subject.__name__]
