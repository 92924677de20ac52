"""The deck in YAML: its keys as data, and the reader, writer, JSON Schema and reference made from them."""

from mouse_cli.formats.yaml_deck.reader import read
from mouse_cli.formats.yaml_deck.writer import write

__all__ = ["read", "write"]
