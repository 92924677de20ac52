"""What may be wrong with a mesh: one exception each, with the numbers of nodes and elements as the deck names them."""

from dataclasses import dataclass

from mouse_cli.model.geometry import DIRECTIONS


class MeshFault(ValueError):
    """A mesh of which no model can be made. nodes, elements: identifiers that the fault names; help: what to do."""

    help = ""

    def __init__(self, message: str, nodes: tuple[int, ...] = (), elements: tuple[int, ...] = ()):
        super().__init__(message)
        self.nodes, self.elements = nodes, elements


def _list(words: tuple, most: int = 6) -> str:
    return ", ".join(str(w) for w in words[:most]) + (f" and {len(words) - most} more" if len(words) > most else "")


def _plural(one: str, words: tuple) -> str:
    return one if len(words) == 1 else f"{one}s"


def _labels(places: tuple[tuple[int, int], ...]) -> tuple[str, ...]:
    return tuple(f"{node}{DIRECTIONS[d]}" for node, d in places)


class Disconnected(MeshFault):
    """Nodes that no element, link or imported matrix holds."""

    help = "join the nodes to an element, or leave them out"

    def __init__(self, nodes: tuple[int, ...]):
        verb = "is" if len(nodes) == 1 else "are"
        super().__init__(f"{_plural('node', nodes)} {_list(nodes)} {verb} held by no element", nodes)


class ZeroLength(MeshFault):
    """Elements whose ends coincide."""

    help = "move a node, mend an offset, or use a joint or spring, which may have no length"

    def __init__(self, elements: tuple[int, ...], nodes: tuple[int, ...]):
        verb = "has" if len(elements) == 1 else "have"
        super().__init__(f"{_plural('element', elements)} {_list(elements)} {verb} no length", nodes, elements)


class Unoriented(MeshFault):
    """Elements along their own orientation vector."""

    help = "give an `orientation` that is not parallel to the element"

    def __init__(self, elements: tuple[int, ...]):
        super().__init__(
            f"the orientation is parallel to {_plural('element', elements)} {_list(elements)}", (), elements
        )


class Loose(MeshFault):
    """Elements that their releases let move by themselves."""

    help = "keep each local direction at one end at least"

    def __init__(self, elements: tuple[int, ...]):
        super().__init__(
            f"the releases let {_plural('element', elements)} {_list(elements)} move by themselves", (), elements
        )


class Overconstrained(MeshFault):
    """Directions that are held twice: by two links, or by a link and a support. places: (node, direction)."""

    help = "leave the direction to one of them: support the independent node, or take the direction out of a link"

    def __init__(self, places: tuple[tuple[int, int], ...]):
        super().__init__(f"{_list(_labels(places))} is held twice, by links or supports", tuple(n for n, _ in places))
        self.places = places


class LinkLoop(MeshFault):
    """Rigid links that follow one another in a circle."""

    help = "make one node of the group the independent node of all others"

    def __init__(self, nodes: tuple[int, ...]):
        super().__init__(f"rigid links go round in a circle through nodes {_list(nodes)}", nodes)


class Mechanism(MeshFault):
    """Motion inside the structure that nothing resists. places: the (node, direction) that move most."""

    help = "add the stiffness that holds these directions, or a support; a released or unstiffened direction is the usual cause"

    def __init__(self, places: tuple[tuple[int, int], ...]):
        super().__init__(
            f"nothing resists a motion of {_list(_labels(places))}", tuple(dict.fromkeys(n for n, _ in places))
        )
        self.places = places


class NoLoadPath(MeshFault):
    """Weight that gets to no support, or by several ways that the elements do not tell apart."""

    help = "support the structure against gravity, or give axial forces as `preload` and leave `gravity` out"

    def __init__(self, message: str, nodes: tuple[int, ...] = (), elements: tuple[int, ...] = ()):
        super().__init__(message, nodes, elements)


@dataclass(frozen=True)
class Remark:
    """Something to know of a mesh that is no fault. kind: `floating` or `unheld`; places: (node, direction) it names."""

    kind: str
    message: str
    nodes: tuple[int, ...]
    places: tuple[tuple[int, int], ...] = ()


def floating(nodes: tuple[int, ...], modes: int) -> Remark:
    """A part that may move as a rigid body."""
    where = f"the part of {_plural('node', nodes)} {_list(nodes)}"
    return Remark("floating", f"{where} may move as a rigid body in {modes} {_plural('way', (0,) * modes)}", nodes)


def unheld(places: tuple[tuple[int, int], ...]) -> Remark:
    """Directions with mass that no element holds: they are left out of the model."""
    message = f"mass at {_list(_labels(places))} is held by no stiffness; these directions are left out"
    return Remark("unheld", message, tuple(dict.fromkeys(n for n, _ in places)), places)
