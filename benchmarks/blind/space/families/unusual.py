"""What frames meet beside a softer member or a brace: slabs, walls, corroded storeys, heavy floors, soft footings."""

from collections.abc import Iterator

import numpy as np

from benchmarks.blind.case import Case, generator, log_uniform
from benchmarks.blind.space.frames import E, Frame, case, drawn, quality, visible

SUPPORT, LOSS, MASS = "support", "local-stiffness", ("mass", "floor-mass", "added-mass")
_SLAB = 0.03 * E  # EA of a diagonal of a slab, N


def storey(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """All columns of one storey have lost a share of themselves, their mass too."""
    heights = np.unique(frame.points[:, 2])
    k, left = int(rng.integers(len(heights) - 1)), float(rng.uniform(0.5, 0.8))
    middle = (heights[k] + heights[k + 1]) / 2
    own = [n for n in range(len(frame.members)) if abs(frame.middle(n)[2] - middle) < 1e-6]
    return {"factors": {str(n): [left, left] for n in own}}, {"groups": (LOSS,), "truth": "corroded storey"}


def slab(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """One floor is a slab, stiff in its plane: diagonals in all of its fields."""
    z = float(rng.choice(np.unique(frame.points[:, 2])[1:]))
    own = np.flatnonzero(frame.points[:, 2] == z)
    xs, ys = (np.unique(frame.points[own, d]) for d in (0, 1))
    at = {tuple(frame.points[n, :2]): int(n) for n in own}
    fields = [(i, j) for i in range(len(xs) - 1) for j in range(len(ys) - 1)]
    struts = []
    for i, j in fields:
        a, b, c, d = (at[xs[i + p], ys[j + q]] for p, q in ((0, 0), (1, 1), (1, 0), (0, 1)))
        struts += [[a, b, _SLAB], [c, d, _SLAB]]
    return {"struts": struts}, {"groups": ("brace",), "truth": "stiff slab"}


def wall(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """A masonry panel in one field of a facade: both diagonals."""
    uprights = [n for n, s in enumerate(frame.section) if s == 0]
    pairs = [
        (a, b)
        for a in uprights
        for b in uprights
        if a < b and frame.middle(a)[2] == frame.middle(b)[2] and _neighbours(frame, a, b)
    ]
    a, b = pairs[int(rng.integers(len(pairs)))]
    (p, q), (r, s) = frame.members[a].tolist(), frame.members[b].tolist()
    EA = E * log_uniform(rng, 1e-4, 2e-3)
    place = tuple(np.mean([frame.middle(a), frame.middle(b)], axis=0).tolist())
    about = {"groups": ("brace",), "places": (place,), "truth": "masonry panel"}
    return {"struts": [[p, s, EA], [q, r, EA]]}, about


def _neighbours(frame: Frame, a: int, b: int) -> bool:
    foot = {int(frame.members[n][0]) for n in (a, b)}
    return any({int(p), int(q)} == foot for p, q in frame.members) or len(foot & set(frame.feet)) == 2


def heavy(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """Stores on one whole floor."""
    z = float(rng.choice(np.unique(frame.points[:, 2])[1:]))
    own, share = np.flatnonzero(frame.points[:, 2] == z), float(rng.uniform(0.15, 0.5))
    kg = np.array(sound["kg"])
    kg[own] *= 1 + share
    return {"kg": kg.tolist()}, {"groups": MASS, "truth": "stores on a floor"}


def two(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """A softer member, and a mass at a node."""
    member, left = int(rng.integers(len(frame.members))), float(rng.uniform(0.2, 0.5))
    node = int(rng.choice(np.flatnonzero(frame.points[:, 2] > 0)))
    kg = float(frame.kg.sum() * rng.uniform(0.03, 0.1))
    places = (frame.middle(member), tuple(frame.points[node].tolist()))
    about = {"groups": (f"{LOSS} + mass",), "places": places, "truth": "member and mass"}
    return {"factors": {str(member): [left, 1.0]}, "masses": [[node, [0.0, 0.0, 0.0], kg]]}, about


def soft_foot(frame: Frame, rng: np.random.Generator, sound: dict) -> tuple[dict, dict]:
    """One footing that sinks and turns on its soil."""
    node = int(rng.choice(frame.feet))
    I = frame.sections[0, 1]
    k = 4 * E * I / 3.5 * log_uniform(rng, 0.1, 1.0)
    springs = [[node, d, v] for d, v in ((3, 50 * k), (4, k), (5, k))]
    about = {"groups": (SUPPORT,), "places": (tuple(frame.points[node].tolist()),), "truth": "soft footing"}
    return {"springs": springs}, about


KINDS = (storey, slab, wall, heavy, two, soft_foot)


def cases(split: str, seed: int, count: int) -> Iterator[Case]:
    """`count` frames, the kinds in turn, each as large as the test can show."""
    for k in range(count):
        rng = generator(split, seed, "space", "unusual", k)
        frame, config = drawn(rng), quality(rng)
        sound = frame.inputs(rng)
        while True:
            change, about = KINDS[k % len(KINDS)](frame, rng, sound)
            if visible(sound | change, sound, config):
                break
        yield case("unusual", k, frame, sound | change, config, **about)
