"""Physics outside of the library: the energy that it adds to plates and ends of beams in motions whose integrals are known."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.trials import beam, plate
from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.outside import grounds, plates


@pytest.fixture
def blank() -> Blank:
    return plate.plate(np.random.default_rng(3))


def added(blank: Blank, draw, which: int) -> tuple[Mechanism, np.ndarray]:
    """What is drawn, and what it adds to K (0) or M (1)."""
    before = blank.truth.base[which].copy()
    found = draw(blank, np.random.default_rng(5))
    return found, blank.truth.base[which] - before


def motion(blank: Blank, kind: str) -> np.ndarray:
    """w = 1, w = x or w = x^2 / 2 at all points of the plate: w, w_x, w_y, w_xy."""
    a = blank.span
    x = np.repeat(np.arange(plate.COLUMNS + 1) * a / plate.COLUMNS, plate.ROWS + 1)
    w, slope = {"one": (1 + 0 * x, 0 * x), "x": (x, 1 + 0 * x), "bent": (x**2 / 2, x)}[kind]
    return np.column_stack([w, slope, 0 * x, 0 * x]).ravel()


def energy(A: np.ndarray, u: np.ndarray) -> float:
    """u'A u."""
    return float(u @ A @ u)


def sides(blank: Blank) -> tuple[float, float]:
    return tuple(np.max([xyz[:2] for xyz in blank.nodes.values()], axis=0).tolist())


def test_an_edge_turns_on_a_spring_per_length(blank):
    found, K = added(blank, plates.elastic_edge, 0)
    assert energy(K, motion(blank, "x")) == pytest.approx(found.size * sides(blank)[1])
    assert energy(K, motion(blank, "one")) == pytest.approx(0.0)


def test_a_strip_under_an_edge_is_a_spring_per_length(blank):
    found, K = added(blank, plates.gasket, 0)
    assert energy(K, motion(blank, "one")) == pytest.approx(found.size * sides(blank)[1])


def test_a_force_in_the_plane_acts_on_slopes(blank):
    found, K = added(blank, plates.pull, 0)
    a, b = sides(blank)
    assert energy(K, motion(blank, "x")) == pytest.approx(found.size * a * b)


def test_a_patch_bends_less_where_it_is(blank):
    D = energy(blank.truth.base[0], motion(blank, "bent")) / np.prod(sides(blank))
    found, K = added(blank, plates.thin_patch, 0)
    ((low, high),) = found.regions
    area = np.prod(np.minimum(high, sides(blank)) - np.array(low))
    assert energy(K, motion(blank, "bent")) == pytest.approx((found.size - 1) * D * area)


def test_a_rib_bends_and_weighs_along_its_line(blank):
    before = blank.truth.base[1].copy()
    found, K = added(blank, plates.rib, 0)
    ((low, high),) = found.regions
    length = high[0] - low[0]
    assert energy(K, motion(blank, "bent")) == pytest.approx(found.size * length)
    kg = energy(blank.truth.base[1] - before, motion(blank, "one"))
    assert 0.0 < kg < 0.05 * blank.weight


def test_liquid_weighs_on_its_part(blank):
    area = energy(blank.truth.base[1], motion(blank, "one"))
    found, M = added(blank, plates.wet, 1)
    ((low, high),) = found.regions
    assert energy(M, motion(blank, "one")) == pytest.approx(found.size * area * (high[0] - low[0]) / blank.span)


@pytest.mark.parametrize("seed", range(4))
def test_an_elastic_wall_is_a_half_infinite_beam_on_a_bed(seed):
    """4 EI b^3 across, 2 EI b in turning, and 2 EI b^2 of both, by which a push into the structure turns the end with it."""
    made = beam.beam(np.random.default_rng(seed), "clamped")
    found = grounds.elastic_wall(made, np.random.default_rng(seed))
    node = next(i for i in made.feet if made.places[i] == found.at)
    w, turn, b = 3 * node + 1, 3 * node + 2, found.size
    inward = 1 if made.places[node][0] < made.span / 2 else -1
    K = np.zeros((2, 2))
    for terms, k in made.truth.springs:
        own = np.array([terms.get(w, 0.0), terms.get(turn, 0.0)])
        K += k * np.outer(own, own)
    exact = made.EI * np.array([[4 * b**3, -inward * 2 * b**2], [-inward * 2 * b**2, 2 * b]])
    assert pytest.approx(exact) == K
