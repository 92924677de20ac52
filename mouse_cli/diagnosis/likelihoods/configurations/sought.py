"""What is sought in configurations, as a user chose it and as the state before a change allows."""

from dataclasses import dataclass

from mouse_cli.diagnosis.likelihoods.configurations.erring import Before
from mouse_cli.diagnosis.mechanisms import Candidate, registry
from mouse_cli.diagnosis.names import of_modes
from mouse_cli.model.diagnosis import Choices


@dataclass(frozen=True)
class Sought:
    """choices: of the user; before: the state before; None: there is none, or it is of another model."""

    choices: Choices
    before: Before | None

    def known(self, changed: bool) -> dict[str, Candidate]:
        """Candidates by key: those that were chosen, or all; of what may have changed between tests without those that last, else
        without those of a change alone.
        """
        if (chosen := of_modes(self.choices.candidates)) is not None:
            return chosen
        return {key: one for key, one in registry().items() if not (one.lasting if changed else one.between)}

    @property
    def refused(self) -> str:
        """Why no change is sought, in a sentence; empty: one is."""
        return "" if self.before is None else self.before.refused
