"""Physics that a model may lack: one module = one candidate, found by `registry`; each says where it can act and what it does."""

from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced


@dataclass(frozen=True)
class Candidate:
    """key; title: in words; group: of candidates that data can hardly tell apart; meaning: what it is, for the manual.

    recipes(model): where it can act in a model and how; empty where it has no meaning.
    """

    key: str
    title: str
    group: str
    meaning: str
    recipes: Callable[[Reduced, "Candidate"], list[Recipe]]


def registry() -> dict[str, Candidate]:
    """All candidates by key."""
    return _registry.discover(__name__, "CANDIDATE")
