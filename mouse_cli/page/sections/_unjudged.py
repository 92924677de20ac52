"""Answers that judge no model: mark, first sentence, figures and tables, by the schema of the document."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.sections import _campaigns, _coupled, _functions, _modified
from mouse_cli.page.sections.measured import (
    correlation_figures,
    correlation_tables,
    identification_figures,
    identification_tables,
)
from mouse_cli.page.tables import Column, Listing, columns_of
from mouse_cli.report.reading import Part


@dataclass(frozen=True)
class Unjudged:
    """mark: class and words of what stands before all, of a document; sentence: what was found; then its figures and tables."""

    mark: Callable[[Part], tuple[str, str]]
    sentence: Callable[[Part], str]
    tables: Callable[[Part], Iterable[Listing]] = lambda document: ()
    figures: Callable[[Part], Iterable[Markup]] = lambda document: ()


def _compared(document: Part) -> str:
    """Which method predicts best what it was not given; none where nothing was held out."""
    errors: dict[str, float] = {}
    for one in document.parts("methods"):
        kept = [c.number("rms_percent") for c in one.parts("configurations") if not c.flag("fitted")]
        if kept and None not in kept:
            errors[one.text("method")] = max(kept)
    count = len(document.parts("methods"))
    if not errors:
        return f"{count} methods side by side; nothing was held out to judge them by."
    best = min(errors, key=errors.__getitem__)
    return f"Of {count} methods {best} predicts best what it was not given: {shown(errors[best], 3)} % rms at most."


def _predicted(document: Part) -> str:
    hz = [x for mode in document.parts("modes") if (x := mode.number("hz"))]
    if not hz:
        return "No natural frequency."
    return f"{len(hz)} natural frequencies from {shown(min(hz), 4)} to {shown(max(hz), 4)} Hz, before any test."


_MODES = columns_of(
    "mode: mode name | frequency, Hz: hz | sd, Hz: sd_hz 3 | sd: ()",
    lambda mode: Column("", "share", "share").cell(_relative(mode)),
)
_MOST = 1000  # modes of the table


def _relative(mode: Part) -> Part:
    hz, sd = mode.number("hz"), mode.number("sd_hz")
    return Part({"share": sd / hz if sd is not None and hz else None}, mode.file, mode.place)


def _predicted_tables(document: Part) -> Iterator[Listing]:
    modes = document.parts("modes")
    cut = f"The first {_MOST} of {len(modes)} natural" if len(modes) > _MOST else "Natural"
    yield Listing("predicted", f"{cut} frequencies of the model", _MODES, modes[:_MOST])


def _correlated(document: Part) -> str:
    """How many modes found a partner, and the worst pair."""
    modes = document.parts("modes")
    paired = [m for m in modes if m.number("model_mode") is not None]
    macs = {m.label("mode"): x for m in paired if (x := m.number("mac")) is not None}
    if not paired:
        return f"None of {len(modes)} measured modes has a partner in the model."
    least = min(macs, key=macs.__getitem__, default="")
    worst = f"; the least MAC is {macs[least]:.3f}, of mode {least}" if macs else ", by frequency alone"
    faults = len(document.parts("sensor_faults"))
    doubt = f" {faults} sensor{'s look' if faults > 1 else ' looks'} faulty." if faults else ""
    return f"{len(paired)} of {len(modes)} measured modes have a partner{worst}.{doubt}"


def _identified(document: Part) -> str:
    """How many modes in which band."""
    modes, band = document.parts("modes"), [x for x in document.numbers("band_hz") if x is not None]
    where = f" between {shown(band[0], 4)} and {shown(band[-1], 4)} Hz" if band else ""
    return f"{len(modes) or 'No'} mode{'' if len(modes) == 1 else 's'}{where}."


def _trusted(document: Part) -> tuple[str, str]:
    if document.flag("trusted"):
        return "good", "✓ Modes identified"
    return ("doubt", "! Modes identified, with doubts") if document.parts("modes") else ("bad", "✗ No modes")


def _always(words: str) -> Callable[[Part], tuple[str, str]]:
    return lambda document: ("good", words)


UNJUDGED = {
    "mouse.modes/1": Unjudged(_always("The model as it is"), _predicted, _predicted_tables),
    "mouse.comparison/1": Unjudged(_always("Methods of updating compared"), _compared),
    "mouse.correlation/1": Unjudged(
        _always("Test and model compared, before any update"), _correlated, correlation_tables, correlation_figures
    ),
    "mouse.identification/1": Unjudged(_trusted, _identified, identification_tables, identification_figures),
    "mouse.spectra/1": Unjudged(_functions.mark, _functions.sentence, _functions.tables, _functions.figures),
    "mouse.coupling/1": Unjudged(_coupled.mark, _coupled.sentence, _coupled.tables, _coupled.figures),
    "mouse.modification/1": Unjudged(_modified.mark, _modified.sentence, _modified.tables, _modified.figures),
    "mouse.campaign/1": Unjudged(_campaigns.mark, _campaigns.sentence, _campaigns.tables, _campaigns.figures),
    "mouse.sample/1": Unjudged(
        _campaigns.mark, _campaigns.sampled, _campaigns.sample_tables, _campaigns.sample_figures
    ),
}
