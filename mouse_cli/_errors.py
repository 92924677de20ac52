"""Diagnostics as values, the errors that carry them, and the frame that shows where each one stands."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

from mouse_cli._span import Span
from mouse_cli._texts import line

ERROR, WARNING = "error", "warning"
_WIDEST, _BEFORE = 160, 60  # columns of a line that are shown, and of them before a place that is farther to the right
RULER = (  # above a card
    "         1         2         3         4         5         6         7         8",
    "12345678901234567890123456789012345678901234567890123456789012345678901234567890",
)


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding: `code` is explained by `mouse explain`, `message` says what was read and what was expected."""

    code: str
    severity: str
    message: str
    span: Span | None = None
    note: str = ""
    help: str = ""

    @property
    def headline(self) -> str:
        """First line, in the form that editors and CI make clickable: file:line:column: severity[code]: text."""
        place = f"{self.span}: " if self.span else ""
        return f"{place}{self.severity}[{self.code}]: {self.message}"


class MouseError(Exception):
    """Carries every diagnostic found, so that a user mends a deck once and not once per error."""

    exit_code = 5

    def __init__(self, diagnostics: Iterable[Diagnostic] | Diagnostic):
        one = isinstance(diagnostics, Diagnostic)
        self.diagnostics: tuple[Diagnostic, ...] = (diagnostics,) if one else tuple(diagnostics)
        super().__init__("\n".join(d.headline for d in self.diagnostics))

    @classmethod
    def of(cls, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> Self:
        """The error of one finding."""
        return cls(Diagnostic(code, ERROR, message, span, note, help))


class DeckError(MouseError):
    """A deck was rejected; nothing was computed or written.

    >>> import mouse_cli
    >>> try:
    ...     mouse_cli.read_deck("decks/no_such_deck.yaml")
    ... except mouse_cli.DeckError as error:
    ...     print([one.code for one in error.diagnostics], error.exit_code)
    ['MD250'] 4
    """

    exit_code = 4


class RecordError(DeckError):
    """Measured data were rejected: a file that cannot be read, or channels that are no measurement."""


class NumericalError(MouseError):
    """The numbers allow no answer: names the parameter, the cycle and the card or line that set it.

    >>> from dataclasses import replace
    >>> import mouse_cli
    >>> problem = mouse_cli.read_deck("decks/sound_chain.yaml")
    >>> structure = problem.structure
    >>> try:
    ...     mouse_cli.run(replace(problem, structure=replace(structure, M=-structure.M)))
    ... except mouse_cli.NumericalError as error:
    ...     print([one.code for one in error.diagnostics], error.exit_code)
    ['MD501'] 5
    """


class PluginError(MouseError):
    """A member that another distribution registers cannot be used."""


class WrittenError(MouseError):
    """An output could not be written; whatever stood there before is untouched."""


def fault(error: BaseException, what: str = "") -> Diagnostic:
    """The finding MD903 of an unexpected exception: its kind and where it was raised; what: the deck it is about."""
    at, place = error.__traceback__, ""
    while at is not None:
        code = at.tb_frame.f_code
        if "mouse_cli" in code.co_filename:
            place = f" ({code.co_filename.rpartition('mouse_cli')[2].lstrip('/')}, line {at.tb_lineno})"
        at = at.tb_next
    message = f"{what and what + ': '}{type(error).__name__}: {error}".split("\n")[0][:200] + place
    help = "this is a fault of mouse: report it with the deck; with MOUSE_TRACEBACK=1 set, Python's account is printed"
    return Diagnostic("MD903", ERROR, message, help=help)


def frame(diagnostic: Diagnostic) -> str:
    """Headline, the offending line (a card under its column ruler) with a caret under the whole field, note and help."""
    span = diagnostic.span
    gutter = " " * (len(str(span.line)) if span else 1)
    lines = [line(diagnostic.headline)]
    if span and span.text:
        lines += [f"{gutter} |  {row}" for row in RULER if span.card]
        begin = span.column - _BEFORE if span.column + len(gutter) + 4 > _WIDEST else 0
        caret = "^" * max(1, min(span.width, len(span.text) + 1 - span.column))
        lines.append(f"{span.line} |  {_printable(span.text[begin : begin + _WIDEST])}"[:_WIDEST].rstrip())
        lines.append(f"{gutter} |  {' ' * (span.column - 1 - begin)}{caret}"[:_WIDEST])
    lines += [
        f"{gutter} = {name}: {line(text)}"
        for name, text in (("note", diagnostic.note), ("help", diagnostic.help))
        if text
    ]
    return "\n".join(lines)


def _printable(text: str) -> str:
    """The line with one visible character per column, so that the caret stays under its field."""
    return "".join(c if c.isprintable() else "?" for c in text)
