"""The loop of Figure 4-1: from a problem to a result."""

from mouse_cli.updating.forward import forecast
from mouse_cli.updating.loop import run

__all__ = ["forecast", "run"]
