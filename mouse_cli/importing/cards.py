"""Input of Abaqus and CalculiX as cards: a keyword, its options and its lines of data, with included files in their place."""

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from difflib import get_close_matches

from mouse_cli._errors import ERROR, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats import below
from mouse_cli.formats.data_files import existing, line_span, reject, text_lines
from mouse_cli.importing.keywords import OPTIONS, PASSED, READ, WITHOUT_EFFECT

_MOST = 40  # findings that one reading lists
_JOINED = {word.replace(" ", ""): word for word in (*READ, *PASSED, *WITHOUT_EFFECT, *OPTIONS)}  # CalculiX passes over blanks
_OF_OTHERS = re.compile(r"\s*(/PREP7|/COM|/BATCH|!|N?BLOCK)", re.I)
_OTHERS = (
    "ANSYS does not run here: let it write K and M (HBMAT), and name these in a deck below model, with the nodes of this file: "
    "docs/how-to/import-models.md"
)


@dataclass
class Line:
    """A line of data: its words, and where it stands; written: the line of the file, where that is of another program."""

    words: list[str]
    text: str
    file: str
    number: int
    written: str = ""

    @property
    def span(self) -> Span:
        """Where the line stands."""
        return line_span(self.file, self.number, self.written or self.text)


@dataclass
class Card:
    """keyword, such as `SOLID SECTION`; options by name, all in capitals; lines of data; head: the lines of the keyword."""

    keyword: str
    options: dict[str, str]
    head: Line
    lines: list[Line] = field(default_factory=list)

    def text(self) -> list[str]:
        """The card as it was written."""
        return [self.head.text, *(line.text for line in self.lines)]


@dataclass
class Faults:
    """What is wrong with the input, so that all of it is told at once."""

    found: list[Diagnostic] = field(default_factory=list)

    def add(self, code: str, message: str, span: Span, help: str) -> None:
        """Note a finding, once."""
        if len(self.found) < _MOST and not any((each.message, each.span) == (message, span) for each in self.found):
            self.found.append(Diagnostic(code, ERROR, message, span, help=help))

    def stop(self) -> None:
        """Raise DeckError with what was found, if anything was."""
        if self.found:
            raise DeckError(self.found)


def meant(name: str, known: Iterable[str], help: str) -> str:
    """What to do about a name that is none: the one that is most like it, if one is."""
    near = get_close_matches(name.upper(), list(known), 1)
    return f"did you mean {near[0]}? If not, {help}" if near else help


def cards(path: str, outside: bool = False) -> list[Card]:
    """All cards of a file, those of included files among them, which lie below its folder or anywhere (`outside`).

    Raises DeckError (MD231, MD250 to MD267).
    """
    existing(path)
    found: list[Card] = []
    for line in _lines(path, (), outside):
        if line.text.lstrip().startswith("*"):
            found.append(Card(_keyword(line.text), _options(line.text), line))
        elif found:
            found[-1].lines.append(line)
        else:
            help = _OTHERS if _OF_OTHERS.match(line.text) else "begin with a keyword such as *NODE"
            reject("MD265", path, "data stand before the first keyword", help, line.span)
    return found


def _lines(path: str, above: tuple[str, ...], outside: bool) -> Iterator[Line]:
    """Lines without comments and blank ones; those of keywords with what continues them; those of included files in their place."""
    head: Line | None = None
    for number, text in enumerate(text_lines(path), 1):
        if text.startswith("**") or not text.strip():
            continue
        if head is not None:
            head.text += text.strip()
        elif text.lstrip().startswith("*"):
            head = Line([], text.rstrip(), path, number)
        else:
            yield Line(_words(text), text.rstrip(), path, number)
            continue
        if head.text.endswith(","):
            continue
        line, head = head, None
        if _keyword(line.text) == "INCLUDE":
            yield from _included(line, path, above, outside)
        else:
            yield line
    if head is not None:
        yield head


def _included(line: Line, path: str, above: tuple[str, ...], outside: bool) -> Iterator[Line]:
    name = _options(line.text).get("INPUT", "").strip("\"'")
    yield from _lines(included(line.span, name, (*above, path), outside), (*above, path), outside)


def included(place: Span, name: str, chain: tuple[str, ...], outside: bool) -> str:
    """The file that the last of `chain` includes as `name`: relative to itself, or to the job, the first of them.

    Raises DeckError (MD231, MD250, MD266, MD267) at `place`.
    """
    path = chain[-1]
    target = _named(place, name, path, chain[0], outside) if name and "\0" not in name else None
    if target is None:
        message = f"the included file '{name[:80]}' does not exist" if name else "no file to include is named"
        reject("MD266", path, message, "put the file beside the job, or mend the name", place)
    if any(os.path.samefile(target, each) for each in chain):
        message = f"'{name[:80]}' includes itself, by way of {' > '.join(map(os.path.basename, chain))}"
        reject("MD267", path, message, "take one of the lines that include it out", place)
    return target


def _named(place: Span, name: str, path: str, job: str, outside: bool) -> str | None:
    """The file called `name` beside the file `path` or the `job`; None where there is none. Raises DeckError (MD231, MD250)."""
    refused = None
    for each in dict.fromkeys((path, job)):
        there = os.path.join(os.path.dirname(each), name)
        allowed = below.named if os.path.isabs(name) else below.found
        try:
            allowed(os.path.dirname(job), there, outside, "the folder of the job")
        except below.Refused as error:
            refused = refused or error
            continue
        if os.path.isfile(there):
            return there
    if refused is not None:
        reject(refused.code, path, f"the line includes '{name[:200]}', {refused}", refused.help, place)
    return None


def _keyword(text: str) -> str:
    return _spaced(text.lstrip()[1:].partition(",")[0])


def _spaced(name: str) -> str:
    """A keyword, an option or a type in capitals, as Abaqus writes it.

    >>> _spaced("Shellsection"), _spaced("ref  node"), _spaced("Set 1")
    ('SHELL SECTION', 'REF NODE', 'SET 1')
    """
    words = name.upper().split()
    return _JOINED.get("".join(words), " ".join(words))


def _options(text: str) -> dict[str, str]:
    """Options of a keyword line; names in capitals, and values too, but those of files."""
    found = {}
    for part in text.split(",")[1:]:
        name, _, value = part.partition("=")
        name = _spaced(name)
        if name:
            found[name] = value.strip() if name in ("INPUT", "FILE") else value.strip().strip('"').upper()
            found[name] = _spaced(value) if name == "TYPE" else found[name]
    return found


def _words(text: str) -> list[str]:
    words = [word.strip() for word in text.split(",")]
    return words[:-1] if len(words) > 1 and not words[-1] else words
