"""Answers as documents: of what was just found, or read again from a file."""

import os
from importlib import import_module
from typing import Any

from mouse_cli import _registry, report
from mouse_cli.formats import file_bytes
from mouse_cli.report.kinds import KINDS
from mouse_cli.report.reading import read

_CONSTANTS = ("SCHEMA", "COMPARISON")


def document(answer: Any) -> dict[str, Any]:
    """An answer in plain Python values, as `--json` writes it: what `run` or `diagnose` found, or the name of a file of JSON.

    Of a file that `mouse batch` wrote it is the answer of the job. Raises DeckError (MD250, MD920, MD921) where the file is no
    document of mouse, and TypeError for what is no answer.

    >>> import mouse_cli
    >>> told = mouse_cli.document(mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml")))
    >>> told["schema"], told["status"], round(told["parameters"][0]["posterior"], 1)
    ('mouse.result/1', 'converged', 1105.4)
    """
    if isinstance(answer, str | os.PathLike):
        path = os.fspath(answer)
        return read(file_bytes(path), path, schemas()).values
    if isinstance(answer, dict):
        return answer
    if type(answer).__name__ not in KINDS:
        raise TypeError(f"{type(answer).__name__} is no answer of mouse, and no name of a file that holds one")
    return report.document(answer)


def schemas() -> tuple[str, ...]:
    """The schemas of all kinds of answers."""
    names = [name for name in _registry.names(report.__name__) if name.endswith("_document")]
    modules = [import_module(f"{report.__name__}.{name}") for name in names]
    return tuple(sorted({vars(module)[each] for module in modules for each in _CONSTANTS if each in vars(module)}))
