"""mouse: Modal Optimization Using Statistical Evaluators, as a command-line batch tool and a small library."""

from importlib import import_module

__version__ = "0.1.0"

_PUBLIC = {
    "read_deck": "mouse_cli.formats",
    "write_deck": "mouse_cli.formats",
    "run": "mouse_cli.updating",
    "Problem": "mouse_cli.model.problem",
    "Result": "mouse_cli.model.result",
    "DeckError": "mouse_cli._errors",
    "NumericalError": "mouse_cli._errors",
}

__all__ = ["__version__", *_PUBLIC]


def __getattr__(name: str) -> object:
    """Load a public name when it is first asked for (PEP 562), so that `import mouse_cli` costs nothing."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'mouse_cli' has no attribute '{name}'")
    return getattr(import_module(_PUBLIC[name]), name)
