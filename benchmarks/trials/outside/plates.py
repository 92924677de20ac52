"""What plates lack: parts that have come apart, flexible edges, forces in their plane, ribs, liquid."""

from itertools import pairwise

import numpy as np

from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.library import log_uniform
from benchmarks.trials.outside.places import LOCAL, Box
from benchmarks.trials.plate import COLUMNS, ROWS, integrals, matrices


def _sides(blank: Blank) -> tuple[float, float, float, float]:
    """Length, width, D (N m) and mass per area (kg/m2) of the true plate."""
    a, b = np.max([xyz[:2] for xyz in blank.nodes.values()], axis=0).tolist()
    D, area = blank.stiffness * a**3 / b, blank.weight / (a * b)
    return a, b, D * blank.parameters["stiffness"], area * blank.parameters["mass"]


def _column(i: int) -> np.ndarray:
    """First of the degrees of freedom of the points on x = i a / COLUMNS (ROWS + 1,)."""
    return 4 * (i * (ROWS + 1) + np.arange(ROWS + 1))


def _line(points: np.ndarray, own: tuple[int, int], piece: np.ndarray, into: np.ndarray) -> None:
    """Adds to a matrix an integral (4, 4) along each piece of a line of points, `own`: value and slope among four at each."""
    for p, q in pairwise(points.tolist()):
        at = [p + own[0], p + own[1], q + own[0], q + own[1]]
        into[np.ix_(at, at)] += piece


def _box(a: float, b: float, x: tuple[float, float], y: tuple[float, float]) -> tuple[Box, ...]:
    return (((x[0] * a, y[0] * b), (x[1] * a, y[1] * b)),)


def thin_patch(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A rectangle that has come apart inside: it keeps its mass and bends as layers that slip."""
    a, b, D, _ = _sides(blank)
    x, y = int(rng.integers(0, COLUMNS - 3)), int(rng.integers(0, ROWS - 2))
    to_x, to_y, left = x + int(rng.integers(2, 5)), y + int(rng.integers(2, 4)), rng.uniform(0.25, 0.6)
    share = np.zeros((COLUMNS, ROWS))
    share[x : min(to_x, COLUMNS), y : min(to_y, ROWS)] = left - 1
    blank.truth.base[0][:] += D * matrices(a, b, COLUMNS, ROWS, share)[0]
    region = _box(a, b, (x / COLUMNS, to_x / COLUMNS), (y / ROWS, to_y / ROWS))
    return Mechanism("delaminated patch", size=left, properties=LOCAL, regions=region)


def elastic_edge(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """The clamped edge turns all along, on a spring per length."""
    a, b, D, _ = _sides(blank)
    k = D / (a * log_uniform(rng, 0.02, 0.2))
    edge = _column(0)
    blank.truth.held -= {int(one) for i in (1, 3) for one in edge + i}
    _line(edge, (1, 3), k * integrals(b / ROWS)[0], blank.truth.base[0])
    return Mechanism("edge that turns", size=k, properties=LOCAL, regions=_box(a, b, (0.0, 0.15), (0.0, 1.0)))


def pull(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Force per width along the plate, N (dw/dx)^2 / 2, as of an edge that is pulled or warm."""
    a, b, D, _ = _sides(blank)
    N = D / a**2 * (log_uniform(rng, 0.3, 3.0) if rng.integers(2) else -log_uniform(rng, 0.1, 0.7))
    blank.truth.base[0][:] += N * matrices(a, b, COLUMNS, ROWS, of="slope")[0]
    return Mechanism("force in the plane", size=float(N), properties=LOCAL)


def rib(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A rib along the plate from its clamped edge on, which bends and weighs."""
    a, b, D, area = _sides(blank)
    row, last = int(rng.integers(1, ROWS)), int(rng.integers(COLUMNS // 2, COLUMNS + 1))
    points, l = np.array([_column(i)[row] for i in range(last + 1)]), a / COLUMNS
    whole, _, bend, _ = integrals(l)
    EI = D * b * log_uniform(rng, 0.05, 0.5)
    _line(points, (0, 1), EI * bend, blank.truth.base[0])
    _line(points, (0, 1), area * b * rng.uniform(0.01, 0.04) * whole, blank.truth.base[1])
    region = _box(a, b, (0.0, last / COLUMNS), (row / ROWS, row / ROWS))
    return Mechanism("rib", size=EI, properties=LOCAL, regions=region)


def wet(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Liquid that rides on the outer part of the plate."""
    a, b, _, area = _sides(blank)
    first, more = int(rng.integers(3, COLUMNS - 2)), log_uniform(rng, 0.08, 0.5)
    share = np.zeros((COLUMNS, ROWS))
    share[first:] = more
    blank.truth.base[1][:] += area * matrices(a, b, COLUMNS, ROWS, share)[1]
    region = _box(a, b, (first / COLUMNS, 1.0), (0.0, 1.0))
    return Mechanism("liquid", size=more, properties=("mass",), regions=region)


def gasket(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A soft strip under the far edge, a spring per length."""
    a, b, D, _ = _sides(blank)
    k = D / a**3 * log_uniform(rng, 0.3, 10.0)
    _line(_column(COLUMNS), (0, 2), k * integrals(b / ROWS)[0], blank.truth.base[0])
    region = _box(a, b, (1.0, 1.0), (0.0, 1.0))
    return Mechanism("strip under an edge", size=k, properties=("bed", *LOCAL), regions=region)
