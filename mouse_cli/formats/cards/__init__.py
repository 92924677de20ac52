"""The punched card deck of 1972: layout as data, and the reader, writer, manual and display made from it."""

from mouse_cli.formats.cards.reader import read, read_all, trace

__all__ = ["read", "read_all", "trace"]
