"""What acts between places or with motions of its own: soil, arms, struts, mounts, thrust, parts that stand on others."""

from dataclasses import replace

import numpy as np

from benchmarks.trials.case import Blank, Mechanism
from benchmarks.trials.library import joint_at, log_uniform, somewhere
from benchmarks.trials.outside.places import BRACE, CORNERS, FOOT, LOCAL, MASS, MOUNT, OSCILLATOR, ROCKING, around


def rocking(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Soil under a chain of storeys that turns: every storey feels u_i - u_(i-1) - phi, k phi^2 / 2 in the soil."""
    truth = blank.truth
    phi, n = truth.new_dof(), len(blank.places)
    truth.springs = [(b | {phi: -1.0}, k) for b, k in truth.springs]
    k = blank.stiffness * n**2 * log_uniform(rng, 0.3, 3.0)
    truth.spring({phi: 1.0}, k)
    also = (ROCKING,) if blank.family == "storeys" else ()  # whose heights the deck knows
    return Mechanism("rocking soil", size=k, also=also, properties=LOCAL)


def outrigger(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A place of a member is tied against turning by an arm."""
    _, node, at = somewhere(blank, rng)
    k = blank.EI / blank.lines[0].length * log_uniform(rng, 0.5, 8.0)
    blank.truth.spring({3 * node + 2: 1.0}, k)
    return Mechanism("outrigger", size=k, properties=LOCAL, regions=around(at))


def distant(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A spring between two distant places, which feels their difference."""
    for _ in range(100):
        (a, _, p), (b, _, q) = somewhere(blank, rng), somewhere(blank, rng)
        if np.hypot(*np.subtract(p, q)) > 0.3 * blank.span and (not blank.lines or a % 3 == b % 3):
            break
    k = blank.weight * blank.first**2 * log_uniform(rng, 0.2, 3.0) * (1.0 if blank.lines else 0.1)
    blank.truth.spring({a: 1.0, b: -1.0}, k)
    about = {"properties": LOCAL, "regions": around(p, q)}
    if blank.family in ("chain", "storeys"):  # whose springs act along one direction, as a brace of the library does
        at = tuple(np.mean([p, q], axis=0).tolist())
        return Mechanism("spring between distant places", "", "", at, blank.near(), k, (BRACE,), **about)
    return Mechanism("spring between distant places", size=k, **about)


def eccentric(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Storeys that twist, as their masses are off the axis: u_i + e theta_i moves, and springs turn too."""
    truth, n = blank.truth, len(blank.places)
    radius, arm = rng.uniform(0.35, 0.5), rng.uniform(0.05, 0.2)  # of inertia, and of the mass, in widths
    stiff = (radius * rng.uniform(1.2, 1.8)) ** 2
    turns = [truth.new_dof() for _ in range(n)]
    for b, k in list(truth.springs):
        truth.spring({turns[dof]: c for dof, c in b.items()}, k * stiff)
    for i in range(n):
        kg = truth.base[1][i, i]
        truth.base[1][i, i] = 0.0
        truth.weight({i: 1.0, turns[i]: arm}, kg)
        truth.weight({turns[i]: 1.0}, kg * radius**2)
    return Mechanism("eccentric masses", size=arm, also=(("offset", "offset"),), properties=("mass",))


def amplitude(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A clamp that turns more the more it is loaded: each mode, tested at an amplitude of its own, has its own spring."""
    nodes = [node for node in blank.feet if 3 * node + 2 in blank.truth.held]
    node = int(rng.choice(nodes))
    k = blank.EI / (blank.lines[0].length * log_uniform(rng, 0.03, 0.15))
    softened = k * np.exp(rng.uniform(np.log(0.3), 0.0, 8))
    blank.truth.held.discard(3 * node + 2)
    blank.tuned.append(({3 * node + 2: 1.0}, softened))
    at = blank.places[node]
    return Mechanism("support softened by amplitude", "", "", at, blank.near(), k, (FOOT,), LOCAL, around(at))


def elastomer(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A mount to the ground that is the stiffer the faster it moves: k (f / f_1)^a, as of filled rubber."""
    dof, _, at = somewhere(blank, rng)
    k = blank.weight * blank.first**2 * log_uniform(rng, 0.2, 3.0) * (1.0 if blank.lines else 0.1)
    frequency = blank.truth.modes(8)[0]
    blank.tuned.append(({dof: 1.0}, k * (frequency / frequency[0]) ** rng.uniform(0.3, 0.7)))
    return Mechanism("elastomer mount", "", "", at, blank.near(), k, (MOUNT,), (*LOCAL, "bed"), around(at))


def arch(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A beam that is not straight: y_0 of one half wave, whose ends hold the thrust, EA / L (int y_0'' w dx)^2 / 2.

    Shallow arches after Timoshenko, Theory of Elastic Stability, ch. 7.
    """
    truth, L = blank.truth, blank.span
    x = truth.points[:, 0] / L
    rise = np.sqrt(blank.EI / truth.EA.mean()) * log_uniform(rng, 0.7, 5.0)
    clamped = all(3 * node + 2 in truth.held for node in blank.feet)
    curvature = -2 * np.pi**2 * np.cos(2 * np.pi * x) if clamped else np.pi**2 * np.sin(np.pi * x)
    b = curvature * rise / L**2 * np.gradient(truth.points[:, 0])
    truth.spring({3 * i + 1: float(b[i]) for i in range(1, len(b) - 1)}, float(truth.EA.mean() / L))
    return Mechanism("shallow arch", size=float(rise), properties=LOCAL)


def overall_bending(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A building whose columns stretch: floors turn, and storey i feels u_i - u_(i-1) - (theta_i + theta_(i-1)) / 2."""
    truth, n = blank.truth, len(blank.places)
    turns = [truth.new_dof() for _ in range(n)]
    lower = [None, *turns[:-1]]
    truth.springs = [
        (b | {turn: -0.5} | ({below: -0.5} if below is not None else {}), k)
        for (b, k), turn, below in zip(truth.springs, turns, lower, strict=True)
    ]
    k = blank.stiffness * n**2 * log_uniform(rng, 0.2, 2.0)
    for turn, below in zip(turns, lower, strict=True):
        truth.spring({turn: 1.0} | ({below: -1.0} if below is not None else {}), k)
    return Mechanism("overall bending", size=k, properties=LOCAL)


def attached_beam(blank: Blank, rng: np.random.Generator) -> list[Mechanism]:
    """A clamped-free beam that stands on a place: two of its modes by their effective masses, the rest as a mass."""
    dof, node, at = somewhere(blank, rng)
    kg = blank.weight * log_uniform(rng, 0.02, 0.08)
    low, high = blank.truth.modes(3)[0][[0, -1]] * 2 * np.pi
    omega = log_uniform(rng, 0.8 * low, 0.6 * high)
    for share, ratio in zip(CLAMPED_FREE, FREQUENCIES, strict=True):
        blank.truth.oscillator(dof, share * kg, share * kg * (ratio * omega) ** 2)
    for one in (3 * node, 3 * node + 1) if blank.lines else (dof,):
        blank.truth.weight({one: 1.0}, (1 - sum(CLAMPED_FREE)) * kg)
    own = Mechanism("attached beam", "", "", at, blank.near(), kg, (OSCILLATOR, MASS), (*LOCAL, "mass"), around(at))
    return [own, own]


CLAMPED_FREE, FREQUENCIES = (0.613, 0.188), (1.0, 6.267)  # effective masses over the mass, and (beta_n / beta_1)^2


def every_corner(blank: Blank, rng: np.random.Generator) -> list[Mechanism]:
    """All corners of a frame turn, each by its own amount: bolts instead of welds."""
    each = [joint_at(blank, number, end, rng, 0.02, 0.2) for number, end in blank.corners]
    return [replace(one, also=(*one.also, CORNERS)) for one in each]
