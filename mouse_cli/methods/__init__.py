"""Methods of updating: one file, one method; from modes measured and expanded to a stiffness matrix, or to properties.

Siblings of the estimators: those weigh data and prior within one loop; these are the methods that the lectures compare with it.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mouse_cli import _registry
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.model.updated import ASPECTS, About, Guarantee

OWN, SHAPES, FUNCTIONS, ELEMENTS, PARAMETERS = "modes", "shapes", "functions", "elements", "parameters"


@dataclass(frozen=True)
class Method:
    """A method: `update` turns what is given into what it found. Raises NumericalError where there is no answer.

    needs: what of OWN (measured modes), SHAPES (all of them with shapes), FUNCTIONS, ELEMENTS (beams with a generic stiffness)
    and PARAMETERS a deck must have. guarantees: (KEPT, LOST or PARTLY, why) for each of ASPECTS. dense: its K has no zeros left.
    """

    key: str
    title: str
    equation: str
    source: str
    guarantees: tuple[tuple[str, str], ...]
    needs: tuple[str, ...]
    update: Callable[[Given], Found]
    dense: bool = False

    @property
    def about(self) -> About:
        """The method as reports name it."""
        guarantees = (Guarantee(aspect, *rest) for aspect, rest in zip(ASPECTS, self.guarantees, strict=True))
        return About(self.key, self.title, self.equation, self.source, tuple(guarantees))


def registry() -> dict[str, Method]:
    """All methods by key."""
    return _registry.discover(__name__, "METHOD")


def method(key: str) -> Method:
    """The method called `key`. Raises ValueError that lists the known ones."""
    return _registry.member(__name__, "METHOD", key, "method")
