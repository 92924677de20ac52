"""Rivals without a name: random changes of the model that compete, by evidence, with every mechanism that has one.

One module = one rival, found by `registry`: of what it is a change, and its cells, the parts of the structure that it changes.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless._cells import Cells


@dataclass(frozen=True)
class Nameless:
    """key; title: in words; property: STIFFNESS, MASS, BED, FORCE, COMPLIANCE or LAW; meaning: what it is, for the manual.

    cells(model): what it changes; None where there are fewer than three. spreads: sd of the field that are integrated over.
    signs: of a change of rank one along the field (`_tied`), 1 a spring, -1 a compliance; empty: K or M change in proportion to
    it. even: group of the mechanism that it is where it is the same everywhere, moves the whole as one rigid body, or acts between
    its places; empty: none has a name. gradient: likewise where it is a constant and a slope along one straight row.
    parts: how many of the registry it is together.
    """

    key: str
    title: str
    property: str
    meaning: str
    spreads: tuple[float, ...]
    cells: Callable[[Reduced], Cells | None]
    signs: tuple[int, ...] = ()
    even: str = ""
    gradient: str = ""
    parts: int = 1


def registry() -> dict[str, Nameless]:
    """All rivals by key."""
    return _registry.discover(__name__, "NAMELESS")
