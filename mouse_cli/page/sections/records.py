"""Records that no fit has seen: errors of simulations, a stretch of one, and the restoring force at the place of a law."""

from collections.abc import Iterator

from mouse_cli.page.charts import Bar, bars
from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import shown
from mouse_cli.page.section import PageSection
from mouse_cli.page.sections._words import paragraphs
from mouse_cli.page.tables import table
from mouse_cli.report.reading import Part

_AS_IT_IS, _AFTER = "as it is", "with the cause"  # keys of documents
_MOST = 40  # lines of the figure
_HEADS = ("record", "output", "rms measured", "short horizons, before", "after", "whole record, before", "after")


def records(document: Part) -> Iterator[Markup]:
    """Bars of errors over the rms of the record, all errors, and the figures."""
    held, names = document.part("held_out"), document.part("recordings").labels("outputs")
    rows = [row for each in held.parts("records") for row in _rows(each, names)]
    drawn = [_bar(row) for row in rows if row[2]][:_MOST]
    spoken = "; ".join(f"{bar.label}: {bar.words}" for bar in drawn)
    told = f"rms of measured less simulated over short horizons, by the rms of the record. {spoken}."
    yield bars("off-records", "What is missed of records held out", told, drawn, ("before", "after"))
    yield table("held-out-records", "Errors of records held out, rms", _HEADS, rows)
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


SECTION = PageSection("records", 36, "Records held out", records)
