"""Words and charts that sections share."""

from mouse_cli.page.charts import Bar, bars
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.numbers import apart, signed_per_cent
from mouse_cli.report.reading import Part

_MOST_BARS = 40  # lines of a figure; its table has all


def paragraphs(*texts: str) -> Markup:
    """Each text as a paragraph, empty ones left out."""
    return Markup("".join(tag("p", text) for text in texts if text))


def listed(texts: list[str]) -> Markup:
    """Texts as a list; empty without any."""
    return tag("ul", *(tag("li", text) for text in texts)) if texts else Markup("")


def place(site: Part) -> str:
    """A place in words, with its coordinates where it is a point."""
    words = site.text("text") or f"{site.text('kind')} {', '.join(site.labels('ids'))}".strip()
    position = [x for x in site.numbers("position") if x is not None]
    return f"{words} at ({', '.join(f'{x + 0.0:.4g}' for x in position)})" if position else words


def places(one: Part) -> str:
    """The places of an explanation or a verdict."""
    return " and ".join(filter(None, map(place, one.parts("sites")))) or "–"


def differences(key: str, title: str, rows: list[tuple[str, float | None, float | None, float | None]]) -> Markup:
    """Bars of frequency errors of two models: (label, measured, before, after) each."""
    drawn = []
    for label, measured, before, after in rows[:_MOST_BARS]:
        lengths = apart(before, measured), apart(after, measured)
        words = f"{signed_per_cent(lengths[0])}, then {signed_per_cent(lengths[1])}"
        drawn.append(Bar(label, words, lengths))
    description = f"Model minus test in per cent of the test, before and after. {cut(rows)}"
    values = "; ".join(f"{bar.label}: {bar.words}" for bar in drawn)
    return bars(key, title, f"{description}{values}.", drawn, ("before", "after"))


def drawn_model(document: Part) -> str:
    """Which model drawings are of."""
    if document.text("schema") == "mouse.modes/1":
        return "the model"
    return "the extended model" if document.part("extended") else "the revised model"


def cut(rows: list) -> str:
    """A sentence where a figure shows fewer lines than there are."""
    return f"The first {_MOST_BARS} of {len(rows)}. " if len(rows) > _MOST_BARS else ""


def shares(key: str, title: str, description: str, rows: list[tuple[str, str, float | None]]) -> Markup:
    """Bars of shares or probabilities: (label, words, length) each."""
    drawn = [Bar(label, words, (length,)) for label, words, length in rows[:_MOST_BARS]]
    values = "; ".join(f"{bar.label}: {bar.words}" for bar in drawn)
    return bars(key, title, f"{description} {cut(rows)}{values}.", drawn, (title,))
