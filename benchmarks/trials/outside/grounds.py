"""What a structure stands in or beside: walls, pads, foundations with a mass, the building next door."""

import numpy as np

from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.library import log_uniform
from benchmarks.trials.outside.places import BED, BESIDE, BLOCK, FOOT, LOCAL, MOUNT, MOVING, SOFT, around, stretch


def elastic_wall(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A clamp in an elastic wall: the beam goes on in it on a bed (Hetenyi, Beams on Elastic Foundation, 1946, ch. 2).

    With beta of bed and EI the end of a half-infinite beam has the stiffness 4 EI b^3 across, 2 EI b in turning, 2 EI b^2 of both.
    """
    nodes = [node for node in blank.feet if 3 * node + 2 in blank.truth.held]
    node = int(rng.choice(nodes))
    inward = 1.0 if blank.places[node][0] < blank.span / 2 else -1.0
    beta = 1 / (blank.span * log_uniform(rng, 0.008, 0.04))
    w, turn = 3 * node + 1, 3 * node + 2
    blank.truth.held -= {w, turn}
    # 4 b^3 w^2 - 4 b^2 w t + 2 b t^2 = 2 b^3 w^2 + 2 b (b w - t)^2: the wall's beam lies on the other side
    blank.truth.spring({w: 1.0}, 2 * blank.EI * beta**3)
    blank.truth.spring({w: beta, turn: -inward}, 2 * blank.EI * beta)
    at = blank.places[node]
    return Mechanism("clamp in an elastic wall", "", "", at, blank.near(), beta, (FOOT, MOVING), LOCAL, around(at))


def pad(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A soft pad under a short part of a beam."""
    width = rng.uniform(0.08, 0.2)
    middle = rng.uniform(0.25, 0.85)
    at = blank.truth.along / blank.span
    k = blank.line_mass * blank.first**2 * log_uniform(rng, 0.5, 5.0)
    blank.truth.bed[np.abs(at - middle) < width / 2] += k
    region = stretch(blank, middle - width / 2, middle + width / 2)
    place = (float(middle * blank.span), 0.0)
    reach = max(blank.near(), width / 2 * blank.span)
    return Mechanism("pad", "", "", place, reach, float(k), (MOUNT, BED), ("bed", *LOCAL), region)


def foot_on_block(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A foot that stands on a block of its own, which turns on the soil and has inertia."""
    node = int(rng.choice(blank.feet))
    turn = 3 * node + 2
    k = blank.EI / (blank.lines[0].length * log_uniform(rng, 0.03, 0.2))
    last = blank.truth.modes(6)[0][-1] * 2 * np.pi
    blank.truth.held.discard(turn)
    blank.truth.spring({turn: 1.0}, k)
    blank.truth.weight({turn: 1.0}, k / (last * rng.uniform(0.7, 2.0)) ** 2)
    at = blank.places[node]
    return Mechanism("foot on a block", "", "", at, blank.near(), k, (FOOT,), LOCAL, around(at))


def swaying(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A foundation that has a mass and slides on its soil."""
    truth, n = blank.truth, len(blank.places)
    base = truth.new_dof()
    truth.springs[0] = (truth.springs[0][0] | {base: -1.0}, truth.springs[0][1])
    k = blank.stiffness * log_uniform(rng, 1.0, 8.0)
    truth.spring({base: 1.0}, k)
    truth.weight({base: 1.0}, blank.weight / n * rng.uniform(0.5, 3.0))
    about = {"properties": (*LOCAL, "mass"), "regions": around((0.0, 0.5))}
    return Mechanism("swaying foundation", "", "", (0.0, 0.5), 0.6, k, (SOFT, MOVING, BLOCK), **about)


def neighbour(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A building of two storeys beside, tied to one floor by a bridge."""
    truth, n = blank.truth, len(blank.places)
    low, high = truth.new_dof(), truth.new_dof()
    kg = blank.weight / n * rng.uniform(0.5, 1.5)
    k = kg * (blank.first * rng.uniform(0.3, 1.0)) ** 2
    for one in (low, high):
        truth.weight({one: 1.0}, kg)
    truth.spring({low: 1.0}, k)
    truth.spring({high: 1.0, low: -1.0}, k)
    floor = int(rng.integers(1, n))
    truth.spring({floor: 1.0, high: -1.0}, blank.stiffness * log_uniform(rng, 0.05, 0.5))
    at = blank.places[floor]
    return Mechanism("neighbour", "", "", at, 0.6, kg, (BESIDE,), (*LOCAL, "mass"), around(at))
