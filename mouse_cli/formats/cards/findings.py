"""The diagnostics of one deck while it is read: counted, capped and, when reading cannot go on, raised."""

from collections import Counter
from dataclasses import dataclass, field
from typing import NoReturn

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic
from mouse_cli._span import Span

MOST_ERRORS = 100
MOST_WARNINGS = 20  # of one code; a deck of 100,000 numbers without a point is one finding, not 100,000


@dataclass
class Findings:
    """What has been found so far, in the order found."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    errors: int = 0
    warned: Counter = field(default_factory=Counter)
    last: dict[str, Span | None] = field(default_factory=dict)

    def error(self, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> None:
        """Note an error. Raises DeckError when there are too many to be of use."""
        self.diagnostics.append(Diagnostic(code, ERROR, message, span, note, help))
        self.errors += 1
        if self.errors >= MOST_ERRORS:
            self.stop(
                "MD128",
                f"{MOST_ERRORS} errors; the rest of the deck was not read",
                span,
                help="mend these first",
            )

    def warn(self, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> None:
        """Note a warning, unless there are many of its kind already."""
        self.warned[code] += 1
        if self.warned[code] <= MOST_WARNINGS:
            self.diagnostics.append(Diagnostic(code, WARNING, message, span, note, help))
        else:
            self.last[code] = span

    def forget(self, since: int) -> None:
        """Drop what was found since a place in the list: a card was read as something that it is not."""
        for diagnostic in self.diagnostics[since:]:
            if diagnostic.severity == ERROR:
                self.errors -= 1
            else:
                self.warned[diagnostic.code] -= 1
        del self.diagnostics[since:]

    def stop(self, code: str, message: str, span: Span | None = None, note: str = "", help: str = "") -> NoReturn:
        """Note an error after which the rest of the deck has no meaning, and raise everything found."""
        self.diagnostics.append(Diagnostic(code, ERROR, message, span, note, help))
        self.give_up()

    def give_up(self) -> NoReturn:
        """Raise everything found."""
        raise DeckError(self.finished())

    def finished(self) -> list[Diagnostic]:
        """All diagnostics, with one line for the warnings that were counted only."""
        extra = [
            Diagnostic(code, WARNING, f"{self.warned[code] - MOST_WARNINGS} more warnings like this one", span)
            for code, span in self.last.items()
        ]
        return self.diagnostics + extra
