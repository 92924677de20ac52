"""Vehicles that might have been: free-free beams of 28 elements that only bend and have the frequencies predicted in 1972.

Known is what the report prints (section 5.2): 58 degrees of freedom, bending only, the frequencies of Table 5-4. Masses and
stiffnesses of its model are lost. Public record gives lengths, diameters and the mass at lift-off; the rest is drawn at random,
and bent until the frequencies fit.
"""

from dataclasses import replace

import numpy as np

from benchmarks.saturn.decks import RIGID, calibration, head, model
from benchmarks.saturn.stack import ELEMENTS, HEIGHT, MASS, MEASURED, PREDICTED, STAGES, TOLERANCE, E, Vehicle
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.problem import Problem
from mouse_cli.updating import forecast, run


def draw(rng: np.random.Generator, own_radii: bool = False) -> Vehicle:
    """A vehicle before calibration: total mass within 5 %, mass and EI of stages and of their elements log-normal.

    own_radii: sections have the radius of their stage, else that of the first stage throughout. It matters for shear and for rotary
    inertia alone; EI is the same.
    """
    count = [stage.elements for stage in STAGES]
    number = np.repeat(np.arange(len(STAGES)), count)
    lengths = np.repeat([stage.length / stage.elements for stage in STAGES], count)
    lengths *= HEIGHT / lengths.sum()
    radius = np.repeat([stage.radius for stage in STAGES], count)
    share = np.array([stage.share for stage in STAGES]) * np.exp(rng.normal(0, 0.15, len(STAGES)))
    mass = (share / share.sum() / np.bincount(number, lengths))[number] * np.exp(rng.normal(0, 0.2, len(number)))
    mass *= MASS * rng.uniform(0.95, 1.05) / (mass @ lengths)
    wall = np.array([stage.thickness for stage in STAGES]) * np.exp(rng.normal(0, 0.3, len(STAGES)))
    EI = E * np.pi * radius**3 * wall[number] * np.exp(rng.normal(0, 0.1, len(number)))
    section = radius if own_radii else np.full(len(radius), radius.max())
    return Vehicle(np.concatenate([[0.0], np.cumsum(lengths)]), section, mass, EI, number)


def calibrated(vehicle: Vehicle) -> Vehicle:
    """The vehicle nearest to it that has the predicted frequencies, by mouse itself; the total mass stays."""
    theta = run(problem(calibration(vehicle, PREDICTED))).revised.theta
    half = ELEMENTS // 2
    EI, line_mass = vehicle.EI * np.repeat(theta[:half], 2), vehicle.line_mass * theta[half:][vehicle.stage]
    scale = vehicle.mass / float(line_mass @ vehicle.length)
    return replace(vehicle, EI=EI * scale, line_mass=line_mass * scale)


def family(count: int, seed: int, own_radii: bool = False) -> list[Vehicle]:
    """`count` calibrated vehicles; those whose frequencies stay off by more than the tolerance are drawn anew."""
    found: list[Vehicle] = []
    for number in range(10 * count):
        vehicle = calibrated(draw(np.random.default_rng([seed, number]), own_radii))
        if np.abs(frequencies(vehicle) / PREDICTED - 1).max() < TOLERANCE:
            found.append(vehicle)
        if len(found) == count:
            break
    return found


def frequencies(vehicle: Vehicle, theory: str = "", count: int = len(PREDICTED)) -> np.ndarray:
    """Of bending (count,), Hz, by mouse. theory: further keys of the elements."""
    return forecast(problem(head("") + model(vehicle, theory)), RIGID + count).frequencies_hz[RIGID:]


def with_shear(vehicle: Vehicle, rotary: bool) -> np.ndarray:
    """Frequencies (5,) in Hz with the shear of a thin tube, kappa = 1/2; one factor on EI makes mode 1 as measured."""
    theory = "\n        theory: timoshenko\n        kappa_y: 0.5\n        rotary_inertia: " + (
        "included" if rotary else "omitted"
    )
    factor = 1.0
    for _ in range(12):
        hz = frequencies(replace(vehicle, EI=factor * vehicle.EI), theory)
        factor *= (MEASURED[0] / hz[0]) ** 2
    return hz


def problem(text: str) -> Problem:
    """The deck `text`."""
    return assemble(yaml_deck.read(text, "saturn.yaml"))
