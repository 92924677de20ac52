"""Springs and point masses as bricks: CalculiX stops at elements of either beside laminates, and not at solids."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.formats.solver_cards import head, tag
from mouse_cli.importing.jobs import real
from mouse_cli.importing.model import InputModel
from mouse_cli.model.revision import Revision

_SIZE = 0.01  # of the structure: side of a brick, of no account to its stiffness and mass
_CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])


def brick_lines(model: InputModel, revision: Revision, first: int) -> Iterator[str]:
    """A brick, C3D8 of side L, for each spring and mass of a revision; first: number of the first new node.

    A spring along d: E = k / L without lateral contraction; the face beyond d moves along it as the one end does, the other as the
    other end, or not at all, and nothing moves across d. A mass: density m / L^3, all corners move as its node does.
    """
    yield from head(revision, "**")
    used, element = set(model.elsets) | set(model.materials), revision.first
    side = _SIZE * float(np.ptp(np.array(list(model.nodes.values())), axis=0).max())
    for spring in revision.springs:
        held, ties = [], []
        far = _CORNERS[:, spring.ends[0][1] - 1] == 1
        for corner, beyond in enumerate(far.tolist()):
            end = spring.ends[0] if beyond else (*spring.ends, None)[1]
            held += [(corner, d) for d in (1, 2, 3) if end is None or d != spring.ends[0][1]]
            ties += [(corner, spring.ends[0][1], end)] if end is not None else []
        yield f"** {spring.name}: {spring.note}"
        constants = real(spring.stiffness / side), "0.0"
        yield from _brick(model, tag(spring.name, used), element, first, spring.ends[0][0], side, constants, ties, held)
        element, first = element + 1, first + len(_CORNERS)
    for mass in revision.masses:
        ties = [(corner, d, (mass.node, d)) for corner in range(len(_CORNERS)) for d in (1, 2, 3)]
        yield f"** {mass.name}: {mass.note}"
        if any(mass.inertia):
            yield f"** not written: moments of inertia {', '.join(map(real, mass.inertia))}"
        constants = "1.0", real(mass.mass / side**3)
        yield from _brick(model, tag(mass.name, used), element, first, mass.node, side, constants, ties, [])
        element, first = element + 1, first + len(_CORNERS)


def _brick(
    model: InputModel,
    name: str,
    element: int,
    first: int,
    node: int,
    side: float,
    constants: tuple[str, str],
    ties: list,
    held: list,
) -> Iterator[str]:
    """constants: E and density; ties: corner, direction, and the node and direction that it follows; held: corner, direction."""
    E, density = constants
    origin = model.nodes.get(node, np.zeros(3))
    yield "*NODE"
    for k, corner in enumerate(_CORNERS):
        yield f"{first + k}, {', '.join(map(real, (origin + side * corner).tolist()))}"
    yield f"*ELEMENT, TYPE=C3D8, ELSET={name}"
    yield ", ".join(map(str, (element, *range(first, first + len(_CORNERS)))))
    yield from (f"*MATERIAL, NAME={name}", "*ELASTIC", f"{E}, 0.0", "*DENSITY", density)
    yield f"*SOLID SECTION, ELSET={name}, MATERIAL={name}"
    for corner, d, (other, along) in ties:
        yield from ("*EQUATION", "2", f"{first + corner}, {d}, 1.0, {other}, {along}, -1.0")
    if held:
        yield from ("*BOUNDARY", *(f"{first + corner}, {d}, {d}" for corner, d in held))
