"""Answers that judge no model: their mark and their first sentence, by the schema of the document."""

from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli.page.numbers import shown
from mouse_cli.report.reading import Part


@dataclass(frozen=True)
class Unjudged:
    """mark: class and words of what stands before all, of a document; sentence: what was found."""

    mark: Callable[[Part], tuple[str, str]]
    sentence: Callable[[Part], str]


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
    "mouse.modes/1": Unjudged(_always("The model as it is"), _predicted),
    "mouse.comparison/1": Unjudged(_always("Methods of updating compared"), _compared),
    "mouse.correlation/1": Unjudged(_always("Test and model compared, before any update"), _correlated),
    "mouse.identification/1": Unjudged(_trusted, _identified),
}
