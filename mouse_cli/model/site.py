"""Where physics acts."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import dist


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


def as_read(sites: Iterable[Site]) -> tuple[tuple[str, str, str], ...]:
    """What is the same of sites that read alike, in whatever order, however little their positions differ."""
    return tuple(sorted((site.kind, str(site.ids), site.text) for site in sites))


def gap(one: Site, other: Site) -> float:
    """Distance between two sites in m; 0 where they are the same, and infinite where two have no one place, or join other nodes.

    What is spread over elements, as a bed is, has no one place: it is where any of them are.
    """
    if one.kind == other.kind == "element" and (one.position is None or other.position is None):
        return 0.0 if set(one.ids) & set(other.ids) else float("inf")
    joining = one.kind == other.kind == "node" and max(len(one.ids), len(other.ids)) > 1
    if joining or one.position is None or other.position is None:
        return 0.0 if (one.kind, one.ids) == (other.kind, other.ids) else float("inf")
    return dist(one.position, other.position)
