"""Laws at their places: of a deck, and of a hypothesis with free parameters."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mouse_cli.model.diagnosis import Site
from mouse_cli.terms.laws import Law, Scale, Unknown

_TAKEN = 1e-3  # share of a spring of the model that a law takes from it, at least


def _columns(B: np.ndarray, across: np.ndarray | None) -> np.ndarray:
    return np.column_stack([B] if across is None else [B, across])


@dataclass(frozen=True)
class Place:
    """Where a law may act. B (m,): the motion in the coordinates of the simulation; motion (n,): by the degrees of freedom of the
    deck; ground: whether its other end is the ground. channel: number of a channel instead, outputs before forces. across (m,):
    another motion of the same body, where a law of two acts; (m, d - 1): all other translations of a body that has several. whole:
    whether its motions are all translations of its body; body: the name of one that has several, as what acts along one of them
    and what acts along all are at one place.
    """

    site: Site
    B: np.ndarray
    ground: bool
    scale: Scale
    motion: np.ndarray
    channel: int = -1
    across: np.ndarray | None = None
    whole: bool = False
    body: str = ""

    @property
    def where(self) -> str:
        """What is the same of two places where laws are at one."""
        return self.body or self.site.text

    @property
    def directions(self) -> np.ndarray:
        """Its motions (m, d)."""
        return _columns(self.B, self.across)


@dataclass(frozen=True)
class Acting:
    """A law that the deck has already: its motion B (n,), its parameters p (q,); across (n,): its other motion, if it has two."""

    B: np.ndarray
    law: Law
    words: dict[str, float]
    p: np.ndarray
    across: np.ndarray | None = None

    @property
    def directions(self) -> np.ndarray:
        """Its motions (n, d)."""
        return _columns(self.B, self.across)

    @cached_property
    def extra(self) -> int:
        """Degrees of freedom of a linear law's own."""
        count = self.directions.shape[1]
        return len(self.law.on(count, self.p, self.words)[0]) - count if self.law.linear else 0


@dataclass(frozen=True)
class Part:
    """A law at a place, in one of its variants; ranges: of its parameters, where they are not those of the law there."""

    place: Place
    law: Law
    variant: int
    ranges: tuple[Unknown, ...] = ()

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """Its parameters and how large they may be."""
        found = self.ranges or self.law.unknowns(self.place.scale)
        if self.variant not in self.law.linked or not (link := self.place.scale.link):
            return found
        return (replace(found[0], lower=min(found[0].lower, _TAKEN * link), upper=min(found[0].upper, link)), *found[1:])

    @property
    def candidate(self) -> Law:
        """What has the name, as in every hypothesis."""
        return self.law

    @property
    def title(self) -> str:
        """The law and its variant in words."""
        word = self.law.words[self.variant]
        return f"{self.law.title} ({word})" if word else self.law.title

    @property
    def site(self) -> Site:
        """Where it acts: what has inertia of its own is at its place, and not between that and the ground."""
        own = self.place.site
        if self.law.at not in ("body", "ground"):
            return own
        return replace(own, text=own.text.removeprefix("between ").removesuffix(" and the ground"))

    @property
    def words(self) -> dict[str, float]:
        """Its variant, as the law takes it."""
        return self.law.variants[self.variant]

    def matrices(self, p: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, C, M of a linear law, on the motions of its place first."""
        return self.law.on(self.place.directions.shape[1], p, self.words)

    @cached_property
    def extra(self) -> int:
        """Degrees of freedom of a linear law's own."""
        middle = np.array([np.sqrt(u.lower * u.upper) for u in self.unknowns])
        return len(self.matrices(middle)[0]) - self.place.directions.shape[1] if self.law.linear else 0

    def acting(self, p: np.ndarray) -> Acting:
        """With parameters p."""
        return Acting(self.place.B, self.law, self.words, p, self.place.across)
