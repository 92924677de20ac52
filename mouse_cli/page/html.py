"""Markup: elements whose text and attributes are always escaped."""

import re
from html import escape

_NOT_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff]")  # no page may hold them, no file either
_EMPTY = frozenset({"meta", "br", "col", "input"})  # elements without an end


class Markup(str):
    """Text that is markup already; all other text is escaped where it enters an element."""

    __slots__ = ()


def text(value: object) -> Markup:
    """`value` as text of a page.

    >>> text("</script><b>"), text(Markup("<b>"))
    ('&lt;/script&gt;&lt;b&gt;', '<b>')
    """
    return value if isinstance(value, Markup) else Markup(escape(_NOT_TEXT.sub("\ufffd", str(value))))


def tag(name: str, *children: object, **attributes: object) -> Markup:
    """An element. None and False leave an attribute out, True writes its name alone; `_` ends or parts a name as `-`.

    >>> tag("th", "k & m", scope="col", class_="n", aria_sort="none", hidden=False)
    '<th scope="col" class="n" aria-sort="none">k &amp; m</th>'
    """
    written = "".join(_attribute(key, value) for key, value in attributes.items())
    if name in _EMPTY:
        return Markup(f"<{name}{written}>")
    return Markup(f"<{name}{written}>{join(children)}</{name}>")


def join(parts: object) -> Markup:
    """Several pieces, one after another."""
    return Markup("".join(text(part) for part in parts if part is not None))


def _attribute(key: str, value: object) -> str:
    name = key.rstrip("_").replace("_", "-")
    if value is None or value is False:
        return ""
    return f" {name}" if value is True else f' {name}="{text(str(value))}"'
