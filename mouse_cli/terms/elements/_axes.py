"""Axes of elements: local frames, rigid arms, and springs on the relative motion of two points."""

import numpy as np

from mouse_cli.terms.elements import AXES, Layout, Matrices, Option, Properties, Property

DIRECTIONS = ("TX", "TY", "TZ", "RX", "RY", "RZ")
AXES_OPTION = {
    "axes": Option("local x, and a vector in the local x-y plane; none: the global axes", None, form=AXES),
}


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 3) at length 1."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def arm(vectors: np.ndarray) -> np.ndarray:
    """Rigid arms (e, 6, 6): motion of the end of `vectors` (e, 3) from that of their origin, u + theta x a and theta."""
    x, y, z = np.moveaxis(np.asarray(vectors, float), -1, 0)
    found = np.broadcast_to(np.eye(6), (*x.shape, 6, 6)).copy()
    found[..., 0, 4], found[..., 0, 5] = z, -y
    found[..., 1, 3], found[..., 1, 5] = -z, x
    found[..., 2, 3], found[..., 2, 4] = y, -x
    return found


def given_frame(layout: Layout) -> np.ndarray:
    """Rows: local x, y, z in global axes (3, 3), from the option `axes`."""
    axes = layout.options.get("axes")
    if axes is None:
        return np.eye(3)
    x = unit(np.asarray(axes[0], float))
    z = unit(np.cross(x, np.asarray(axes[1], float)))
    return np.stack([x, np.cross(z, x), z])


def directional(meaning: str, translation: str, rotation: str) -> dict[str, Property]:
    """Six properties, TX to RZ, all 0 unless given."""
    units = [translation] * 3 + [rotation] * 3
    return {name: Property(f"{meaning} along {name}", unit, 0.0) for name, unit in zip(DIRECTIONS, units, strict=True)}


def relative(layout: Layout) -> np.ndarray:
    """From the displacements of the nodes to the local motion of the second relative to the first (6, 6 k).

    With one node the other end is the ground. Each direction acts by itself, as if both nodes were at one place.
    """
    R = np.kron(np.eye(2), given_frame(layout))
    return R if layout.coordinates.shape[1] == 1 else np.hstack([-R, R])


def on_relative_motion(layout: Layout, properties: Properties) -> np.ndarray:
    """B' diag(TX, ..., RZ) B (e, 6 k, 6 k), B the relative motion."""
    B = layout.once("relative", relative)
    k = np.stack([properties[name] for name in DIRECTIONS], axis=1)
    return B.T @ (k[:, :, None] * B)


def stiffness(layout: Layout, properties: Properties) -> Matrices:
    """K of six springs on the relative motion."""
    return {"K": on_relative_motion(layout, properties)}
