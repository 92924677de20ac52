"""A force that a deck puts between two degrees of freedom, or between one and the ground, by a law that is not linear."""

from dataclasses import dataclass


@dataclass(frozen=True)
class LocalLaw:
    """law: key of a law of terms.laws; variant: its word, empty for laws with one. dofs, from 0: one, which acts against the
    ground, or two, and then the motion is that of the second relative to the first. values: sizes by the names of the law.
    """

    law: str
    variant: str
    dofs: tuple[int, ...]
    values: dict[str, float]
