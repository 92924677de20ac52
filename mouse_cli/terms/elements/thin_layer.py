"""Thin layer of material between two faces, as the contact of a bolted joint (lecture 21-1): normal and shear stiffness."""

import numpy as np

from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties, Property
from mouse_cli.terms.elements.joint import ELEMENT as JOINT
from mouse_cli.terms.elements.joint import matrices as joint


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """A joint of stiffness N A/t, S A/t, S A/t, S J/t, N Iy/t, N Iz/t: the faces stay plane, and keep the layer from shrinking.

    N = lambda + 2 G is the modulus across the layer, S = G that of shear, with lambda = G (E - 2 G)/(3 G - E). (Lecture 21-1 prints
    E - 3 G below, which gives an isotropic material a lambda of the wrong sign: E = 2 G (1 + nu) must give 2 G nu/(1 - 2 nu).) In a
    contact both are what the bolts make of it: each is a property, which a test may revise by itself.
    """
    p = properties
    normal, shear = p["normal"] / p["thickness"], p["shear"] / p["thickness"]
    along = (normal * p["A"], shear * p["A"], shear * p["A"], shear * p["J"], normal * p["Iy"], normal * p["Iz"])
    return joint(layout, dict(zip(("TX", "TY", "TZ", "RX", "RY", "RZ"), along, strict=True)))


def _shear(_: Layout, p: Properties) -> np.ndarray:
    return p["E"] / (2 * (1 + p["nu"]))


def _normal(_: Layout, p: Properties) -> np.ndarray:
    G = p["shear"]
    return G * (p["E"] - 2 * G) / (3 * G - p["E"]) + 2 * G


ELEMENT = ElementType(
    "thin_layer",
    "thin layer of material between two faces, the contact of a bolted joint (x normal, y and z tangential)",
    (2,),
    {
        "E": Property("Young's modulus of the layer", "Pa", 1.0, True),
        "nu": Property("Poisson's ratio", "1", 0.3, below=0.5),
        "shear": Property("modulus G along the layer; not given: E / (2 (1 + nu))", "Pa", _shear, True),
        "normal": Property(
            "modulus lambda + 2 G across the layer, lambda = G (E - 2 G)/(3 G - E); not given: from E and shear",
            "Pa",
            _normal,
            True,
        ),
        "A": Property("area of the contact", "m2", positive=True),
        "Iy": Property("second moment of the contact about local y", "m4", 0.0),
        "Iz": Property("second moment of the contact about local z", "m4", 0.0),
        "J": Property("torsion constant of the contact", "m4", 0.0),
        "thickness": Property("thickness t of the layer", "m", positive=True),
    },
    matrices,
    JOINT.options,
)
