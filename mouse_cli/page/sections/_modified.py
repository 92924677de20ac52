"""Modified structures: mark, first sentence, figures and tables."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.sections._functions import PEAKS, overlaid
from mouse_cli.page.sections._words import shares
from mouse_cli.page.tables import Listing, columns_of
from mouse_cli.report.reading import Part

_UNITS = {"mass": " kg", "spring": " N/m"}
_MODES = columns_of(
    "mode: mode name | was mode: from_mode name | frequency, Hz: hz | sd: sd_hz 3 | shift, Hz: shift_hz 4 | "
    "sd of shift: shift_sd_hz 2 | MAC: mac 4"
)
_TARGETS = columns_of(
    "mode: mode name | side: side text | Hz: hz | at: place text | by: by text | needed: value 4 | sd: sd 2 | "
    "with confidence: sure 4 | reached, Hz: reached_hz | limit, Hz: limit_hz | remark: reason text"
)
_LOCATIONS = columns_of(
    "at: place text | frequency, Hz: hz | mass ratio: mass_ratio 3 | tuned to, Hz: tuned_hz | damping ratio: damping_ratio 3 | "
    "peak by static: peak 3"
)
_CHANGES = columns_of(
    "change: name text | kind: kind text | at: at text | to: to text | mass, kg: mass | stiffness, N/m: stiffness | "
    "damping, N s/m: damping"
)
_DAMPED = columns_of("frequency, Hz: hz | damping ratio: damping share | sd: damping_sd share")


def mark(document: Part) -> tuple[str, str]:
    """Whether each target is met somewhere."""
    met: dict[tuple, bool] = {}
    for need in document.parts("targets"):
        target = need.label("mode"), need.text("side"), need.label("hz"), need.text("by")
        met[target] = met.get(target, False) or need.number("value") is not None
    return ("good", "✓ Modified structure") if all(met.values()) else ("doubt", "! A target cannot be met")


def sentence(document: Part) -> str:
    """What is changed, and the mode that it moves most; what a target asks for, where least is needed."""
    changes = ", ".join(f"{change.text('kind')} at {change.label('at')}" for change in document.parts("changes"))
    moved = [m for m in document.parts("modes") if m.number("shift_hz")]
    texts = []
    if changes and moved:
        most = max(moved, key=lambda m: abs(m.number("shift_hz") or 0.0) / (m.number("hz") or 1.0))
        by = f"{shown(most.number('shift_hz'), 3)} Hz (sd {shown(most.number('shift_sd_hz'), 2)})"
        to = shown(most.number("hz"), 4)
        texts.append(f"With {changes}, mode {most.label('from_mode')} moves most: by {by} to {to} Hz.")
    needs = [n for n in document.parts("targets") if n.number("value") is not None]
    if needs:
        least = min(needs, key=lambda n: abs(n.number("value") or 0.0))
        target = f"mode {least.label('mode')} {least.text('side')} {shown(least.number('hz'), 4)} Hz"
        size = (
            f"{shown(least.number('value'), 4)}{_UNITS.get(least.text('by'), '')} (sd {shown(least.number('sd'), 2)})"
        )
        texts.append(f"For {target}: {least.text('by')} {size} at {least.text('place')}.")
    return " ".join(texts) or f"{len(document.parts('modes'))} modes after the changes."


def figures(document: Part) -> Iterator[Markup]:
    """Shifts of the modes, and FRFs before and after."""
    shifts = [(f"mode {m.label('mode')}", m.number("shift_hz")) for m in document.parts("modes")]
    rows = [(name, f"{shown(x, 3)} Hz", x) for name, x in shifts if x]
    yield shares("shifts", "Shift of natural frequencies", "After less before, in Hz.", rows)
    found = document.part("functions")
    yield from overlaid(
        "modified", [("before", "prior", found.part("before")), ("after", "revised", found.part("after"))]
    )


def tables(document: Part) -> Iterator[Listing]:
    """Modes, targets, best locations, changes, damping, peaks."""
    yield Listing("modified-modes", "Modes after the changes", _MODES, document.parts("modes"))
    yield Listing("targets", "What targets ask for, by location", _TARGETS, document.parts("targets"))
    for number, sweep in enumerate(document.parts("sweeps"), 1):
        title = f"Best locations: {sweep.text('by')} {shown(sweep.number('size'), 4)}, mode {sweep.label('mode')}"
        yield Listing(f"locations-{number}", title, _LOCATIONS, sweep.parts("places"))
    yield Listing("changes", "Changes", _CHANGES, document.parts("changes"))
    yield Listing("damped", "Damped modes", _DAMPED, document.parts("damped"))
    yield Listing("modified-peaks", "Peaks of the FRFs after", PEAKS, document.part("functions").parts("peaks"))
