"""Mechanisms that the library of `mouse diagnose` has, put into a truth. Sizes are drawn log-uniformly from what tests meet."""

from collections.abc import Callable

import numpy as np

from benchmarks.trials.case import Blank, Line, Mechanism

Draw = Callable[[Blank, np.random.Generator], Mechanism]


def log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def somewhere(blank: Blank, rng: np.random.Generator) -> tuple[int, int, tuple[float, float]]:
    """(degree of freedom across, node of the truth, place) where the structure moves and sensors are not far."""
    if not blank.lines:
        places = list(blank.places)
        if blank.family == "plate":
            places = [dof for dof in places if blank.places[dof][0] > 0.25 * blank.span]
        dof = int(rng.choice(places))
        return dof, dof, blank.places[dof]
    line, at = on_line(blank, rng, 0.15, 0.85)
    node = int(line.nodes[at])
    return 3 * node + int(not line.upright), node, blank.places[node]


def on_line(blank: Blank, rng: np.random.Generator, low: float, high: float) -> tuple[Line, int]:
    """A member, and the index of a point on it."""
    line = blank.lines[int(rng.integers(len(blank.lines)))]
    return line, round(rng.uniform(low, high) * (len(line.nodes) - 1))


def mass(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A lumped mass of 1.5 to 12 % of the whole."""
    dof, node, at = somewhere(blank, rng)
    kg = blank.weight * log_uniform(rng, 0.015, 0.12)
    for one in (3 * node, 3 * node + 1) if blank.lines else (dof,):
        blank.truth.weight({one: 1.0}, kg)
    return Mechanism("mass", "mass", "mass", at, blank.near(), kg)


def ground_spring(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A spring to the ground, across a member."""
    dof, _, at = somewhere(blank, rng)
    k = blank.weight * blank.first**2 * log_uniform(rng, 0.1, 3.0) * (0.1 if not blank.lines else 1.0)
    blank.truth.spring({dof: 1.0}, k)
    return Mechanism("ground spring", "ground-spring", "ground-spring", at, blank.near(), k)


def oscillator(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A hidden oscillator of 1 to 6 % of the mass, tuned between the modes measured."""
    dof, _, at = somewhere(blank, rng)
    kg = blank.weight * log_uniform(rng, 0.01, 0.06)
    low, high = blank.truth.modes(4)[0][[0, -1]] * 2 * np.pi
    k = kg * log_uniform(rng, 1.1 * low, 0.95 * high) ** 2
    blank.truth.oscillator(dof, kg, k)
    return Mechanism("oscillator", "oscillator", "oscillator", at, blank.near(), kg)


def hinge(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A crack inside a member: a rotational spring whose compliance is that of 1 to 10 % of the member."""
    line, at = on_line(blank, rng, 0.06, 0.94)
    k = blank.EI / (line.length * log_uniform(rng, 0.01, 0.10))
    blank.truth.hinge(int(line.elements[min(at, len(line.elements) - 1)]), 0, k)
    place = blank.places[int(line.nodes[at])]
    return Mechanism("crack", "crack", "local-stiffness", place, blank.near(), k)


def joint(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """An end of a member that turns against its corner."""
    number, end = blank.corners[int(rng.integers(len(blank.corners)))]
    return joint_at(blank, number, end, rng)


def joint_at(
    blank: Blank, number: int, end: int, rng: np.random.Generator, low: float = 0.03, high: float = 0.4
) -> Mechanism:
    """The end (0 or 1) of member `number` turns; its spring's compliance is that of `low` to `high` of the member."""
    line = blank.lines[number]
    k = blank.EI / (line.length * log_uniform(rng, low, high))
    blank.truth.hinge(int(line.elements[-end]), end, k)
    return Mechanism("joint", "joint", "local-stiffness", line.point(end), blank.near(), k)


def soft(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A stretch of a member, or one spring of a chain, that has lost 20 to 55 % of its stiffness."""
    loss = rng.uniform(0.2, 0.55)
    if not blank.lines:
        i = int(rng.integers(1, len(blank.places) + 1))
        b, k = blank.truth.springs[i - 1]
        blank.truth.springs[i - 1] = (b, k * (1 - loss))
        return Mechanism("soft spring", "stiffness-loss", "local-stiffness", (0.0, i - 0.5), 0.6, loss)
    line = blank.lines[int(rng.integers(len(blank.lines)))]
    width = rng.uniform(0.08, 0.3)
    middle = rng.uniform(width / 2 + 0.03, 0.97 - width / 2)
    count = len(line.elements)
    own = line.elements[int((middle - width / 2) * count) : int(np.ceil((middle + width / 2) * count))]
    blank.truth.EI[own] *= 1 - loss
    reach = max(blank.near(), 0.5 * width * line.length)
    return Mechanism("soft stretch", "stiffness-loss", "local-stiffness", line.point(middle), reach, loss)


def axial(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Tension, or compression below a third of what buckles a pinned bar."""
    sign = 1 if rng.integers(2) else -1
    force = (
        sign * np.pi**2 * blank.EI / blank.span**2 * (rng.uniform(0.15, 1.0) if sign > 0 else rng.uniform(0.05, 0.2))
    )
    blank.truth.axial += force
    return Mechanism("axial force", "tension" if sign > 0 else "compression", "axial", size=float(force))


def foundation(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """An elastic bed under all of a beam."""
    k = blank.line_mass * blank.first**2 * log_uniform(rng, 0.03, 0.6)
    blank.truth.bed += k
    return Mechanism("foundation", "foundation", "foundation", size=float(k))


def support_rotation(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A clamp that turns."""
    return flexible(blank, int(rng.choice(_clamped(blank))), rng)


def flexible(blank: Blank, node: int, rng: np.random.Generator) -> Mechanism:
    """The clamp at a node of the truth turns."""
    k = blank.EI / (_reach(blank) * log_uniform(rng, 0.02, 0.25))
    blank.truth.held.discard(3 * node + 2)
    blank.truth.spring({3 * node + 2: 1.0}, k)
    return Mechanism("rotating support", "support-rotation", "support", blank.places[node], blank.near(), k)


def support_translation(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """A support that moves across the member on it."""
    node = int(rng.choice(blank.feet))
    dof = 3 * node + int(blank.family == "beam")
    k = blank.EI / _reach(blank) ** 3 / log_uniform(rng, 0.0005, 0.01)
    blank.truth.held.discard(dof)
    blank.truth.spring({dof: 1.0}, k)
    return Mechanism("moving support", "support-translation", "support", blank.places[node], blank.near(), k)


def _clamped(blank: Blank) -> list[int]:
    return [node for node in blank.feet if 3 * node + 2 in blank.truth.held]


def _reach(blank: Blank) -> float:
    """Length of a member at a support."""
    return blank.lines[0].length


def taper(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """EI and mass that grow along a beam: 1 + a xi and 1 + b xi, xi from -1 to 1."""
    slope = float(rng.choice([-1, 1])) * rng.uniform(0.1, 0.35)
    xi = 2 * blank.truth.along / blank.span - 1
    blank.truth.EI *= 1 + slope * xi
    blank.truth.m *= 1 + slope / 3 * xi
    return Mechanism("taper", "taper", "taper", size=slope)


def added_mass(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Mass per length on a beam from one end on: liquid, ice, cladding."""
    share, more = rng.uniform(0.25, 0.6), log_uniform(rng, 0.06, 0.35)
    at = blank.truth.along / blank.span
    left = bool(rng.integers(2)) and blank.kind != "cantilever"
    blank.truth.m[(at < share) if left else (at > 1 - share)] *= 1 + more
    middle = (share / 2 if left else 1 - share / 2) * blank.span
    return Mechanism("added mass", "added-mass", "added-mass", (float(middle), 0.0), share * blank.span, more)


def mass_loss(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """One point mass of the deck that has lost 30 to 100 % of itself."""
    if not blank.masses:
        raise ValueError("no point masses")
    node, kg = blank.masses[int(rng.integers(len(blank.masses)))]
    return removed(blank, node, kg, rng.uniform(0.3, 1.0) if blank.lines else rng.uniform(0.2, 0.5))


def removed(blank: Blank, node: int, kg: float, share: float) -> Mechanism:
    """A share of a point mass is gone."""
    blank.truth.weight({3 * node + 1 if blank.lines else node: 1.0}, -share * kg)
    return Mechanism("mass lost", "mass-loss", "mass-loss", blank.places[node], blank.near(), float(share * kg))


def shear(blank: Blank, rng: np.random.Generator) -> Mechanism:
    """Nothing to add: the structure is thick, which its deck after Euler and Bernoulli does not have."""
    return Mechanism("thick", "timoshenko", "shear")


def slender(blank: Blank) -> None:
    """The same structure as Euler and Bernoulli have it."""
    blank.truth.GA[:], blank.truth.rotary[:] = np.inf, 0.0
