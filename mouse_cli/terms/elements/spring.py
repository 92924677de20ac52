"""Springs between two nodes, or from one node to the ground."""

from mouse_cli.terms.elements import ElementType
from mouse_cli.terms.elements._axes import AXES_OPTION, directional, stiffness

ELEMENT = ElementType(
    "spring",
    "springs on the relative motion of two nodes, direction by direction, as if they coincided; one node: to ground",
    (1, 2),
    directional("stiffness", "N/m", "N m/rad"),
    stiffness,
    AXES_OPTION,
)
