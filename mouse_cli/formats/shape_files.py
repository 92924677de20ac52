"""Mode shapes for other programs: universal files (data sets 15, 55 and 82) and VTK (legacy, ASCII)."""

import numpy as np

from mouse_cli.model.geometry import DIRECTIONS, Geometry


def at_nodes(geometry: Geometry, shapes: np.ndarray) -> np.ndarray:
    """Shapes (k, 6, m) at all nodes of shapes (n, m); 0 in directions that have no degree of freedom."""
    found = np.zeros((len(geometry.node_ids), len(DIRECTIONS), shapes.shape[1]))
    on = geometry.node >= 0
    found[geometry.node[on], geometry.direction[on]] = shapes[on]
    return found


def universal(title: str, geometry: Geometry, hz: np.ndarray, shapes: np.ndarray) -> str:
    """Nodes (15), lines (82) and real normal modes with six values at a node (55), after the specification of SDRC."""
    points, values = geometry.coordinates, at_nodes(geometry, shapes)
    lines = ["    -1", "    15"]
    lines += [f"{node:10d}{0:10d}{0:10d}{8:10d}" + "".join(f"{x:13.5E}" for x in xyz)
              for node, xyz in zip(geometry.node_ids, points, strict=True)]  # fmt: skip
    lines += ["    -1"]
    pairs = [(0, *geometry.node_ids[pair]) for pair in geometry.lines]
    trace = [number for pair in pairs for number in (pair[1], pair[2], 0)]
    if trace:
        lines += ["    -1", "    82", f"{1:10d}{len(trace):10d}{8:10d}", title[:80] or "NONE"]
        lines += ["".join(f"{n:10d}" for n in trace[i : i + 8]) for i in range(0, len(trace), 8)] + ["    -1"]
    for mode, frequency in enumerate(hz):
        lines += ["    -1", "    55", title[:80] or "NONE", *["NONE"] * 4]
        lines += ["".join(f"{n:10d}" for n in (1, 2, 3, 8, 2, 6)), "".join(f"{n:10d}" for n in (2, 4, 0, mode + 1))]
        lines += ["".join(f"{x:13.5E}" for x in (frequency, 1.0, 0.0, 0.0))]
        for node, value in zip(geometry.node_ids, values[:, :, mode], strict=True):
            lines += [f"{node:10d}", "".join(f"{x:13.5E}" for x in value)]
        lines += ["    -1"]
    return "\n".join(lines) + "\n"


def vtk(title: str, geometry: Geometry, hz: np.ndarray, shapes: np.ndarray) -> str:
    """Nodes with their numbers, lines and one field of vectors for each mode."""
    k, values = len(geometry.node_ids), at_nodes(geometry, shapes)
    lines = [
        "# vtk DataFile Version 3.0",
        title[:200].replace("\n", " ") or "mouse",
        "ASCII",
        "DATASET UNSTRUCTURED_GRID",
    ]
    lines += [f"POINTS {k} double", *(" ".join(f"{x:.9g}" for x in xyz) for xyz in geometry.coordinates)]
    cells = geometry.lines if len(geometry.lines) else np.arange(k)[:, None]
    width = cells.shape[1]
    lines += [
        f"CELLS {len(cells)} {len(cells) * (width + 1)}",
        *(f"{width} " + " ".join(map(str, cell)) for cell in cells),
    ]
    lines += [f"CELL_TYPES {len(cells)}", *[str(3 if width == 2 else 1)] * len(cells), f"POINT_DATA {k}"]
    lines += ["SCALARS node double 1", "LOOKUP_TABLE default", *(f"{x:.9g}" for x in geometry.node_ids)]
    for mode, frequency in enumerate(hz):
        lines.append(f"VECTORS mode_{mode + 1}_{frequency:.6g}_Hz double")
        lines += [" ".join(f"{x:.9g}" for x in value[:3]) for value in values[:, :, mode]]
    return "\n".join(lines) + "\n"
