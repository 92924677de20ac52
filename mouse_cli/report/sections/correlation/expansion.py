"""The measured shapes on all degrees of freedom, and the checks that modes of the model would pass."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import Correlation
from mouse_cli.report.blocks import Block, Column, Matrix, Table, Text
from mouse_cli.report.section import Options, Section


def expansion(found: Correlation, options: Options) -> Iterator[Block]:
    """Method, frequencies, X'MX, X'KX, and the shapes of a model that fits a few pages."""
    expanded, test = found.expanded, found.problem.test
    if expanded is None:
        return
    trust = "kept as measured" if expanded.exact else "trusted as far as their standard deviations allow"
    yield Text(f"Method: {expanded.title}; measured components are {trust}. Expanded shapes have unit modal mass.")
    columns = (
        Column("test mode"),
        Column("test frequency", "Hz"),
        Column("Rayleigh quotient", "Hz"),
        Column("misfit at the sensors", "test sd"),
    )
    rows = zip(
        test.number[expanded.modes], test.frequency_hz[expanded.modes], expanded.hz, expanded.misfit, strict=True
    )
    yield Table(columns, tuple((int(n), float(f), float(hz), float(misfit)) for n, f, hz, misfit in rows))
    names = tuple(str(n) for n in test.number[expanded.modes])
    yield Matrix("X' M X", np.round(expanded.mass, 4), names, names, corner=("test", "test"))
    yield Matrix(
        "X' K X over the measured eigenvalues", np.round(expanded.stiffness, 4), names, names, corner=("test", "test")
    )
    yield Text("Both would be unit matrices for the modes of a true model, measured without error.")
    if found.problem.structure.n <= options.shape_dofs:
        yield Matrix(
            "expanded shapes", expanded.shapes, found.problem.structure.labels, names, corner=("position", "test")
        )
    else:
        yield Text("The shapes are in the JSON document.")


SECTION = Section("correlation-expansion", 60, "Expanded mode shapes", expansion, (Correlation,))
