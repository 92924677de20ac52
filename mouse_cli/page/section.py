"""A section of the page: a SECTION of a file of `sections`, or one of its SECTIONS, that turns a document into markup."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.page.html import Markup, tag
from mouse_cli.report.reading import Part


@dataclass(frozen=True)
class PageSection:
    """`build(document)` yields what the section shows, nothing when the document has nothing of it.

    order: among all sections. folded: closed until it is asked for, as evidence is; of a document where that depends on it.
    """

    key: str
    order: int
    title: str
    build: Callable[[Part], Iterable[Markup]]
    folded: bool | Callable[[Part], bool] = True


def sections(document: Part) -> Iterator[tuple[PageSection, Markup]]:
    """The sections that have something to show, in the order of the page."""
    found = _registry.discover("mouse_cli.page.sections", "SECTION").values()
    for section in sorted(found, key=lambda s: (s.order, s.key)):
        body = [piece for piece in section.build(document) if piece]
        if body:
            head = tag("h2", section.title, id=f"{section.key}-title")
            folded = section.folded if isinstance(section.folded, bool) else section.folded(document)
            inside = (tag("details", tag("summary", head), *body),) if folded else (head, *body)
            yield section, tag("section", *inside, id=section.key, aria_labelledby=f"{section.key}-title")
