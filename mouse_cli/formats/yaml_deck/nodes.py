"""YAML text to nodes: PyYAML's scanner under limits, so that every value keeps its line and column."""

import os
import re
from functools import cached_property

import yaml

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic
from mouse_cli._span import Span
from mouse_cli.formats.draft import Where

Node = yaml.Node
PLAIN, QUOTED, COLLECTION = "plain", "quoted", "collection"

MAX_BYTES = 64_000_000  # composing takes about 0.1 s and 20 MB of memory for each MB of deck
MAX_DEPTH = 20  # the deepest value of a deck, a component of shapes, is 5 deep
MAX_DIGITS = 1000  # Python refuses to make whole numbers of more than 4300
MAX_FINDINGS = 200
MAX_VALUES = 2_000_000  # of a deck with aliases, each alias counted as often as it is used

_BREAK = re.compile("\r\n|[\n\r\x85\u2028\u2029]")
_NOT_TEXT = re.compile("[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_LONG_NUMBER = re.compile(f"[0-9]{{{MAX_DIGITS}}}")
_NULLS = frozenset(("", "~", "null", "Null", "NULL"))


class Document:
    """A deck being read: where its values stand, and what was found wrong.

    `incomplete` is set by errors that leave a gap, so that no Draft can be made. `outside`: whether files that it names may lie
    outside of its folder.
    """

    def __init__(self, text: str, path: str, outside: bool = False):
        self.text, self.path, self.outside = text, path, outside
        self.diagnostics: list[Diagnostic] = []
        self.incomplete = False

    @cached_property
    def lines(self) -> list[str]:
        """Lines of the text as YAML counts them."""
        return _BREAK.split(self.text)

    @property
    def folder(self) -> str:
        """Folder that paths in the deck are relative to."""
        return os.path.dirname(os.path.abspath(self.path))

    @property
    def full(self) -> bool:
        """Whether so much is wrong that more findings would help nobody."""
        return len(self.diagnostics) >= MAX_FINDINGS

    def span(self, node: Node) -> Span:
        """Place of a key or value; of one over several lines, its first line."""
        start, end = node.start_mark, node.end_mark
        text = self._line(start.line)
        stop = end.column if end.line == start.line else len(text.rstrip())
        return Span(self.path, start.line + 1, start.column + 1, max(1, stop - start.column), text)

    def at(self, line: int, column: int, width: int = 1) -> Span:
        """Place given from 0, as marks count."""
        line = min(line, len(self.lines) - 1)
        return Span(self.path, line + 1, column + 1, width, self._line(line))

    def written(self, node: Node) -> str:
        """The value as it was written, for messages."""
        return self.text[node.start_mark.index : node.end_mark.index][:60]

    def where(self, nodes: list[Node]) -> Where:
        """Places of the items of a list, made only when asked for."""
        return lambda i: self.span(nodes[i])

    def error(
        self, code: str, node: Node | Span, message: str, help: str = "", note: str = "", gap: bool = True
    ) -> None:
        """Note an error; `gap` says that a value is missing now."""
        self.incomplete |= gap
        self._note(ERROR, code, node, message, help, note)

    def warn(self, code: str, node: Node | Span, message: str, help: str = "", note: str = "") -> None:
        """Note a warning."""
        self._note(WARNING, code, node, message, help, note)

    def _note(self, severity: str, code: str, node: Node | Span, message: str, help: str, note: str) -> None:
        if self.full:
            return
        span = node if isinstance(node, Span) else self.span(node)
        self.diagnostics.append(Diagnostic(code, severity, message, span, note, help))

    def _line(self, line: int) -> str:
        return self.lines[line] if line < len(self.lines) else ""


def is_null(node: Node) -> bool:
    """Whether the value is empty, `~` or `null`."""
    return node.tag == PLAIN and node.value in _NULLS


def compose(data: str | bytes, path: str, outside: bool = False) -> tuple[Document, Node]:
    """The root node of a deck, and the document that knows its places.

    Raises DeckError for text that is not YAML, goes beyond the limits, or holds no mapping.
    """
    document = Document(_decoded(data, path), path, outside)
    _check_text(document)
    root = _parsed(document)
    if not isinstance(root, yaml.MappingNode):
        help = "begin it with 'mouse: 1', 'title:' and 'model:'"
        _stop("MD205", document.at(0, 0), "the deck holds no keys", help)
    _check_aliases(document, root)
    return document, root


def _stop(code: str, span: Span, message: str, help: str = "", note: str = "") -> None:
    raise DeckError.of(code, message, span, note, help)


def _decoded(data: str | bytes, path: str) -> str:
    if len(data) > MAX_BYTES:
        message = f"the deck has {len(data)} bytes; at most {MAX_BYTES} are read"
        _stop("MD202", Span(path, 1), message, "put large matrices in files: {file: k.mtx}")
    if isinstance(data, str):
        return data.removeprefix("\ufeff")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8-sig", "replace")
        line, column = _BREAK.sub("\n", before).count("\n"), len(_BREAK.split(before)[-1])
        message = f"byte 0x{data[error.start]:02x} is not UTF-8 text"
        _stop("MD200", Span(path, line + 1, column + 1), message, "save the deck as UTF-8")
        raise


def _check_text(document: Document) -> None:
    found = _NOT_TEXT.search(document.text)
    if found:
        before = _BREAK.split(document.text[: found.start()])
        span = document.at(len(before) - 1, len(before[-1]))
        _stop("MD200", span, f"character U+{ord(found[0]):04X} may not stand in a deck", "delete it")
    long = _LONG_NUMBER.search(document.text)
    if long:
        before = _BREAK.split(document.text[: long.start()])
        span = document.at(len(before) - 1, len(before[-1]))
        _stop("MD202", span, f"a number of more than {MAX_DIGITS} digits stands here", "write numbers as 1.5e300")


class _TooDeep(Exception):
    """Nesting beyond MAX_DEPTH; stops the parser before its recursion can exhaust the stack."""


class _Limits:
    """Hooks of PyYAML's composer: no tag is resolved by pattern, and no node lies deeper than MAX_DEPTH."""

    _depth = 0

    def descend_resolver(self, parent: Node | None, index: object) -> None:
        """Called on the way into each node."""
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise _TooDeep(parent)

    def ascend_resolver(self) -> None:
        """Called on the way out."""
        self._depth -= 1

    def resolve(self, kind: type, value: object, implicit: object) -> str:
        """The word that stands for a tag: readers go by what they expect, not by what a text looks like."""
        if kind is not yaml.ScalarNode:
            return COLLECTION
        return PLAIN if implicit[0] else QUOTED


if getattr(yaml, "__with_libyaml__", False):
    from yaml.cyaml import CParser

    class _Composer(_Limits, CParser):
        """libyaml's parser."""

else:  # pragma: no cover - PyYAML built without libyaml: the same nodes, about 20 times slower
    from yaml.composer import Composer
    from yaml.parser import Parser
    from yaml.reader import Reader
    from yaml.scanner import Scanner

    class _Composer(_Limits, Reader, Scanner, Parser, Composer):
        """PyYAML's own parser."""

        def __init__(self, text: str):
            Reader.__init__(self, text)
            Scanner.__init__(self)
            Parser.__init__(self)
            Composer.__init__(self)


def _parsed(document: Document) -> Node | None:
    try:
        return _Composer(document.text).get_single_node()
    except MemoryError:
        message = "the deck takes more memory than there is"
        _stop("MD202", document.at(0, 0), message, "put large matrices in files: {file: k.mtx}")
    except _TooDeep as error:
        start = error.args[0].start_mark  # of a node that is not whole and has no end
        span = document.at(start.line, start.column)
        message = f"values are nested deeper than {MAX_DEPTH}"
        _stop("MD202", span, message, "close the brackets that are still open")
    except yaml.composer.ComposerError as error:
        _stop(*_composing(document, error))
    except yaml.MarkedYAMLError as error:
        _stop("MD201", *_syntax(document, error))


def _composing(document: Document, error: yaml.MarkedYAMLError) -> tuple[str, Span, str, str]:
    span = document.at(error.problem_mark.line, error.problem_mark.column)
    if "another document" in error.problem:
        return (
            "MD204",
            span,
            "a second document begins here",
            "give one deck per file, without '---' lines inside",
        )
    return "MD201", span, f"not YAML: {error.problem}", "write the value out"


def _syntax(document: Document, error: yaml.MarkedYAMLError) -> tuple[Span, str, str, str]:
    mark = error.problem_mark or error.context_mark
    span = document.at(mark.line, mark.column)
    note = ""
    if error.context and error.context_mark:
        begun = error.context_mark
        note = f"{error.context}, begun at line {begun.line + 1}, column {begun.column + 1}"
    if span.text[: mark.column + 1].strip(" ") == "\t":
        return span, "a tab cannot indent YAML", "indent with spaces", note
    return (
        span,
        f"not YAML: {error.problem}",
        "check brackets, commas, colons and indentation here and above",
        note,
    )


def _check_aliases(document: Document, root: Node) -> None:
    """A few aliases of aliases can stand for more values than memory holds: count before any is used."""
    if "*" not in document.text or "&" not in document.text:
        return
    size, depth = _size(root, {})
    if size > MAX_VALUES:
        message = f"the aliases (*name) of the deck stand for more than {MAX_VALUES} values, or hold themselves"
        _stop("MD202", document.at(0, 0), message, "write the values out, or put them in a file")
    if depth > MAX_DEPTH:
        message = f"by the aliases (*name) of the deck, values are nested {depth} deep; at most {MAX_DEPTH} are read"
        _stop("MD202", document.at(0, 0), message, "write the values out")


def _size(node: Node, known: dict[int, tuple[float, int]]) -> tuple[float, int]:
    """Number of values below a node, infinite when it holds itself, and how deep they are nested.

    An alias stands behind its anchor, so that what it stands for is known by then: calls nest no deeper than the text does.
    """
    if id(node) not in known:
        known[id(node)] = float("inf"), 0  # until all below is counted
        below = [_size(each, known) for each in _below(node)]
        known[id(node)] = 1 + sum(size for size, _ in below), 1 + max((depth for _, depth in below), default=0)
    return known[id(node)]


def _below(node: Node) -> list[Node]:
    if isinstance(node, yaml.MappingNode):
        return [item for pair in node.value for item in pair]
    return node.value if isinstance(node, yaml.SequenceNode) else []
