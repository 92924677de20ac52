"""mouse: Modal Optimization Using Statistical Evaluators, as a command-line batch tool and a small library."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # what editors and type checkers see; `__getattr__` loads the same when it is asked for
    from mouse_cli._errors import DeckError, NumericalError
    from mouse_cli.diagnosis import diagnose
    from mouse_cli.formats import read_deck, write_deck
    from mouse_cli.model.problem import Problem
    from mouse_cli.model.result import Result
    from mouse_cli.report import written
    from mouse_cli.report.answers import document
    from mouse_cli.report.dataset import dataset
    from mouse_cli.report.frames import frames
    from mouse_cli.updating import run

__version__ = "0.1.0"

_PUBLIC = {
    "read_deck": "mouse_cli.formats",
    "write_deck": "mouse_cli.formats",
    "run": "mouse_cli.updating",
    "diagnose": "mouse_cli.diagnosis",
    "document": "mouse_cli.report.answers",
    "written": "mouse_cli.report",
    "frames": "mouse_cli.report.frames",
    "dataset": "mouse_cli.report.dataset",
    "Problem": "mouse_cli.model.problem",
    "Result": "mouse_cli.model.result",
    "DeckError": "mouse_cli._errors",
    "NumericalError": "mouse_cli._errors",
}

__all__ = [
    "DeckError", "NumericalError", "Problem", "Result", "__version__", "dataset", "diagnose", "document", "frames", "read_deck",
    "run", "write_deck", "written",
]  # fmt: skip


def __getattr__(name: str) -> object:
    """Load a public name when it is first asked for (PEP 562), so that `import mouse_cli` costs nothing."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'mouse_cli' has no attribute '{name}'")
    return getattr(import_module(_PUBLIC[name]), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PUBLIC})
