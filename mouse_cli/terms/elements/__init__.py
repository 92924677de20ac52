"""Element library: one module = one type of element, found by `registry`; each is one function from properties to matrices."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mouse_cli import _registry


@dataclass(frozen=True)
class Property:
    """A number that elements of a type have: meaning, unit, default (None: it must be given), and whether it must be positive."""

    meaning: str
    unit: str
    default: float | None = None
    positive: bool = False


@dataclass(frozen=True)
class Option:
    """What is no number to revise: meaning, default, and the words it may be (none: free, such as a vector)."""

    meaning: str
    default: Any = None
    choices: tuple[str, ...] = ()


@dataclass(frozen=True)
class Layout:
    """Where e elements of k nodes each are: coordinates (e, k, 3) in m, and the options of their set."""

    coordinates: np.ndarray
    options: dict[str, Any] = field(default_factory=dict)


Properties = dict[str, np.ndarray]  # (e,) each; complex where a derivative is taken
Matrices = dict[
    str, np.ndarray
]  # K, M, C, D as far as they are there: (e, 6 k, 6 k), global axes, node by node, TX..RZ


@dataclass(frozen=True)
class ElementType:
    """A type of element. nodes: how many nodes it may have.

    `matrices(layout, properties)` must be made of operations that carry complex numbers through (no abs, max, comparisons of
    property values): derivatives by a property are taken by complex steps, exact to rounding (Squire and Trapp 1998).
    """

    key: str
    meaning: str
    nodes: tuple[int, ...]
    properties: dict[str, Property]
    matrices: Callable[[Layout, Properties], Matrices]
    options: dict[str, Option] = field(default_factory=dict)


def registry() -> dict[str, ElementType]:
    """All element types by key."""
    return _registry.discover(__name__, "ELEMENT")
