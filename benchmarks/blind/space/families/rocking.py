"""Storey buildings on foundations that rock."""

from collections.abc import Iterator

from benchmarks.blind.case import Case, generator
from benchmarks.blind.space import storeys


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` buildings; the foundation has 10 to 50 % of the flexibility."""
    for k in range(count):
        rng = generator(split, seed, "space", "rocking", k)
        share, building = float(rng.uniform(0.1, 0.5)), storeys.drawn(rng)
        yield storeys.case("rocking", k, building, rng, share, truth="rocking foundation", groups=("support",))
