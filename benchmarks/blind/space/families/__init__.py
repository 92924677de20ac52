"""Families of cases, one file each: `cases(split, seed, count)` makes them."""

from collections.abc import Callable, Iterator
from importlib import import_module
from pkgutil import iter_modules

from benchmarks.blind.case import Case


def families() -> dict[str, Callable[[str, int, int], Iterator[Case]]]:
    """What makes the cases of each family, by its name."""
    names = sorted(found.name for found in iter_modules(__path__))
    return {name: import_module(f"{__name__}.{name}").cases for name in names}
