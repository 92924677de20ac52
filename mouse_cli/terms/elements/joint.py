"""Semi-rigid joint or contact between two nodes, in equilibrium wherever they are."""

import numpy as np

from mouse_cli.terms.elements import VECTOR, ElementType, Layout, Matrices, Option, Properties
from mouse_cli.terms.elements._axes import AXES_OPTION, DIRECTIONS, arm, directional, given_frame


def _relative(layout: Layout) -> np.ndarray:
    """From the displacements of the nodes to the local motion across the joint (e, 6, 12): rigid arms lead to its place."""
    nodes = layout.coordinates
    at = layout.options.get("at")
    place = nodes.mean(axis=1) if at is None else np.asarray(at, float)
    R = np.kron(np.eye(2), given_frame(layout))
    return np.concatenate([-R @ arm(place - nodes[:, 0]), R @ arm(place - nodes[:, 1])], axis=2)


def matrices(layout: Layout, properties: Properties) -> Matrices:
    """K = B' diag(TX, ..., RZ) B, B the motion across the joint; a rigid motion of both nodes costs nothing."""
    B = layout.once("relative", _relative)
    k = np.stack([properties[name] for name in DIRECTIONS], axis=1)
    return {"K": B.transpose(0, 2, 1) @ (k[:, :, None] * B)}


ELEMENT = ElementType(
    "joint",
    "semi-rigid joint or contact (x normal, y and z tangential) with rigid arms to both nodes",
    (2,),
    directional("stiffness", "N/m", "N m/rad"),
    matrices,
    {**AXES_OPTION, "at": Option("where it is, [x, y, z] in m; none: midway between the nodes", None, form=VECTOR)},
)
