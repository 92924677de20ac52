"""Sections of PBARL by their dimensions. Truth: integrals over a fine grid of points inside the section, drawn by hand."""

import numpy as np
import pytest

from mouse_cli.importing.bars.shapes import of_shape

STEP = 2.5e-4  # of the grid; all dimensions below are multiples of it


def box(y0: float, y1: float, z0: float, z1: float):
    """Whether points (y, z) are inside a rectangle."""
    return lambda y, z: (y > y0) & (y < y1) & (z > z0) & (z < z1)


DRAWN = {  # kind and dimensions, and rectangles that make it: y is upward, z to the right, as in the figures of the manual
    "BAR": ([0.02, 0.05], [(0, 0.05, 0, 0.02)]),
    "BOX": ([0.06, 0.1, 0.004, 0.003], [(0, 0.004, 0, 0.06), (0.096, 0.1, 0, 0.06), (0, 0.1, 0, 0.003), (0, 0.1, 0.057, 0.06)]),
    "I": ([0.1, 0.05, 0.06, 0.004, 0.005, 0.006], [(0, 0.005, -0.025, 0.025), (0, 0.1, -0.002, 0.002), (0.094, 0.1, -0.03, 0.03)]),
    "I1": ([0.05, 0.005, 0.09, 0.1], [(0, 0.005, 0, 0.055), (0.095, 0.1, 0, 0.055), (0, 0.1, 0.025, 0.03)]),
    "CHAN": ([0.05, 0.1, 0.005, 0.006], [(0, 0.1, 0, 0.005), (0, 0.006, 0, 0.05), (0.094, 0.1, 0, 0.05)]),
    "CHAN1": ([0.05, 0.005, 0.09, 0.1], [(0, 0.1, 0, 0.005), (0, 0.005, 0, 0.055), (0.095, 0.1, 0, 0.055)]),
    "CHAN2": ([0.005, 0.006, 0.08, 0.06], [(0, 0.006, 0, 0.06), (0, 0.08, 0, 0.005), (0, 0.08, 0.055, 0.06)]),
    "T": ([0.06, 0.08, 0.005, 0.006], [(0.075, 0.08, 0, 0.06), (0, 0.08, 0.027, 0.033)]),
    "T1": ([0.06, 0.05, 0.005, 0.006], [(0, 0.06, 0, 0.005), (0.027, 0.033, -0.05, 0)]),
    "T2": ([0.06, 0.08, 0.005, 0.006], [(0, 0.005, 0, 0.06), (0, 0.08, 0.027, 0.033)]),
    "H": ([0.05, 0.01, 0.08, 0.006], [(0, 0.08, 0, 0.005), (0, 0.08, 0.055, 0.06), (0.037, 0.043, 0, 0.06)]),
    "CROSS": ([0.06, 0.01, 0.08, 0.012], [(0, 0.08, 0.03, 0.04), (0.034, 0.046, 0, 0.07)]),
    "Z": ([0.03, 0.005, 0.09, 0.1], [(0, 0.1, 0.03, 0.035), (0.095, 0.1, 0, 0.035), (0, 0.005, 0.03, 0.065)]),
    "L": ([0.05, 0.07, 0.005, 0.006], [(0, 0.07, 0, 0.006), (0, 0.005, 0, 0.05)]),
    "HAT": ([0.05, 0.004, 0.06, 0.03],
            [(0.046, 0.05, 0, 0.06), (0, 0.05, 0, 0.004), (0, 0.05, 0.056, 0.06),
             (0, 0.004, -0.03, 0.004), (0, 0.004, 0.056, 0.09)]),
}  # fmt: skip


@pytest.mark.parametrize("kind", DRAWN)
def test_constants_are_integrals_over_the_section(kind):
    dimensions, parts = DRAWN[kind]
    axis = np.arange(-0.1, 0.1, STEP) + STEP / 2
    y, z = (each.ravel() for each in np.meshgrid(axis, axis, indexing="ij"))
    inside = np.logical_or.reduce([box(*part)(y, z) for part in parts])
    y, z = y[inside] - y[inside].mean(), z[inside] - z[inside].mean()
    cell, own = STEP**2, of_shape(kind, dimensions)
    local = len(y) * cell * STEP**2 / 12  # of each cell about itself
    assert own["A"] == pytest.approx(len(y) * cell, rel=1e-9)
    assert own["Iz"] == pytest.approx(cell * y @ y + local, rel=1e-9)
    assert own["Iy"] == pytest.approx(cell * z @ z + local, rel=1e-9)
    assert own.get("Iyz", 0.0) == pytest.approx(cell * y @ z, rel=1e-9, abs=1e-15)


def test_torsion_and_round_sections():
    """Bredt for a thin box, J = 2 b^2 h^2 t / (b + h); a thin channel, the sum of b t^3 / 3; Roark, table 10.1, case 4."""
    thin = of_shape("BOX", [0.06, 0.1, 1e-4, 1e-4])
    assert thin["J"] == pytest.approx(2 * 0.06**2 * 0.1**2 * 1e-4 / 0.16, rel=5e-3)
    assert of_shape("CHAN", [0.05, 0.1, 0.001, 0.001])["J"] == pytest.approx(0.198 * 1e-9 / 3, rel=1e-9)
    a, b = 0.025, 0.01
    roark = a * b**3 * (16 / 3 - 3.36 * b / a * (1 - b**4 / (12 * a**4)))
    assert of_shape("BAR", [0.02, 0.05])["J"] == pytest.approx(roark, rel=5e-3)
    ring, rod = of_shape("TUBE", [0.05, 0.03]), of_shape("ROD", [0.05])
    assert ring == pytest.approx(of_shape("TUBE2", [0.05, 0.02]), rel=1e-12)
    assert rod["J"] == pytest.approx(np.pi * 0.05**4 / 2) and ring["Iy"] == pytest.approx(
        np.pi * (0.05**4 - 0.03**4) / 4
    )
    assert of_shape("BOX", [0.01, 0.01, 0.006, 0.006]) is None and of_shape("ROD", [0.0]) is None
