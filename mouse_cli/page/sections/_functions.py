"""Spectra of recordings: mark, first sentence, figures and tables; and FRFs of predictions as curves."""

from collections.abc import Iterator
from math import hypot, log10

from mouse_cli.page.html import Markup
from mouse_cli.page.lines import Line, lines
from mouse_cli.page.numbers import shown
from mouse_cli.page.tables import Listing, columns_of
from mouse_cli.report.reading import Part

_CURVES, _POINTS, _DEEP = 4, 600, 120.0  # figures of a document, points of a curve, dB below the highest value
PEAKS = columns_of(
    "response: response name | force: force name | peak, Hz: hz | magnitude: magnitude 4 | sd: sd 2 | phase, degrees: phase 4"
)
_ACCURACY = columns_of(
    "response: response name | force: force name | lines: lines name | median coherence: median_coherence 4 | "
    "median noise: median_noise share | highest at, Hz: peak_hz"
)


def mark(document: Part) -> tuple[str, str]:
    """Whether there are warnings."""
    return ("doubt", "! FRFs estimated, with warnings") if document.texts("warnings") else ("good", "✓ FRFs estimated")


def sentence(document: Part) -> str:
    """How many functions, of how many averages, how coherent."""
    texts = []
    for each in document.parts("measurements"):
        found = each.parts("functions")
        known = [x for f in found if (x := f.number("median_coherence")) is not None]
        coherence = f", median coherence {min(known):.3f} to {max(known):.3f}" if known else ""
        count = f"{len(found)} FRF{'s' * (len(found) != 1)} of {shown(each.number('averages'), 4)} averages"
        texts.append(f"{', '.join(each.texts('recordings'))}: {count}{coherence}.")
    return " ".join(texts) or "No FRF."


def figures(document: Part) -> Iterator[Markup]:
    """Magnitude and coherence of the functions that the document has as curves."""
    for number, each in enumerate(document.parts("measurements"), 1):
        for order, one in enumerate(each.parts("curves"), 1):
            names, key = f"{one.label('response')} by {one.label('force')}", f"{number}-{order}"
            for which, what, unit in (
                ("measured", each.text("kind").capitalize(), "dB"),
                ("coherence", "Coherence", ""),
            ):
                line = Line("", "measured", one.vectors(which, 2))
                yield lines(
                    f"{which}-{key}", f"{what} {names}", "Over frequency.", "frequency, Hz", unit, [line], _DEEP
                )


def tables(document: Part) -> Iterator[Listing]:
    """The accuracy of every function."""
    for number, each in enumerate(document.parts("measurements"), 1):
        title = f"Accuracy of the FRFs of {', '.join(each.texts('recordings'))}"
        yield Listing(f"accuracy-{number}", title, _ACCURACY, each.parts("functions"))


def overlaid(key: str, models: list[tuple[str, str, Part]]) -> Iterator[Markup]:
    """Magnitudes in dB over frequency of the first functions: (name, looks, functions) of each model."""
    models = [model for model in models if model[2]]
    each = [(name, looks, found.numbers("hz"), found.parts("each")) for name, looks, found in models]
    for order, one in enumerate(each[-1][3][:_CURVES] if each else ()):
        drawn = [Line(name, looks, _decibels(hz, of[order])) for name, looks, hz, of in each if order < len(of)]
        title = f"{models[-1][2].text('kind').capitalize()} {one.label('response')} by {one.label('force')}"
        yield lines(f"{key}-{order + 1}", title, "Magnitudes over frequency.", "frequency, Hz", "dB", drawn, _DEEP)


def _decibels(hz: list[float | None], function: Part) -> list[list[float]]:
    """(Hz, 20 log10 |H|), at most _POINTS: the lowest and the highest of each stretch."""
    values = zip(hz, function.numbers("real"), function.numbers("imag"), strict=False)
    known = [[f, 20 * log10(size)] for f, a, b in values if None not in (f, a, b) and (size := hypot(a, b)) > 0]
    step = -(-2 * len(known) // _POINTS)
    if step <= 2:
        return known
    stretches = (known[i : i + step] for i in range(0, len(known), step))
    return [point for part in stretches for point in sorted((min(part, key=_level), max(part, key=_level)))]


def _level(point: list[float]) -> float:
    return point[1]
