"""What a diagnosis was asked to consider, in words and as values of a document: it changes the answer."""

from typing import Any

from mouse_cli.model.diagnosis import Choices


def considered(asked: Choices) -> str:
    """Which candidates, and how many mechanisms together.

    >>> considered(Choices(("mass", "crack"), 1)), considered(Choices())
    ('Considered: of all candidates only mass, crack; one mechanism at a time.', \
'Considered: all candidates; up to 4 mechanisms together, as the data need.')
    """
    causes = "one mechanism at a time" if asked.causes == 1 else f"up to {asked.causes} mechanisms together, as the data need"
    which = "all candidates" if asked.candidates is None else f"of all candidates only {', '.join(asked.candidates)}"
    return f"Considered: {which}; {causes}."


def document(asked: Choices) -> dict[str, Any]:
    """The same as keys of a document."""
    return {"candidates": asked.candidates and list(asked.candidates), "causes": asked.causes}
