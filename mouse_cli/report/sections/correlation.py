"""What the report says of a comparison of test and model."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.correlation import ALONE, Correlation, Orthogonality
from mouse_cli.report.blocks import Block, Cell, Column, Heading, Matrix, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import LEFT, counted, deck_table, worded


def verdict(found: Correlation, options: Options) -> Iterator[Block]:
    """Partners, frequency errors, MAC, and whether there are remarks."""
    test, paired = found.problem.test, np.flatnonzero(found.modes != ALONE)
    yield Text(f"{len(paired)} of {test.m} measured modes have a partner in the model.{_errors(found, paired)}")
    count = len(found.warnings)
    yield Text(f"{count} remarks below." if count > 1 else "One remark below." if count else "No remark.")


def _errors(found: Correlation, paired: np.ndarray) -> str:
    """Over the pairs; what was not measured is left out."""
    test, text = found.problem.test, ""
    off = 100 * (found.frequencies_hz[found.modes[paired]] / test.frequency_hz[paired] - 1)
    if np.isfinite(off).any():
        worst = int(np.nanargmax(np.abs(off)))
        text = (
            f" Frequency errors of the model: rms {np.sqrt(np.nanmean(off**2)):.3g} %, largest {off[worst]:+.3g} % "
            f"(mode {test.number[paired[worst]]})."
        )
    alike = found.mac[paired, found.modes[paired]]
    if np.isfinite(alike).any():
        text += f" MAC of the pairs: {np.nanmin(alike):.3f} to {np.nanmax(alike):.3f}."
    return text


_COLUMNS = heads(
    "test mode | model mode | test frequency [Hz] | model frequency [Hz] | difference [per cent] | "
    "difference [test sd] | MAC | modal scale factor | seen by the sensors"
)


def frequencies(found: Correlation, options: Options) -> Iterator[Block]:
    """One line a measured mode, then one for each model mode in the band that none of them is."""
    rows = [_measured(found, i) for i in range(found.problem.test.m)]
    rows += [
        (None, int(j) + 1, None, found.frequencies_hz[j], None, None, None, None, found.visible[j])
        for j in found.unclaimed
    ]
    yield Table(_COLUMNS, rows).without_empty_columns()
    yield Text(
        "Differences are model minus test. The modal scale factor brings the measured shape nearest to that of unit modal "
        "mass; seen by the sensors is the length of the model shape at the sensors, over that of the largest."
    )


def _measured(found: Correlation, i: int) -> tuple[Cell, ...]:
    test, j = found.problem.test, found.modes[i]
    test_hz, sd = test.frequency_hz[i], test.frequency_sd_hz[i]
    if j == ALONE:
        return test.number[i], None, test_hz, None, None, None, None, None, None
    hz = float(found.frequencies_hz[j])
    with np.errstate(invalid="ignore"):
        away = 100 * (hz / test_hz - 1), (hz - test_hz) / sd
    likeness, factor = found.mac[i, j], found.scale_factor[i]
    return test.number[i], j + 1, test_hz, hz, *away, likeness, factor, found.visible[j]


def remarks(found: Correlation, options: Options) -> Iterator[Block]:
    """What a test engineer should look at before the model is revised. One paragraph a remark."""
    yield from worded((*found.warnings, *found.problem.warnings), options)


def heading(found: Correlation, options: Options) -> Iterator[Block]:
    """Heading of a comparison: program, deck, what is compared. What stands on either side."""
    problem = found.problem
    yield deck_table(problem)
    rigid = f", {found.rigid_modes} of them of a rigid body" if found.rigid_modes else ""
    yield Text(
        f"{counted(problem.test.m, 'measured mode')} at {counted(problem.test.s, 'sensor')} against the lowest "
        f"{counted(len(found.frequencies_hz), 'mode')}{rigid} of the model of "
        f"{counted(problem.structure.n, 'degree', 'degrees')} of freedom before any revision. "
        f"Modes are paired by shape and frequency; {int((found.modes != ALONE).sum())} of {problem.test.m} have a partner."
    )


def assurance(found: Correlation, options: Options) -> Iterator[Block]:
    """MAC matrix, auto-MACs, and close modes as subspaces."""
    if not np.isfinite(found.mac).any():
        return
    test = tuple(str(n) for n in found.problem.test.number)
    model = tuple(str(j + 1) for j in range(len(found.frequencies_hz)))
    yield Matrix("MAC, test by model", _rounded(found.mac), test, model, corner=("test", "model"))
    yield Matrix("auto-MAC of the test", _rounded(found.auto_test), test, test, corner=("test", "test"))
    yield Matrix(
        "auto-MAC of the model at the sensors", _rounded(found.auto_model), model, model, corner=("model", "model")
    )
    yield Text("Off the diagonal an auto-MAC near 1 means that the sensors cannot distinguish two modes.")
    if found.subspaces:
        yield _close(found)
        yield Text(
            "Close modes mix easily, in a structure and in its model, so that single shapes mean little; their span means much. "
            "The squared cosines of the principal angles are 1 where both have the same directions; blank: too few sensors."
        )


def _close(found: Correlation) -> Table:
    columns = heads("<close test modes | <close model modes | <squared cosines")
    rows = []
    for close in found.subspaces:
        ours = ", ".join(str(found.problem.test.number[i]) for i in close.test)
        theirs = ", ".join(str(j + 1) for j in close.model)
        rows.append((ours, theirs, ", ".join(f"{c:.3f}" for c in close.cosines if np.isfinite(c))))
    return Table(columns, rows)


def _rounded(matrix: np.ndarray) -> np.ndarray:
    """To three decimals: more is noise, and hides the pattern."""
    return np.round(np.asarray(matrix, dtype=float), 3)


def sensors(found: Correlation, options: Options) -> Iterator[Block]:
    """How well each sensor fits over all pairs of modes. COMAC and ECOMAC, one line a sensor."""
    if not np.isfinite(found.comac).any():
        return
    columns = heads(Column("sensor", align=LEFT, literal=True), "COMAC | ECOMAC")
    rows = zip(found.sensors, np.round(found.comac, 4), np.round(found.ecomac, 4), strict=True)
    yield Table(columns, rows)
    yield Text(
        "COMAC is 1, ECOMAC 0 where a sensor agrees with the model in all paired modes. COMAC is blind to signs, ECOMAC sees "
        "them. An error of the model is spread over many sensors; the fault of one stands alone and is named under the remarks."
    )


def orthogonality(found: Correlation, options: Options) -> Iterator[Block]:
    """For each mass matrix: measured with measured, measured with model, and what the figures can be trusted for."""
    test = tuple(str(n) for n in found.problem.test.number)
    model = tuple(str(j + 1) for j in range(len(found.frequencies_hz)))
    for judged in found.orthogonality:
        if not np.isfinite(judged.test).any():
            continue
        yield Heading(judged.title, 2)
        yield Matrix("pseudo-orthogonality of the test", np.round(judged.test, 3), test, test, corner=("test", "test"))
        yield Matrix("cross-orthogonality", np.round(judged.cross, 3), test, model, corner=("test", "model"))
        yield _trust(judged)


def _trust(judged: Orthogonality) -> Text:
    """What noise alone makes of the off-diagonals, and how far this mass matrix stands for the model."""
    off = ~np.eye(len(judged.test), dtype=bool) & np.isfinite(judged.test)
    beyond = _largest(judged.model, ~np.eye(len(judged.model), dtype=bool))
    own = "This mass matrix leaves the model's own shapes with products up to {}."
    if not off.any():
        return Text(own, (beyond,))
    largest, noise = _largest(judged.test, off), 2 * _largest(judged.sd, off)
    outside = int(np.sum(np.abs(judged.test[off]) > 2 * judged.sd[off])) // 2
    return Text(
        "Off the diagonal the largest product of measured shapes is {}; the stated accuracies alone make up to {} (two standard "
        f"deviations), and {outside} of {int(off.sum()) // 2} products lie beyond their own two. {own}",
        (largest, noise, beyond),
    )


def _largest(matrix: np.ndarray, where: np.ndarray) -> float:
    return float(np.round(np.nanmax(np.abs(matrix[where]), initial=0.0), 4))


def expansion(found: Correlation, options: Options) -> Iterator[Block]:
    """Method, frequencies, X'MX, X'KX, and the shapes of a model that fits a few pages."""
    expanded, test = found.expanded, found.problem.test
    if expanded is None:
        return
    trust = "kept as measured" if expanded.exact else "trusted as far as their standard deviations allow"
    yield Text(f"Method: {expanded.title}; measured components are {trust}. Expanded shapes have unit modal mass.")
    columns = heads("test mode | test frequency [Hz] | Rayleigh quotient [Hz] | misfit at the sensors [test sd]")
    rows = zip(
        test.number[expanded.modes], test.frequency_hz[expanded.modes], expanded.hz, expanded.misfit, strict=True
    )
    yield Table(columns, rows)
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


SECTIONS = (
    Section("correlation-verdict", 10, "Correlation of test and model", verdict, (Correlation,), place=VERDICT),
    Section("correlation-frequencies", 20, "Pairs of modes", frequencies, (Correlation,), place=RESULT),
    Section("correlation-remarks", 70, "Remarks", remarks, (Correlation,), place=RESULT),
    Section("correlation-heading", 10, "Deck", heading, (Correlation,)),
    Section("correlation-mac", 30, "Modal assurance criterion", assurance, (Correlation,)),
    Section("correlation-sensors", 40, "Sensors", sensors, (Correlation,)),
    Section("correlation-orthogonality", 50, "Orthogonality", orthogonality, (Correlation,)),
    Section("correlation-expansion", 60, "Expanded mode shapes", expansion, (Correlation,)),
)
