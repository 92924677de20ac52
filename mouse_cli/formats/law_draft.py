"""A law of a local force as a deck gives it, before the degrees of freedom of the model are known."""

from dataclasses import dataclass

from mouse_cli._span import Span


@dataclass
class LawDraft:
    """dofs: numbers from 1, or labels, as written."""

    law: str
    variant: str
    dofs: list[str]
    values: dict[str, float]
    where: Span | None = None
