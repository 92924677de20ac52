"""What the report says of a modal identification."""

from collections.abc import Iterator

import numpy as np

from mouse_cli import __version__
from mouse_cli.model.identification import Identification
from mouse_cli.report.blocks import Block, Lines, Matrix, Table, Text, heads
from mouse_cli.report.section import RESULT, VERDICT, Options, Section
from mouse_cli.report.sections._wording import counted, worded


def verdict(found: Identification, options: Options) -> Iterator[Block]:
    """The identification in one sentence. How many modes, and whether anything speaks against them."""
    sensors = counted(len(found.sensors), "sensor")
    if found.exit_code == 0:
        yield Text(f"{counted(found.modes.m, 'mode')} at {sensors}; no warnings.")
    elif found.modes.m:
        yield Text(
            f"{counted(found.modes.m, 'mode')} at {sensors}, with warnings: see the remarks before they are used."
        )
    else:
        yield Text("No mode was identified: see the remarks.")


_COLUMNS = heads(
    "mode | frequency [Hz] | sd [Hz] | damping [per cent] | sd [per cent] | MPC | stable in [orders] | "
    "lines in bandwidth | error of fit [per cent] | <scale"
)


def modes(found: Identification, options: Options) -> Iterator[Block]:
    """The table of identified modes. One line a mode."""
    each = found.modes
    if not each.m:
        return
    lines = [count if known else None for count, known in zip(each.lines, np.isfinite(each.error), strict=True)]
    damping = 100 * each.damping, 100 * each.damping_sd
    columns = (each.frequency_hz, each.frequency_sd_hz, *damping, each.mpc, each.stable_orders, lines, 100 * each.error)
    rows = zip(range(1, each.m + 1), *columns, each.scale, strict=True)
    yield Table(_COLUMNS, rows).without_empty_columns()
    yield Text(
        "Frequency is |lambda| / 2 pi, damping -Re lambda / |lambda|. MPC, modal phase collinearity, is 1 for a real shape. "
        "The error of fit is that near the resonance, by what was measured there."
    )


def remarks(found: Identification, options: Options) -> Iterator[Block]:
    """What speaks against identified modes, and what else to know of them. One paragraph a remark, doubts first."""
    yield from worded((*found.doubts, *found.remarks), options)


def heading(found: Identification, options: Options) -> Iterator[Block]:
    """Heading of an identification: what was identified, how, and where its noise comes from."""
    rows = [
        ("program", f"mouse {__version__}"),
        ("title", found.title),
        *[("source", source) for source in found.sources],
        ("method", found.method),
        ("band", f"{found.band_hz[0]:.6g} to {found.band_hz[1]:.6g} Hz"),
        ("noise", found.noise),
        *[(name, value if isinstance(value, str) else f"{value:.6g}") for name, value in found.details.items()],
    ]
    yield Table(heads("< | <"), rows)


def shapes(found: Identification, options: Options) -> Iterator[Block]:
    """Identified mode shapes with their standard deviations. Real parts, their sd, and imaginary parts, one row a sensor."""
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


_WIDTH, _ROWS = 100, 20


def diagram(found: Identification, options: Options) -> Iterator[Block]:
    """Orders upwards, frequency to the right: o a stable pole, . another one, ^ an identified mode."""
    seen, (low, high) = found.diagram, found.band_hz
    if not len(seen.order) or not high > low:
        return
    column = lambda hz: np.clip(((hz - low) / (high - low) * (_WIDTH - 1)).round().astype(int), 0, _WIDTH - 1)
    inside = (seen.frequency_hz >= low) & (seen.frequency_hz <= high)
    orders = np.unique(seen.order)
    shown = orders[:: max(1, int(np.ceil(len(orders) / _ROWS)))][::-1]
    lines = []
    for order in shown:
        row = np.full(_WIDTH, " ")
        for stable, letter in ((False, "."), (True, "o")):
            row[column(seen.frequency_hz[inside & (seen.order == order) & (seen.stable == stable)])] = letter
        lines.append(f"{order:5d} |{''.join(row)}")
    marks = np.full(_WIDTH, " ")
    marks[column(found.modes.frequency_hz)] = "^"
    lines += [
        f"      +{'-' * _WIDTH}",
        f"       {''.join(marks)}",
        f"       {f'{low:.6g}':<{_WIDTH // 2}}{f'{high:.6g} Hz':>{_WIDTH // 2}}",
    ]
    yield Lines(tuple(lines))
    yield Text(
        "Orders upwards, frequencies to the right: o is a pole that is stable, . one that is not, ^ an identified mode."
    )


_MOST = 30


def rejected(found: Identification, options: Options) -> Iterator[Block]:
    """Poles that are no modes of the answer, and why. One line a candidate."""
    if not found.rejected:
        return
    columns = heads("frequency [Hz] | damping [per cent] | <why it was rejected")
    judged = [each for each in found.rejected if not each.reason.startswith("stable in")]
    brief = [each for each in found.rejected if each.reason.startswith("stable in")]
    shown = sorted([*judged, *brief][:_MOST], key=lambda each: each.frequency_hz)
    yield Table(columns, tuple((each.frequency_hz, 100 * each.damping, each.reason) for each in shown))
    if len(found.rejected) > _MOST:
        yield Text(f"{len(found.rejected) - _MOST} more poles were stable in a few orders only.")


SECTIONS = (
    Section("identification-verdict", 10, "Modal identification", verdict, (Identification,), place=VERDICT),
    Section("identification-modes", 20, "Modes", modes, (Identification,), place=RESULT),
    Section("identification-remarks", 60, "Remarks", remarks, (Identification,), place=RESULT),
    Section("identification-heading", 10, "Source and method", heading, (Identification,)),
    Section("identification-shapes", 30, "Mode shapes", shapes, (Identification,)),
    Section("identification-diagram", 40, "Stabilisation diagram", diagram, (Identification,)),
    Section("identification-rejected", 50, "Rejected", rejected, (Identification,)),
)
