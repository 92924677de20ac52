"""Is it true: frequencies that no fit has seen, predicted by the model as it is and by the extended one."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import apart, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import differences, paragraphs
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HEADS = ("frequency", "measured, Hz", "as it is, Hz", "sd", "off", "extended, Hz", "sd", "off")
_MODELS = (("baseline", "the model as it is"), ("revised", "the extended model"))


def held_out(document: Part) -> Iterator[Markup]:
    """Scores in words, bars, and the predictions one by one."""
    held = document.part("held_out")
    labels, measured = held.labels("labels"), held.numbers("measured_hz")
    if not labels or len(labels) != len(measured):
        return
    yield paragraphs(
        f"Held out: {held.text('kind') or 'whole configurations'}.",
        *(_score(name, held.part(key)) for key, name in _MODELS),
    )
    columns = [_padded(held.part(key).numbers(what), len(labels)) for key, _ in _MODELS for what in ("hz", "sd_hz")]
    if held.part("revised"):
        rows = list(zip(labels, measured, columns[0], columns[2], strict=True))
        yield differences("off-held-out", "Frequency error of held-out data", rows)
    body = [_row(label, *values) for label, *values in zip(labels, measured, *columns, strict=True)]
    yield table("held-out-frequencies", "Frequencies held out, and as they were predicted", _HEADS, body)


def _score(name: str, score: Part) -> str:
    error, covered = score.number("rms_frequency_error"), score.number("covered")
    if error is None or covered is None:
        return ""
    within = f"{100 * covered:.0f} % lie within its 90 % intervals"
    return f"Frequency error of {name}: {100 * error:.2g} % (rms); {within}."


def _padded(values: list[float | None], count: int) -> list[float | None]:
    return (values + [None] * count)[:count]


def _row(label: str, measured, hz, sd, revised, revised_sd) -> tuple[object, ...]:
    off, after = apart(hz, measured), apart(revised, measured)
    return (
        label,
        measured,
        hz,
        Cell(sd, shown(sd, 3)),
        Cell(off, signed_per_cent(off)),
        revised,
        Cell(revised_sd, shown(revised_sd, 3)),
        Cell(after, signed_per_cent(after)),
    )


SECTION = PageSection("held-out", 35, "Validation", held_out)
