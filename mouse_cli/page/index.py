"""The index of a batch: a table of its jobs that filters by word and by ending, with a link to the page of each answer."""

import os
from urllib.parse import quote

from mouse_cli import __version__
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.summary import count
from mouse_cli.page.html import Markup, tag
from mouse_cli.page.page import written
from mouse_cli.page.tables import Cell, table

_HEADS = ("deck", "command", "ended", "exit", "residual p-value", "missed", "seconds", "message")
_LOOKS = {0: "good", 1: "doubt"}


def index(outcomes: list[Outcome], pages: dict[str, str], folder: str) -> str:
    """HTML of a page in `folder`; pages: the file of the page of each answer, by the file of the answer."""
    links = {answer: quote(os.path.relpath(page, folder or ".").replace(os.sep, "/")) for answer, page in pages.items()}
    rows = [_row(each, links.get(each.result)) for each in outcomes]
    shown = tag("section", _filters(outcomes), table("jobs", "Jobs", _HEADS, rows), id="verdict")
    made = f"Made by mouse, version {__version__}."
    return written("Batch", (tag("p", count(outcomes), class_="verdict"),), (shown,), made, ("page", "index"))


def _filters(outcomes: list[Outcome]) -> Markup:
    """What the script filters by; without it, nothing: the table shows all."""
    endings = sorted({each.ended for each in outcomes})
    every = [tag("option", "any ending", value=""), *(tag("option", each, value=each) for each in endings)]
    word = tag("label", "Deck or message ", tag("input", type="search", id="word"))
    return tag("p", word, " ", tag("label", "Ended ", tag("select", *every, id="ended")), class_="filters", hidden=True)


def _row(found: Outcome, link: str | None) -> tuple[object, ...]:
    name = found.deck if link is None else tag("a", found.deck, href=link)
    messages = "; ".join(each.message for each in (*found.missed, *found.errors[:1]))
    looks = "bad" if found.missed else _LOOKS.get(found.counted, "bad")
    missed = Cell(float(len(found.missed)), f"{len(found.missed)} of {found.expected}") if found.expected else None
    return (
        name,
        found.command,
        tag("span", found.ended, class_=looks),
        Cell(float(found.exit_code), str(found.exit_code)),
        found.residual_p,
        missed,
        Cell(found.seconds, f"{found.seconds:.1f}"),
        messages,
    )
