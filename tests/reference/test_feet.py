"""What acts on all columns of a frame alike, at their feet or along them: truths by matrices of numpy."""

from itertools import pairwise

import numpy as np

from mouse_cli.diagnosis import diagnose
from mouse_cli.model.diagnosis import NAMED, Choices
from tests.reference.test_attached import modes, read
from tests.reference.test_mounted_mass import INERTIA, RHO, A, E, element

FEET, HEIGHT, PARTS = (0.0, 1.0, 2.0), 0.8, 4
SLIDES, TURNS, PUSH = 1.5e5, 1.2e3, 6e3  # N/m, N m/rad, N
SENSORS = ["3TX", "4TX", "5TX", "5TY", "8TX", "10TX", "10TY", "13TX", "15TX", "17TY", "19TX", "20TY"]


def frame() -> tuple[np.ndarray, list[tuple[int, int]]]:
    """Points (n, 2) of columns of PARTS bars on three feet and of beams of as many between their heads, and bars between them."""
    points = [(x, HEIGHT * i / PARTS) for x in FEET for i in range(PARTS + 1)]
    tops = [PARTS + i * (PARTS + 1) for i in range(len(FEET))]
    runs = [list(range(top - PARTS, top + 1)) for top in tops]
    for a, b in pairwise(tops):
        between = list(range(len(points), len(points) + PARTS - 1))
        points += [(points[a][0] + i / PARTS, HEIGHT) for i in range(1, PARTS)]
        runs.append([a, *between, b])
    return np.array(points), [bar for run in runs for bar in pairwise(run)]


def softened(length: float, push: float) -> np.ndarray:
    """What a compression takes off K (6, 6) of an upright bar: its consistent geometric stiffness."""
    found, own, l = np.zeros((6, 6)), [0, 2, 3, 5], length
    found[np.ix_(own, own)] = (push / (30 * l)) * np.array([
        [36, -3 * l, -36, -3 * l], [-3 * l, 4 * l**2, 3 * l, -(l**2)], [-36, 3 * l, 36, 3 * l], [-3 * l, -(l**2), 3 * l, 4 * l**2],
    ])  # fmt: skip
    return found


def deck(slides: float, turns: float, push: float = 0.0) -> str:
    """The frame with rigid feet and no load, measured on feet that slide and turn, 0: not at all, and hold upwards; its columns
    under compression.
    """
    points, bars = frame()
    K, M = np.zeros((2, 3 * len(points), 3 * len(points)))
    for i, j in bars:
        at = [*range(3 * i, 3 * i + 3), *range(3 * j, 3 * j + 3)]
        for whole, own in zip((K, M), element(points[i], points[j]), strict=True):
            whole[np.ix_(at, at)] += own
        if points[i][0] == points[j][0]:
            K[np.ix_(at, at)] -= softened(HEIGHT / PARTS, push)
    feet = [3 * i for i, (_, y) in enumerate(points) if y == 0]
    for foot in feet:
        K[foot, foot] += slides
        K[foot + 2, foot + 2] += turns
    held = [1] if slides else [0, 1, 2]
    free = np.setdiff1d(np.arange(len(K)), [foot + d for foot in feet for d in held])
    rows = {s: int(np.flatnonzero(free == 3 * (int(s[:-2]) - 1) + "XY".index(s[-1]))[0]) for s in SENSORS}
    listed = "".join(
        f"      - {{id: {e}, type: beam, nodes: [{i + 1}, {j + 1}], E: {E}, A: {A}, Iz: {INERTIA}, density: {RHO}}}\n"
        for e, (i, j) in enumerate(bars, 1)
    )
    return (
        f"mouse: 1\nmodel:\n  structure:\n    nodes: {{{', '.join(f'{i}: {p.tolist()}' for i, p in enumerate(points, 1))}}}\n"
        f"    elements:\n{listed}    supports: {{1: all, 6: all, 11: all}}\n    plane: XY\n"
        f"parameters:\n  - {{name: E, elements: 1-{len(bars)}, property: E, sd: 3 %, transform: log}}\n"
        f"{modes(K[np.ix_(free, free)], M[np.ix_(free, free)], rows, 3, 7)}"
    )


def test_feet_that_all_slide_and_turn_are_loose_alike():
    """The middle one slides by little beside what lifts the outer ones, and is one of them all the same."""
    rivals = "loose-support", "support-translation", "support-rotation"
    found = diagnose(read(deck(SLIDES, TURNS)), choices=Choices(rivals, causes=2))
    (cause,) = found.best.causes
    text = "the supports of nodes 1, 6, 11, TX and RZ, all alike"
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "loose-support", text)
    for size, true in zip(cause.sizes, (SLIDES, TURNS), strict=True):
        assert abs(size.value - true) < 3 * size.sd < 0.5 * true


def test_columns_that_are_pushed_alike_have_one_force():
    found = diagnose(read(deck(0.0, 0.0, PUSH)), choices=Choices(("compression", "support-rotation", "stiffness-loss"), causes=1))
    (cause,) = found.best.causes
    text = "elements 1 to 4, elements 5 to 8 and elements 9 to 12, all alike"
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "compression", text)
    (size,) = cause.sizes
    assert abs(size.value - PUSH) < 3 * size.sd < 0.3 * PUSH
