"""Elastic foundation along a line: springs per length from the bar between two nodes to the ground."""

import numpy as np

from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties, Property
from mouse_cli.terms.elements import _beam as beam


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """K = integral of N' k N: cubic shapes across the line, linear ones along it and in torsion."""
    p, length = properties, beam.span(layout).length
    K = np.zeros((len(layout), 12, 12), np.result_type(*p.values()))
    for dofs, k in (((0, 6), p["kx"]), ((3, 9), p["kr"])):
        beam.two_ended(K, k * length, dofs, (1 / 3, 1 / 6))
    w, _, _ = beam.shapes(length, np.zeros(len(layout)))
    for plane, k in enumerate((p["ky"], p["kz"])):
        beam.in_plane(K, beam.integral(w, k * length), plane)
    return beam.to_nodes(layout, {"K": K})


ELEMENT = ElementType(
    "foundation",
    "elastic foundation (Winkler) of the line between two nodes, usually those of a beam",
    (2,),
    {
        "kx": Property("stiffness per length along the line", "N/m2", 0.0),
        "ky": Property("stiffness per length along local y", "N/m2", 0.0),
        "kz": Property("stiffness per length along local z", "N/m2", 0.0),
        "kr": Property("stiffness per length against turning about the line", "N/rad", 0.0),
    },
    matrices,
    {**beam.ORIENTATION, **beam.OFFSETS},
    reach=True,
)
