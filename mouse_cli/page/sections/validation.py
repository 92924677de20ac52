"""Held-out data, and what to measure next."""

from collections.abc import Iterator

from mouse_cli.page.charts import Bar, bars
from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import apart, padded, shown, signed_per_cent
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import differences, paragraphs
from mouse_cli.page.tables import Cell, table
from mouse_cli.report.reading import Part

_HELD_OUT_HEADS = ("frequency", "measured, Hz", "as it is, Hz", "sd", "off", "extended, Hz", "sd", "off")
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
    columns = [padded(held.part(key).numbers(what), len(labels)) for key, _ in _MODELS for what in ("hz", "sd_hz")]
    if held.part("revised"):
        rows = list(zip(labels, measured, columns[0], columns[2], strict=True))
        yield differences("off-held-out", "Frequency error of held-out data", rows)
    body = [_row(label, *values) for label, *values in zip(labels, measured, *columns, strict=True)]
    yield table("held-out-frequencies", "Frequencies held out, and as they were predicted", _HELD_OUT_HEADS, body)


def _score(name: str, score: Part) -> str:
    error, covered = score.number("rms_frequency_error"), score.number("covered")
    if error is None or covered is None:
        return ""
    within = f"{100 * covered:.0f} % lie within its 90 % intervals"
    return f"Frequency error of {name}: {100 * error:.2g} % (rms); {within}."


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


_AS_IT_IS, _AFTER = "as it is", "with the cause"  # keys of documents
_MOST = 40  # lines of the figure
_RECORDS_HEADS = (
    "record",
    "output",
    "rms measured",
    "short horizons, before",
    "after",
    "whole record, before",
    "after",
)


def records(document: Part) -> Iterator[Markup]:
    """Bars of errors over the rms of the record, all errors, and the figures."""
    held, names = document.part("held_out"), document.part("recordings").labels("outputs")
    rows = [row for each in held.parts("records") for row in _rows(each, names)]
    drawn = [_bar(row) for row in rows if row[2]][:_MOST]
    listed = "; ".join(f"{bar.label}: {bar.words}" for bar in drawn)
    description = f"rms of measured less simulated over short horizons, by the rms of the record. {listed}."
    yield bars("off-records", "What is missed of records held out", description, drawn, ("before", "after"))
    yield table("held-out-records", "Errors of records held out, rms", _RECORDS_HEADS, rows)
    horizon = next((each.number("horizon_s") for each in held.parts("records")), None)
    if rows and horizon is not None:
        yield paragraphs(f"Short horizons are of {shown(horizon, 3)} s, each from the initial state that fits it best.")
    yield _trace(held.part("trace"))
    yield from _force(document.part("restoring_force"))


def _rows(record: Part, names: list[str]) -> Iterator[tuple[object, ...]]:
    """One row an output."""
    short, whole = record.part("error"), record.part("error_of_whole_record")
    columns = [record.numbers("rms")]
    columns += [part.numbers(key) for part in (short, whole) for key in (_AS_IT_IS, _AFTER)]
    for i in range(max(map(len, columns))):
        name = names[i] if i < len(names) else f"output {i + 1}"
        yield (record.text("title"), name, *(column[i] if i < len(column) else None for column in columns))


def _bar(row: tuple[object, ...]) -> Bar:
    title, name, rms, before, after, *_ = row
    share = [None if error is None else 100 * error / rms for error in (before, after)]
    words = ", then ".join("–" if part is None else f"{part:.3g} %" for part in share)
    return Bar(f"{title}, {name}", words, tuple(share))


def _trace(trace: Part) -> Markup:
    unit = f", {trace.text('unit')}" if trace.text("unit") else ""
    simulated = trace.part("simulated")
    drawn = [
        Line("measured", "measured", trace.vectors("measured", 2)),
        Line("before", "prior", simulated.vectors(_AS_IT_IS, 2)),
        Line("after", "revised", simulated.vectors(_AFTER, 2)),
    ]
    title = f"A stretch of a record held out: {trace.text('title')}"
    return lines("trace", title, "Measured and simulated, over time.", "time, s", f"{trace.text('title')}{unit}", drawn)


def _force(found: Part) -> Iterator[Markup]:
    """Force over motion and over velocity."""
    force, law = found.numbers("force"), found.numbers("law")
    for key in ("motion", "velocity") if found else ():
        along = found.numbers(key)
        drawn = [
            Line("implied by the recording", "measured", _pairs(along, force), dots=True),
            Line("the fitted law", "revised", _pairs(along, law), dots=True),
        ]
        title = f"Restoring force over {key}: {found.text('title')}, {found.text('place')}"
        yield lines(f"force-{key}", title, f"Samples over {key}.", key, "force", drawn)


def _pairs(x: list[float | None], y: list[float | None]) -> list[list[float]]:
    return [[a, b] for a, b in zip(x, y, strict=False) if a is not None and b is not None]


_NEXT_MEASUREMENT_HEADS = ("measure", "between", "predicted separation, log evidence", "outlook")


def proposals(document: Part) -> Iterator[Markup]:
    """The proposals in their order: the least effort that settles it comes first."""
    rows = [
        (each.text("measure"), " and ".join(each.labels("between")), each.number("separation"), each.text("outlook"))
        for each in document.parts("next_measurement")
    ]
    yield table("proposals", "Measurements that would separate the rivals", _NEXT_MEASUREMENT_HEADS, rows)


SECTIONS = (
    PageSection("held-out", 35, "Validation", held_out),
    PageSection("records", 36, "Records held out", records),
    PageSection("next", 38, "What to measure next", proposals),
)
