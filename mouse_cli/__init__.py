"""mouse: Modal Optimization Using Statistical Evaluators, as a command-line batch tool and a small library."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # what editors and type checkers see; `__getattr__` loads the same when it is asked for
    from mouse_cli._errors import DeckError, NumericalError
    from mouse_cli.api.campaigns import sweep
    from mouse_cli.api.measured import identify, read_frf, read_recording, spectra
    from mouse_cli.api.structures import couple, modify
    from mouse_cli.diagnosis.diagnose import diagnose
    from mouse_cli.formats import read_deck, write_deck
    from mouse_cli.methods.update import compare
    from mouse_cli.model.problem import Problem
    from mouse_cli.model.result import Result
    from mouse_cli.report import written
    from mouse_cli.report.answers import document
    from mouse_cli.report.dataset import dataset
    from mouse_cli.report.frames import frames
    from mouse_cli.updating.correlate import correlate
    from mouse_cli.updating.forward import forecast as modes
    from mouse_cli.updating.loop import run

__version__ = "0.1.0"

_PUBLIC = {  # name: module, or module:name there
    "read_deck": "mouse_cli.formats",
    "read_recording": "mouse_cli.api.measured",
    "read_frf": "mouse_cli.api.measured",
    "write_deck": "mouse_cli.formats",
    "run": "mouse_cli.updating",
    "diagnose": "mouse_cli.diagnosis",
    "correlate": "mouse_cli.updating.correlate",
    "compare": "mouse_cli.methods.update",
    "modes": "mouse_cli.updating.forward:forecast",
    "spectra": "mouse_cli.api.measured",
    "identify": "mouse_cli.api.measured",
    "sweep": "mouse_cli.api.campaigns",
    "couple": "mouse_cli.api.structures",
    "modify": "mouse_cli.api.structures",
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
    "DeckError", "NumericalError", "Problem", "Result", "__version__", "compare", "correlate", "couple", "dataset",
    "diagnose", "document", "frames", "identify", "modes", "modify", "read_deck", "read_frf", "read_recording", "run", "spectra",
    "sweep", "write_deck", "written",
]  # fmt: skip


def __getattr__(name: str) -> object:
    """Load a public name when it is first asked for (PEP 562), so that `import mouse_cli` costs nothing."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'mouse_cli' has no attribute '{name}'")
    module, _, own = _PUBLIC[name].partition(":")
    return getattr(import_module(module), own or name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PUBLIC})
