"""Text files of numbers in columns: read at once, and the faulty line named."""

import numpy as np

from mouse_cli._span import Span
from mouse_cli.formats.data_files import line_span, reject, text_lines


class Columns:
    """The numbers (rows, width) of a text file; blanks or commas part them, lines that begin with `comment` are passed over."""

    def __init__(self, path: str, width: int, layout: str, comment: str):
        self.path, self.width, self.layout, self.comment = path, width, layout, comment
        self.lines = text_lines(path)
        rows = [line for line in self.lines if line.strip() and not line.startswith(comment)]
        if not rows:
            reject("MD252", path, "the file holds no numbers", f"give {layout} on each line")
        words = " ".join(rows).replace(",", " ").replace("D", "E").split()
        try:
            self.table = np.array(words, dtype=float).reshape(len(rows), width)
        except ValueError:
            self._fault(f"{layout} is expected on each line")

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
        numbered = (
            (i, line) for i, line in enumerate(self.lines, 1) if line.strip() and not line.startswith(self.comment)
        )
        number, line = next(pair for k, pair in enumerate(numbered) if k == row)
        return line_span(self.path, number, line)

    def _fault(self, message: str) -> None:
        """Name the first line that is not `width` numbers."""
        for number, line in enumerate(self.lines, 1):
            if line.strip() and not line.startswith(self.comment) and not self._is_row(line):
                reject("MD252", self.path, message, "write the file again", line_span(self.path, number, line))
        reject("MD252", self.path, message, "write the file again")

    def _is_row(self, line: str) -> bool:
        words = line.replace(",", " ").replace("D", "E").split()
        try:
            return len(np.array(words, dtype=float)) == self.width
        except ValueError:
            return False
