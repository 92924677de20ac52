"""Documents of answers as pages to look at: reads JSON documents only, never models."""

from mouse_cli.page.document import Part, read
from mouse_cli.page.page import page

__all__ = ["Part", "page", "read"]
