"""Answers that show themselves where they are the last line of a notebook's cell."""


class Shown:
    """Base of all kinds of answers."""

    def _repr_markdown_(self) -> str:
        """Verdict and results, as `--markdown` prints them (the protocol of IPython's rich display)."""
        import mouse_cli

        return mouse_cli.written(self, "markdown", short=True)
