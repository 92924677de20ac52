"""Beam with an open edge crack at midspan, which gives way in bending and in shear (lecture 21-1)."""

from dataclasses import replace

import numpy as np

from mouse_cli.terms import fracture
from mouse_cli.terms.elements import ElementType, Layout, Matrices, Option, Properties, Property
from mouse_cli.terms.elements import _beam as beam
from mouse_cli.terms.elements.beam import PROPERTIES as BEAM
from mouse_cli.terms.elements.beam import matrices as generic
from mouse_cli.terms.elements.beam import tension

_OWN = ("symmetric", "antisymmetric", "coupling", "symmetric_twist", "antisymmetric_twist")
_THEORY = ("kappa", "rotary_factor", "m11", "m12", "m14", "m22", *_OWN)


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """The generic beam with s = 1/(1 + x), a = 1/(1 + y), x = 6 (1 - nu^2) alpha F1, y = 2 (1 - nu^2) alpha^3 F2, alpha = h/l.

    That is k_ww = 12 a and k_thth = s + 3 a of lecture 21-1, whose printed k_ww lacks the 2 of y: k_thth - k_ww/4 = s is bending
    alone and must not depend on shear. The crack opens under bending about the axis of the option `about`; the other plane, axial
    force and torsion are those of the sound beam.
    """
    p, length, one = properties, beam.span(layout).length, np.ones(len(layout))
    alpha, strain = p["height"] / length, 1 - p["nu"] ** 2
    x = 6 * strain * alpha * fracture.bending(p["depth"])
    y = 2 * strain * alpha**3 * fracture.shearing(p["depth"])
    sound = {name: (one if name in ("symmetric", "antisymmetric") else 0 * one) for name in _OWN}
    found = {f"{name}_{axis}": value for name, value in sound.items() for axis in "yz"}
    axis = layout.options.get("about") or "z"
    found |= {f"symmetric_{axis}": 1 / (1 + x), f"antisymmetric_{axis}": 1 / (1 + y)}
    shape = {name: np.full(len(layout), BEAM[name].default) for name in ("m11", "m12", "m14", "m22", "rotary_factor")}
    return generic(replace(layout, options={**layout.options, "theory": "generic"}), {**p, **found, **shape})


def _height(_: Layout, p: Properties) -> np.ndarray:
    return np.sqrt(12 * p["Iz"] / p["A"])


ELEMENT = ElementType(
    "cracked_beam",
    "straight beam of Euler and Bernoulli with an open edge crack at midspan",
    (2,),
    {
        **{name: about for name, about in BEAM.items() if not name.startswith(_THEORY) and "damping" not in name},
        "depth": Property("depth of the crack over the height of the section, below 1", "1", 0.1, True, below=1.0),
        "height": Property(
            "height h of the section; not given: sqrt(12 Iz/A), that of a rectangle", "m", _height, True
        ),
    },
    matrices,
    {
        "about": Option("local axis of the bending under which the crack opens", "z", ("y", "z")),
        "mass": Option("mass matrix", "consistent", ("consistent", "lumped")),
        **beam.ORIENTATION,
        **beam.OFFSETS,
    },
    ("loss_factor", "stiffness_damping", "mass_damping"),
    tension,
    reach=True,
)
