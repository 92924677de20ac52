"""What is sought in configurations, as a user chose it and as the state before a change allows."""

from dataclasses import dataclass

from mouse_cli.diagnosis.likelihoods.configurations.erring import Before
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.model.arrangements import Compared
from mouse_cli.model.diagnosis import Choices


@dataclass(frozen=True)
class Sought:
    """choices: of the user; before: the state before; None: there is none, or it is of another model."""

    choices: Choices
    before: Before | None

    @property
    def known(self) -> dict[str, Candidate] | None:
        """Candidates by key; None: all."""
        return None if self.choices.candidates is None else {key: registry()[key] for key in self.choices.candidates}

    def worth(self, tests: Compared | None) -> bool:
        """Whether a change is worth seeking, by the tests before and after beside one another and by the state before."""
        return not (tests is not None and tests.alike) and (self.before is None or self.before.explained)
