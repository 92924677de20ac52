"""From a result to what people and programs read: printout, Markdown, JSON document. Reads results and computes nothing."""

from typing import Any

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.campaign import Bootstrap, Sweep
from mouse_cli.model.correlation import Correlation
from mouse_cli.model.coupled import Coupled
from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.identification import Identification
from mouse_cli.model.modified import Modified
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.result import Forecast, Result
from mouse_cli.model.sampled import Sampled
from mouse_cli.model.spectra import SpectraResult
from mouse_cli.model.updated import Compared, Updated
from mouse_cli.report.section import Options

Subject = (
    Result
    | Forecast
    | Correlation
    | Diagnosis
    | ArrangementsDiagnosis
    | RecordUpdate
    | SpectraResult
    | Identification
    | Coupled
    | Modified
    | Updated
    | Compared
    | Sampled
    | Sweep
    | Bootstrap
)

__all__ = ["Options", "document", "markdown", "printout", "written"]


def written(subject: Subject, form: str, numbers: str | None = None, options: Options | None = None) -> str:
    """The report of `subject` in a `form` of `report.renderers`, numbers in its own style or in another.

    Raises ValueError for a form or a style that does not exist.

    >>> import mouse_cli
    >>> text = mouse_cli.written(mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml")), "markdown")
    >>> text.splitlines()[0]
    '## Modal Optimization Using Statistical Evaluators'
    """
    from mouse_cli.report.numbers import Numbers
    from mouse_cli.report.renderers import renderer
    from mouse_cli.report.section import blocks

    chosen = renderer(form)
    return chosen.render(blocks(subject, options), Numbers(numbers or chosen.numbers))


def printout(subject: Subject, numbers: str = "legacy", options: Options | None = None) -> str:
    """The report of `subject` as the line printer gave it, no line longer than 132 columns."""
    return written(subject, "printout", numbers, options)


def markdown(subject: Subject, numbers: str = "modern", options: Options | None = None) -> str:
    """The report of `subject` in GitHub's Markdown."""
    return written(subject, "markdown", numbers, options)


def document(subject: Subject) -> dict[str, Any]:
    """The report of `subject` as JSON can hold it: no NaN, no infinity, plain Python values."""
    from mouse_cli.report import (
        arrangements_document,
        campaign_document,
        correlation_document,
        coupling_document,
        diagnosis_document,
        identification_document,
        modes_document,
        modification_document,
        record_document,
        record_update_document,
        result_document,
        sample_document,
        spectra_document,
        update_document,
    )

    documents = {
        Forecast: modes_document,
        ArrangementsDiagnosis: arrangements_document,
        Correlation: correlation_document,
        Diagnosis: diagnosis_document,
        RecordDiagnosis: record_document,
        RecordUpdate: record_update_document,
        Identification: identification_document,
        SpectraResult: spectra_document,
        Updated: update_document,
        Compared: update_document,
        Coupled: coupling_document,
        Modified: modification_document,
        Sampled: sample_document,
        Sweep: campaign_document,
        Bootstrap: campaign_document,
    }
    return documents.get(type(subject), result_document).document(subject)
