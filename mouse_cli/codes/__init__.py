"""Catalogue of diagnostic codes: what each means and what to do; one file per range, read by `mouse explain` and the docs."""

from dataclasses import dataclass

from mouse_cli import _registry


@dataclass(frozen=True, slots=True)
class Code:
    """What a diagnostic code means, at more length than its message, and the remedy."""

    title: str
    meaning: str
    remedy: str


def catalogue() -> dict[str, Code]:
    """Every code, sorted. Raises ValueError when two files claim one code."""
    import importlib

    codes: dict[str, Code] = {}
    for name in _registry.names(__name__):
        for code, entry in importlib.import_module(f"{__name__}.{name}").CODES.items():
            if code in codes:
                raise ValueError(f"code {code} is defined twice")
            codes[code] = entry
    return dict(sorted(codes.items()))
