"""Where such physics acts, which names are as true, and which nameless fields would describe it."""

from benchmarks.trials.case import Blank

Box = tuple[tuple[float, ...], tuple[float, ...]]
# names (physics, group) that are as true where they are declared, at the site of the mechanism
BED, FOOT = ("foundation", "foundation"), ("support-rotation", "support")
SOFT, STIFF = ("stiffness-loss", "local-stiffness"), ("stiffness-gain", "added-stiffness")
BRACE, ROCKING, CORNERS = ("brace", "brace"), ("rocking", "support"), ("semi-rigid", "semi-rigid")
MOVING, BLOCK = ("support-translation", "support"), ("block-translation", "support")
MOUNT, OSCILLATOR, MASS = ("ground-spring", "ground-spring"), ("oscillator", "oscillator"), ("mass", "mass")
ADDED = ("added-mass", "added-mass")
BESIDE = ("neighbour", "oscillator")
LOCAL = ("stiffness", "force")  # properties of nameless fields that describe what acts at places


def stretch(blank: Blank, start: float, stop: float) -> tuple[Box, ...]:
    """Part of a beam, by its length."""
    return (((start * blank.span, 0.0), (stop * blank.span, 0.0)),)


def around(*points: tuple[float, ...]) -> tuple[Box, ...]:
    """Places as boxes of no size."""
    return tuple((tuple(p), tuple(p)) for p in points)
