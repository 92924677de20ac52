"""Rod, cable or string: axial force only, and the stiffness across it that its tension makes."""

import numpy as np

from mouse_cli.terms.elements import DAMPING, GEOMETRIC, ElementType, Layout, Matrices, Option, Properties, Property
from mouse_cli.terms.elements import _beam as beam


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """K = E A/l along the rod; N/l across it, N the preload; M of linear shapes in all three directions."""
    p, at = properties, beam.span(layout)
    pair = np.array([[1.0, -1.0], [-1.0, 1.0]])
    x = at.axes[:, 0]
    along = x[:, :, None] * x[:, None, :]
    mass = (p["density"] * p["A"] + p["nonstructural_mass"]) * at.length
    shape = np.eye(2) / 2 if layout.options.get("mass") == "lumped" else np.array([[2.0, 1.0], [1.0, 2.0]]) / 6
    found = {
        "K": _spread(p["E"] * p["A"] / at.length, pair, along),
        "M": _spread(mass, shape, np.broadcast_to(np.eye(3), along.shape)),
    }
    tension = p["preload"] + (0.0 if layout.axial is None else layout.axial)
    if (tension != 0).any():
        found[GEOMETRIC] = _spread(tension / at.length, pair, np.eye(3) - along)
    return found


def _spread(value: np.ndarray, ends: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """value (e,) times ends (2, 2) in the `directions` (e, 3, 3) of the translations: (e, 12, 12)."""
    out = np.zeros((len(value), 2, 6, 2, 6), value.dtype)
    out[:, :, :3, :, :3] = np.einsum("e,ij,eab->eiajb", value, ends, directions)
    return out.reshape(-1, 12, 12)


def tension(layout: Layout, properties: Properties, u: np.ndarray) -> np.ndarray:
    """E A times the axial strain (e,) under displacements of the nodes u (e, 12)."""
    at = beam.span(layout)
    stretch = np.einsum("ei,ei->e", at.axes[:, 0], u[:, 6:9] - u[:, :3])
    return properties["E"] * properties["A"] / at.length * stretch


ELEMENT = ElementType(
    "rod",
    "rod, cable or string: axial force, and stiffness across it from its tension",
    (2,),
    {
        "E": Property("Young's modulus", "Pa", positive=True),
        "density": Property("density", "kg/m3", 0.0),
        "A": Property("area of the section", "m2", positive=True),
        "nonstructural_mass": Property("further mass per length", "kg/m", 0.0),
        "preload": Property("axial force, tension positive; it stiffens across the rod", "N", 0.0),
    },
    matrices,
    {"mass": Option("mass matrix", "consistent", ("consistent", "lumped"))},
    tuple(DAMPING),
    tension,
    reach=True,
)
