"""Coupled structures: mark, first sentence, figures and tables."""

from collections.abc import Iterator

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.sections._functions import PEAKS, overlaid
from mouse_cli.page.tables import Column, Listing, columns_of
from mouse_cli.report.reading import Part


def mark(document: Part) -> tuple[str, str]:
    """Whether noise decides the interface, MD713."""
    noisy = any(text.startswith("MD713") for text in document.texts("warnings"))
    return ("doubt", "! Coupled, but noise decides the interface") if noisy else ("good", "✓ Structures coupled")


def sentence(document: Part) -> str:
    """Of what, and which frequencies."""
    names = ", ".join(
        f"{p.text('name')}{' (removed)' if p.flag('removed') else ''}" for p in document.parts("substructures")
    )
    hz, peaks = [x for x in document.part("modes").numbers("hz") if x], document.parts("peaks")
    found = f" {len(hz)} natural frequencies from {shown(min(hz), 4)} to {shown(max(hz), 4)} Hz." if hz else ""
    if peaks and not hz:
        highest = max(peaks, key=lambda peak: peak.number("magnitude") or 0.0)
        found = f" Highest peak of its FRFs at {shown(highest.number('hz'), 4)} Hz."
    return f"Structure of {names}, joined at {len(document.values.get('interfaces') or ())} degrees of freedom.{found}"


def figures(document: Part) -> Iterator[Markup]:
    """FRFs of the whole."""
    yield from overlaid("whole", [("the whole", "revised", document.part("functions"))])


def tables(document: Part) -> Iterator[Listing]:
    """Frequencies, peaks, reductions, parts."""
    modes = document.part("modes")
    numbered = [Part({"mode": i, "hz": hz}, document.file) for i, hz in enumerate(modes.numbers("hz"), 1)]
    heads = columns_of("mode: mode name | frequency, Hz: hz")
    yield Listing("whole-modes", "Natural frequencies of the whole", heads, numbered)
    yield Listing("whole-peaks", "Peaks of the FRFs", PEAKS, document.parts("peaks"))
    heads = columns_of(
        "reduction: method text | modes kept: keep name | coordinates: coordinates name | largest error of frequencies: ()",
        _worst,
    )
    yield Listing("reductions", "Component mode synthesis", heads, modes.parts("reduced"))
    yield Listing(
        "parts", "Substructures", columns_of("part: name text | source: source text"), document.parts("substructures")
    )


def _worst(reduced: Part) -> object:
    worst = max((abs(x) for x in reduced.numbers("error") if x is not None), default=None)
    return Column("", "error", "share").cell(Part({"error": worst}, reduced.file, reduced.place))
