"""One member that is softer as a whole: a weaker section or corrosion, with its mass or without."""

from collections.abc import Iterator

from benchmarks.blind.case import Case, generator
from benchmarks.blind.space.frames import case, drawn, quality, visible


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames; the member and what is left of it are drawn until the test can show them."""
    for k in range(count):
        rng = generator(split, seed, "space", "member", k)
        frame, config = drawn(rng), quality(rng)
        sound = frame.inputs(rng)
        while True:
            member, left, lighter = (
                int(rng.integers(len(frame.members))),
                float(rng.uniform(0.25, 0.75)),
                bool(rng.integers(2)),
            )
            inputs = sound | {"factors": {str(member): [left, left if lighter else 1.0]}}
            if visible(inputs, sound, config):
                break
        place = frame.middle(member)
        about = {"groups": ("local-stiffness",), "places": (place,), "sizes": {"share lost": 1 - left}}
        yield case("member", k, frame, inputs, config, "softer member", **about)
