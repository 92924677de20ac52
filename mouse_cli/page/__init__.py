"""HTML pages of results: reads JSON documents only, never models."""

from mouse_cli.page.markdown import summary
from mouse_cli.page.page import DOCUMENTS, page
from mouse_cli.report.reading import Part, read

__all__ = ["DOCUMENTS", "Part", "page", "read", "summary"]
