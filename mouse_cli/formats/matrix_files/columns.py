"""Text files of numbers in columns: read at once, and the faulty line named."""

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import line_span, reject, text_lines


class Columns:
    """The numbers (rows, width) of a text file; blanks or commas part them, lines that begin with `comment` are passed over."""

    def __init__(self, path: str, width: int, layout: str, comment: str):
        self.path, self.width, self.layout = path, width, layout
        lines = enumerate(text_lines(path), 1)
        self.rows = [(number, line) for number, line in lines if line.strip() and not line.startswith(comment)]
        if not self.rows:
            reject("MD252", path, "the file holds no numbers", f"give {layout} on each line")
        words = _words(" ".join(line for _, line in self.rows))
        try:
            self.table = np.array(words, dtype=float).reshape(len(self.rows), width)
        except ValueError:
            wrong = next((i for i, (_, line) in enumerate(self.rows) if not self._is_row(line)), None)
            span = None if wrong is None else self.where(wrong)
            reject("MD252", path, f"{layout} is expected on each line", "write the file again", span)

    def whole(self, columns: slice, low: int) -> np.ndarray:
        """Some columns as integers of at least `low`."""
        values = self.table[:, columns]
        bad = ~((values >= low) & (values <= 2**31 - 1) & (values == np.floor(values))).all(axis=1)
        if bad.any():
            span = self.where(int(np.flatnonzero(bad)[0]))
            message = f"whole numbers from {low} are expected as in {self.layout}"
            reject("MD252", self.path, message, "write the file again", span)
        return values.astype(np.int64)

    def where(self, row: int) -> Span:
        """Place of a row of the table."""
        return line_span(self.path, *self.rows[row])

    def _is_row(self, line: str) -> bool:
        try:
            return len(np.array(_words(line), dtype=float)) == self.width
        except ValueError:
            return False


def _words(text: str) -> list[str]:
    return text.replace(",", " ").replace("D", "E").split()
