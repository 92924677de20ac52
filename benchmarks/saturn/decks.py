"""A vehicle as YAML decks: 29 nodes, deflection and slope."""

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from benchmarks.saturn.stack import NU, UPPER, E, Vehicle

RIGID = 2  # modes of a free beam in its plane


def model(vehicle: Vehicle, theory: str = "") -> str:
    """Beams of thin tubes: I = A R^2/2, so that E/(kappa G) = 4 (1 + nu) is a tube's own shear; its density is all mass per length.

    theory: further keys of the elements.
    """
    I = vehicle.EI / E
    A = 2 * I / vehicle.radius**2
    nodes = "\n".join(f"      {i}: [{x:.4f}, 0]" for i, x in enumerate(vehicle.x, 1))
    return f"""\
model:
  structure:
    nodes:
{nodes}
    materials: {{aluminium: {{E: {E:.3g}, nu: {NU}}}}}
    elements:
      - id: 1-{len(I)}
        type: beam
        nodes: 1-{len(I) + 1}
        material: aluminium
        Iz: {_list(I)}
        A: {_list(A)}
        density: {_list(vehicle.line_mass / A)}{theory}
    directions: [TY, RZ]
"""


def test(frequencies: Sequence[float], sd: str, first: int = 1) -> str:
    """Bending modes `first` and on."""
    numbers = list(range(first + RIGID, first + RIGID + len(frequencies)))
    return f"""
test:
  modes:
    number: {numbers}
    frequency: [{", ".join(f"{hz:g}" for hz in frequencies)}]
    frequency_sd: {sd}
"""


def factors(name: str, property: str, groups: Iterable[tuple[int, int]], sd: str, transform: str = "log") -> str:
    """A factor, 1 before the test, on the property of each group (first, last) of elements."""
    rows = [
        f"  - {{name: {name} {a}-{b}, elements: {a}-{b}, property: {property}, factor: true, sd: {sd}, transform: {transform}}}\n"
        for a, b in groups
    ]
    return "".join(rows)


def calibration(vehicle: Vehicle, predicted: Sequence[float]) -> str:
    """EI by pairs of elements and the mass of stages, free to move until the frequencies are those predicted."""
    pairs = [(i, i + 1) for i in range(1, len(vehicle.EI), 2)]
    return (
        head("calibration")
        + model(vehicle)
        + "\nparameters:\n"
        + factors("EI", "E", pairs, "30 %")
        + factors("mass", "density", stages(vehicle), "10 %")
        + test(predicted, "0.2 %")
    )


def upper_half(vehicle: Vehicle, measured: Sequence[float]) -> str:
    """The deck of 1972: each element of the upper half has an EI of its own, 25 % uncertain; the lower half is held."""
    each = [(i, i) for i in range(1, UPPER + 1)]
    own = factors("EI", "E", each, "25 %", "identity")
    return head("upper half free") + model(vehicle) + "\nparameters:\n" + own + test(measured, "1 %")


def segments(vehicle: Vehicle, measured: Sequence[float]) -> str:
    """The deck of a diagnosis: EI of each of the stages uncertain by 30 %."""
    own = factors("EI", "E", stages(vehicle), "30 %")
    return head("stages uncertain") + model(vehicle) + "\nparameters:\n" + own + test(measured, "1 %")


def stages(vehicle: Vehicle) -> list[tuple[int, int]]:
    """First and last element of each stage."""
    cut = np.flatnonzero(np.diff(vehicle.stage, prepend=-1, append=-1))
    return [(int(a) + 1, int(b)) for a, b in pairwise(cut)]


def head(title: str) -> str:
    """First lines of a deck."""
    return f"mouse: 1\ntitle: A vehicle that might have been Saturn V - {title}\n\n"


def _list(values: Iterable[float]) -> str:
    return "[" + ", ".join(f"{v:.6g}" for v in values) + "]"
