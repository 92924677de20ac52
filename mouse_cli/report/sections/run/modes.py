"""Eigenvalues, natural frequencies and mode shapes of the revised model."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz, sd_frequency_hz
from mouse_cli.model.result import Result
from mouse_cli.report.blocks import Block, Column, Matrix, Table, Text
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import counted


def modes(result: Result, options: Options) -> Iterator[Block]:
    """Eigenvalues before and after; then the modal matrix."""
    known, n = len(result.revised.eigenvalues), result.problem.structure.n
    paired = int(result.revised.modes.max(initial=0)) + 1
    count = known if known <= options.shape_dofs else max(2 * options.modes, paired)
    yield _eigenvalues(result, min(count, len(result.prior.eigenvalues)))
    if count < n:
        yield Text(f"Of {n} modes the lowest {count} are shown.")
    rigid = counted(result.rigid_modes, "rigid-body mode") if result.rigid_modes else "no rigid-body mode"
    yield Text(f"The model has {rigid}.")
    yield from _modal_matrix(result, min(known, max(options.modes, paired)), options)


def _eigenvalues(result: Result, count: int) -> Table:
    columns = (
        Column("mode"),
        Column("prior eigenvalue", "rad2/s2"),
        Column("revised eigenvalue", "rad2/s2"),
        Column("prior frequency", "Hz"),
        Column("revised frequency", "Hz"),
        Column("sd of revised frequency", "Hz"),
    )
    prior, revised = result.prior.eigenvalues[:count], result.revised.eigenvalues[:count]
    hz = _hz(revised, result.rigid_modes)
    values = (prior, revised, _hz(prior, result.rigid_modes), hz, _sd_hz(result, hz))
    rows = tuple((i, *map(float, row)) for i, row in enumerate(zip(*values, strict=True), 1))
    return Table(columns, rows).without_empty_columns()


def _sd_hz(result: Result, hz: np.ndarray) -> np.ndarray:
    """Standard deviations (count,) of `hz` for the modes whose frequency was measured; NaN for others and without an answer."""
    sd, index = np.full(len(hz), np.nan), eigenvalue_index(result)
    known = (index != NOT_MEASURED) & (result.revised.modes < len(hz)) & result.status.answered
    modes = result.revised.modes[known]
    sd[modes] = sd_frequency_hz(hz[modes], result.revised.sd_predicted[index[known]])
    return sd


def _hz(eigenvalues: np.ndarray, rigid: int) -> np.ndarray:
    """Natural frequencies of `eigenvalues`; zero for the `rigid` lowest."""
    hz = frequency_hz(eigenvalues)
    hz[:rigid] = 0.0
    return hz


def _modal_matrix(result: Result, count: int, options: Options) -> Iterator[Block]:
    """Shapes of the lowest `count` modes, at every degree of freedom of a model that fits a few pages."""
    n, labels = result.problem.structure.n, result.problem.structure.labels
    dofs = np.arange(n)
    if n > options.shape_dofs:
        dofs = result.problem.test.dofs
        yield Text(f"The model has {n} degrees of freedom; its shapes are shown at the measured positions.")
    if not len(dofs):
        return
    yield Matrix(
        "modal matrix of the revised model, unit modal mass",
        _signed(result)[np.ix_(dofs, np.arange(count))],
        tuple(labels[d] for d in dofs),
        tuple(str(i + 1) for i in range(count)),
        corner=("position", "mode"),
    )


def _signed(result: Result) -> np.ndarray:
    """Shapes (n, k), a measured mode with the sign of its test, others with their largest component positive."""
    shapes, revised = result.revised.shapes, result.revised
    size = np.abs(shapes)
    largest = np.argmax(size > (1 - 1e-6) * size.max(axis=0), axis=0)
    sign = np.sign(shapes[largest, np.arange(shapes.shape[1])])
    at_test = np.einsum("ij,ij->j", revised.model_shapes, result.problem.test.read(shapes[:, revised.modes]))
    sign[revised.modes[at_test != 0]] = np.sign(at_test[at_test != 0])
    return shapes * sign


SECTION = Section("modes", 80, "Eigenvalues and eigenvectors", modes, place=APPENDIX)
