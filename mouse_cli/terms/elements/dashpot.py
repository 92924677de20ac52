"""Viscous dashpots between two nodes, or from one node to the ground."""

from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties
from mouse_cli.terms.elements._axes import AXES_OPTION, directional, on_relative_motion


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """C of six dashpots on the relative motion."""
    return {"C": on_relative_motion(layout, properties)}


ELEMENT = ElementType(
    "dashpot",
    "viscous dashpots on the relative motion of two nodes, direction by direction; one node: to ground",
    (1, 2),
    directional("viscous damping", "N s/m", "N m s/rad"),
    matrices,
    AXES_OPTION,
    damping=(),
)
