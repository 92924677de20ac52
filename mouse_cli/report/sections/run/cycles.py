"""The cycles, the modes of the revised model and each datum beside it."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.dynamics.frequency import frequency_hz, sd_frequency_hz
from mouse_cli.model.result import Cycle, Result
from mouse_cli.report.blocks import Block, Cell, Column, Matrix, Table, Text, heads
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index, positions, shape_index
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted


def cycles(result: Result, options: Options) -> Iterator[Block]:
    """One line a cycle; cost and damping where the recursion has them."""
    parameters = result.problem.parameters
    short = len(parameters) > options.cycle_properties
    shown = parameters[: options.cycle_properties]
    columns = heads(
        "cycle",
        *(Column(p.name, p.unit, literal=True) for p in shown),
        *((Column("largest change", "prior sd"), Column("of property", align=LEFT)) if short else ()),
        "chi-square of data | exceedances | allowed | cost | damping",
    )
    searched = result.problem.run.recursion == "anchored"
    rows = []
    for before, cycle in zip((None, *result.cycles), result.cycles, strict=False):
        largest = _largest_change(result, before, cycle) if short else ()
        ended = (cycle.cost, cycle.damping) if searched else (None, None)
        rows.append(
            (cycle.index, *cycle.theta[: len(shown)], *largest, cycle.chi2, cycle.exceedances, cycle.allowed, *ended)
        )
    yield Table(columns, rows).without_empty_columns()
    yield Text(_explained(len(result.y), searched, short, len(shown)))


def _explained(data: int, searched: bool, short: bool, shown: int) -> str:
    """What the columns are."""
    text = f"Cycle 0 is the prior model. Chi-square is the sum over {data} data of ((test - model) / standard deviation) squared."
    if searched:
        text += (
            " The cost, which each cycle lowers, adds the squared distance of the properties from their prior values."
        )
    if short:
        text += f" Of the properties the first {shown} are shown."
    return text


def _largest_change(result: Result, before: Cycle | None, cycle: Cycle) -> tuple[Cell, Cell]:
    """The largest change of a property since the cycle before, in prior standard deviations, and whose it is."""
    if before is None:
        return None, None
    sd = result.problem.prior.sd
    moved = np.divide(cycle.theta - before.theta, sd, out=np.zeros_like(sd), where=sd > 0)
    largest = int(np.argmax(np.abs(moved)))
    return moved[largest], result.problem.parameters[largest].name


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
    columns = heads(
        "mode | prior eigenvalue [rad2/s2] | revised eigenvalue [rad2/s2] | prior frequency [Hz] | "
        "revised frequency [Hz] | sd of revised frequency [Hz]"
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


def comparison(result: Result, options: Options) -> Iterator[Block]:
    """Test against revised model, in the layout of Table 5-5: eigenvalues, then eigenvectors, with the data beyond their limits."""
    if result.problem.test.m:
        yield _compared_eigenvalues(result)
    if (shape_index(result) != NOT_MEASURED).any():
        yield _eigenvectors(result)
    count = int(result.exceeding.sum())
    outside = f"{count} lie outside, marked *" if count else "none lies outside"
    if count == 1:
        outside = "1 lies outside and is marked *"
    yield Text(
        f"The interval is the half width of the {result.problem.run.confidence} per cent confidence interval of the test, "
        f"{result.z:.3f} standard deviations. Of {counted(len(result.y), 'datum', 'data')} {outside}; "
        f"the convergence test allows {result.allowed or 'none'}."
    )


_COLUMNS = heads(
    "mode | model mode | revised eigenvalues [rad2/s2] | test eigenvalues [rad2/s2] | "
    "revised frequency [Hz] | test frequency [Hz] | test sd [Hz] | interval [Hz] | difference [Hz] | "
    "prior MAC | revised MAC | *"
)


def _compared_eigenvalues(result: Result) -> Table:
    """One line a mode; the model's own number is shown where it differs from the test's."""
    index = eigenvalue_index(result)
    renumbered = bool((result.problem.test.number != result.revised.modes + 1).any())
    rows = tuple(_mode(result, i, int(k), renumbered) for i, k in enumerate(index))
    return Table(_COLUMNS, rows).without_empty_columns()


def _mode(result: Result, i: int, k: int, renumbered: bool) -> tuple[Cell, ...]:
    """Line of measured mode i, whose eigenvalue is datum k."""
    test, mode, measured = result.problem.test, result.revised.modes[i], k != NOT_MEASURED
    revised = float(result.revised.eigenvalues[mode])
    hz, test_hz, sd = frequency_hz(revised), test.frequency_hz[i], test.frequency_sd_hz[i]
    frequency = (test_hz, sd, result.z * sd, test_hz - hz) if measured else (np.nan,) * 4
    return (
        test.number[i],
        mode + 1 if renumbered else None,
        revised,
        result.y[k] if measured else None,
        hz,
        *map(float, frequency),
        result.prior.mac[i],
        result.revised.mac[i],
        "*" if measured and result.exceeding[k] else None,
    )


def _eigenvectors(result: Result) -> Table:
    """Mode by mode, position by position; test vectors at the scale of the theory."""
    columns = heads("position | mode | revised eigenvectors | test eigenvectors | interval | difference | *")
    places, numbers = positions(result), result.problem.test.number
    model, test, interval = result.revised.model_shapes, result.test_shapes, result.z * result.test_shape_sd
    values = (model, test, interval, test - model)
    rows = tuple(
        (places[s], numbers[i], *(each[s, i] for each in values), "*" if result.exceeding[k] else None)
        for i, column in enumerate(shape_index(result).T)
        for s, k in enumerate(column)
        if k != NOT_MEASURED
    )
    return Table(columns, rows, keys=2).without_empty_columns()


SECTIONS = (
    Section("cycles", 50, "Cycles", cycles, place=APPENDIX),
    Section("modes", 80, "Eigenvalues and eigenvectors", modes, place=APPENDIX),
    Section("comparison", 90, "Comparison of eigenvalues and eigenvectors", comparison, place=APPENDIX),
)
