"""The errors of theory that an answer allows for, in words and as values of a document."""

from dataclasses import asdict
from typing import Any

from mouse_cli.model.arrangements import ArrangementsDiagnosis
from mouse_cli.model.diagnosis import Diagnosis
from mouse_cli.model.record_diagnosis import RecordDiagnosis
from mouse_cli.model.record_update import RecordUpdate
from mouse_cli.model.theory import Theory

Answer = Diagnosis | ArrangementsDiagnosis | RecordUpdate
_WORDS = {
    "frequency": "{} of each frequency",
    "shape": "{} of the largest component of each shape",
    "mechanism": "{} of what a mechanism does to them",
    "configurations": "{} of each frequency in all configurations alike",
    "link_stiffness": "{} of the stiffness of each part that no parameter of the deck reaches",
    "link_damping": "{} of its damping, of a mode at least 1 % of critical, 2 % where the deck has no damping",
}
_OF_FRF = "{} of the largest component of each shape, and of the largest response at each line"


def allowed(found: Answer) -> Theory:
    """The errors of theory of an answer; of configurations, the one that was asked for."""
    return found.theory if isinstance(found, ArrangementsDiagnosis) else found.problem.theory


def used(found: Answer) -> tuple[str, ...]:
    """Which of them this kind of answer rests on."""
    if isinstance(found, RecordDiagnosis | RecordUpdate):
        return "link_stiffness", "link_damping"
    if isinstance(found, ArrangementsDiagnosis):
        return "frequency", "shape", "configurations"
    return "frequency", "shape", "mechanism"


def stated(found: Answer) -> str:
    """One sentence.

    >>> import mouse_cli
    >>> stated(mouse_cli.diagnose(mouse_cli.read_deck("decks/ground_spring.yaml")))[:63]
    'Errors of theory allowed for (sd): 0.04 % of each frequency, 0.'
    """
    words = _WORDS | ({"shape": _OF_FRF} if found.problem.frf else {})
    shares = (words[name].format(f"{100 * getattr(allowed(found), name):.3g} %") for name in used(found))
    return f"Errors of theory allowed for (sd): {', '.join(shares)}."


def document(found: Answer) -> dict[str, Any]:
    """Every key of `theory:` of a deck; None where this kind of answer does not use it."""
    own = used(found)
    return {name: value if name in own else None for name, value in asdict(allowed(found)).items()}
