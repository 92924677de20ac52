"""Where a value came from: file, line, columns and the text of that line."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """A place in a text file; lines and columns count from 1, as editors and card punches do. card: an 80-column card."""

    file: str
    line: int
    column: int = 1
    width: int = 1
    text: str = ""
    card: bool = False

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"
