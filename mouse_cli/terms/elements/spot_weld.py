"""Spot weld: the nugget between two sheets as a short round beam from the middle of one sheet to that of the other."""

import numpy as np

from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties, Property
from mouse_cli.terms.elements import _beam as beam
from mouse_cli.terms.elements.beam import matrices as timoshenko

_KAPPA = 0.9  # of a round section


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """Timoshenko beam of diameter d: A = pi d^2/4, I = pi d^4/64, J = 2 I; E and G over `softness` for sheets that are flexible."""
    p, zero = properties, np.zeros(len(layout))
    A = np.pi * p["diameter"] ** 2 / 4
    I = A * p["diameter"] ** 2 / 16
    E, G = p["E"] / p["softness"], p["G"] / p["softness"]
    section = {"A": A, "Iy": I, "Iz": I, "J": 2 * I, "kappa_y": zero + _KAPPA, "kappa_z": zero + _KAPPA}
    rest = {"nonstructural_mass": zero, "preload": zero, "rotary_factor": zero + 1.0, "density": p["density"]}
    options = {**layout.options, "theory": "timoshenko"}
    return timoshenko(Layout(layout.coordinates, options), {"E": E, "G": G, **section, **rest})


ELEMENT = ElementType(
    "spot_weld",
    "spot weld: a short round beam between the middles of two sheets",
    (2,),
    {
        "E": Property("Young's modulus", "Pa", positive=True),
        "nu": Property("Poisson's ratio", "1", 0.3),
        "G": Property(
            "shear modulus; not given: E / (2 (1 + nu))", "Pa", lambda _, p: p["E"] / (2 * (1 + p["nu"])), True
        ),
        "density": Property("density", "kg/m3", 0.0),
        "diameter": Property("diameter of the nugget", "m", positive=True),
        "softness": Property("factor of compliance of the flexible sheets around the nugget", "1", 1.0, True),
    },
    matrices,
    {**beam.ORIENTATION, **beam.OFFSETS},
    ("loss_factor", "stiffness_damping", "mass_damping"),
    reach=True,
)
