"""The loop of Figure 4-1: from a problem to a result."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # what editors and type checkers see; `__getattr__` loads the same when it is asked for
    from mouse_cli.updating.forward import forecast
    from mouse_cli.updating.loop import run

_PUBLIC = {"forecast": "mouse_cli.updating.forward", "run": "mouse_cli.updating.loop"}

__all__ = ["forecast", "run"]


def __getattr__(name: str) -> object:
    """Load a public name when it is first asked for (PEP 562): a part of the package needs the loop seldom."""
    if name not in _PUBLIC:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(_PUBLIC[name]), name)
