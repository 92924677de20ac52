"""Identified mode shapes with their standard deviations."""

from collections.abc import Iterator

from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Matrix
from mouse_cli.report.section import Options, Section


def shapes(found: Identification, options: Options) -> Iterator[Block]:
    """Real parts, their sd, and imaginary parts, one row a sensor."""
    modes = found.modes
    if not modes.m or len(found.sensors) > options.shape_dofs:
        return
    columns = tuple(str(r + 1) for r in range(modes.m))
    for name, array in (
        ("Mode shapes, real parts", modes.shapes.real),
        ("Standard deviations of the real parts", modes.shape_sd),
        ("Imaginary parts", modes.shapes.imag),
    ):
        yield Matrix(name, array.copy(), found.sensors, columns, corner=("sensor", "mode"))


SECTION = Section("identification-shapes", 30, "Mode shapes", shapes, (Identification,))
