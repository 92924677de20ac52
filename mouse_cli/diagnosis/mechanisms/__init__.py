"""Physics that a model may lack: one module = one candidate, found by `registry`; each says where it can act and what it does."""

from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.diagnosis.effects.change import Recipe
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced

NO_SITE = "it has no site in this model"


@dataclass(frozen=True)
class Candidate:
    """key; title: in words; group: of candidates that data can hardly tell apart; meaning: what it is, for the manual.

    recipes(model): where it can act in a model and how; empty where it has no meaning. why(model): why it has no site in it.
    plain: key of the mechanism that it is where its further size vanishes. lasting: whether it is of the theory, or of how a
    structure is built, which is the same before and after a change. between: whether it is one of a change alone.
    """

    key: str
    title: str
    group: str
    meaning: str
    recipes: Callable[[Reduced, "Candidate"], list[Recipe]]
    why: Callable[[Reduced], str] = lambda model: NO_SITE
    plain: str = ""
    lasting: bool = False
    between: bool = False

    def __reduce__(self):
        """By its key: another process has the same candidates."""
        return _of_key, (self.key,)


def registry() -> dict[str, Candidate]:
    """All candidates by key."""
    return _registry.discover(__name__, "CANDIDATE")


def _of_key(key: str) -> Candidate:
    return registry()[key]
