"""Physics without a name along the structure, and candidates that were left out, as sections of every diagnosis print them."""

from collections.abc import Iterator, Sequence
from math import inf

from mouse_cli.model.diagnosis import LAW, Field, Untried
from mouse_cli.model.units import Units
from mouse_cli.report.blocks import Block, Column, Table, Text, heads
from mouse_cli.report.field_words import UNITS, factor, one_spring, significant
from mouse_cli.report.sections._diagnosis_wording import place
from mouse_cli.report.sections._wording import counted

_MOST = 40  # rows
_NAMES = {
    "stiffness": "change of stiffness",
    "mass": "change of mass",
    "bed": "bed stiffness",
    "axial": "axial force",
    "force": "motion",
    "compliance": "motion",
    "law": "stiffness",
}


def field_blocks(field: Field | None, units: Units) -> Iterator[Block]:
    """The table of values, then how smooth the field is; nothing without one."""
    if field is None:
        return
    yield field_table(field)
    few, count = len(_shown(field)), len(field.values)
    sentences = (
        [f"{counted(count - few, 'site')} with negligible values (below two sd) left out."] if few < count else []
    )
    unit = units.of("m") if field.unit == "m" else field.unit
    spread = f"{factor(field) * field.spread:.2g} {UNITS[field.property]}"
    along = "from mode to mode" if field.property == LAW else "along the structure"
    over = f" and are correlated over {field.length:.2g} {unit}" if 0 < field.length < inf else ""
    straight = ", along a straight line" if field.length == inf else ""
    if not one_spring(field):
        sentences.append(f"The values scatter {along} with sd {spread}{over}{straight}.")
    yield Text(" ".join(sentences))
    yield from field_blocks(field.beside, units)


def field_table(field: Field) -> Table:
    """Values that differ from none by more than two sd, in their order along the structure."""
    unit, by = UNITS[field.property], factor(field)
    columns = heads("<site", Column(_NAMES[field.property], unit), f"sd [{unit}]")
    rows = [(place(each.site), f"{by * each.value:.3g}", f"{by * each.sd:.2g}") for each in _shown(field)]
    return Table(columns, rows)


def _shown(field: Field) -> list:
    """At most _MOST of the telling values, the largest of them, in their order."""
    found = significant(field)
    least = sorted((abs(each.value) for each in found), reverse=True)[:_MOST][-1:]
    return [each for each in found if abs(each.value) >= least[0]][:_MOST] if found else []


def untried_text(untried: Sequence[Untried]) -> Iterator[Text]:
    """Candidates left out, folded by their reason; nothing without any."""
    reasons: dict[str, list[str]] = {}
    for each in untried:
        reasons.setdefault(each.reason, []).append(each.physics)
    if reasons:
        listed = "; ".join(f"{', '.join(names)} ({reason})" for reason, names in reasons.items())
        yield Text(f"Not tried, {counted(len(untried), 'candidate')}: {listed}.")
