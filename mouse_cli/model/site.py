"""Where physics acts."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Site:
    """Where a mechanism acts. kind: `structure`, `node`, `element`, `dof` or `sensor`; ids as the deck names them.

    position (3,): coordinates in m where it is one point; text: in words, such as `element 12, 0.43 of its length`.
    """

    kind: str
    ids: tuple[int | str, ...] = ()
    position: tuple[float, float, float] | None = None
    text: str = ""


EVERYWHERE = Site("structure", text="the whole structure")
