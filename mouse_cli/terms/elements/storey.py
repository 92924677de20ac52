"""Storey of a shear building: lateral springs between two floors, softened by the weight above."""

import numpy as np

from mouse_cli.terms.elements import GEOMETRIC, ElementType, Layout, Matrices, Properties, Property
from mouse_cli.terms.elements._axes import DIRECTIONS, relative
from mouse_cli.terms.elements._beam import span


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """K of springs on the drift; N/h across the storey in the directions that have stiffness, N its axial force.

    Floors do not turn with the drift: moments go to the columns that the storey stands for.
    """
    p = properties
    B = layout.once("relative", relative)
    k = np.stack([p[name] if name in p else np.zeros(len(layout)) for name in DIRECTIONS], axis=1)
    found = {"K": B.T @ (k[:, :, None] * B)}
    force = p["preload"] + (0.0 if layout.axial is None else layout.axial)
    if (force != 0).any():
        x = span(layout).axes[:, 0]
        across = np.zeros((len(layout), 6, 6))
        across[:, :3, :3] = np.eye(3) - x[:, :, None] * x[:, None, :]
        held = (k != 0).astype(float)
        across *= held[:, :, None] * held[:, None, :]
        found[GEOMETRIC] = (force / p["height"])[:, None, None] * (B.T @ across @ B)
    return found


ELEMENT = ElementType(
    "storey",
    "storey of a shear building between two floors",
    (2,),
    {
        "TX": Property("lateral stiffness along global X", "N/m", 0.0),
        "TY": Property("lateral stiffness along global Y", "N/m", 0.0),
        "TZ": Property("stiffness along global Z", "N/m", 0.0),
        "RZ": Property("stiffness against turning about global Z", "N m/rad", 0.0),
        "height": Property("height; not given: distance of the nodes", "m", lambda at, _: span(at).length, True),
        "preload": Property("axial force, tension positive", "N", 0.0),
    },
    matrices,
    reach=True,
    stacked=True,
)
