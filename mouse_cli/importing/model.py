"""A model as a solver's input file states it: nodes, elements, sets, materials, sections, supports."""

from dataclasses import dataclass, field

import numpy as np

from mouse_cli._errors import Diagnostic
from mouse_cli.importing.cards import Card, Line

RIGIDITY, HEAVINESS = "stiffness", "mass"


@dataclass
class Material:
    """elastic, density: their cards; E in the units of the file; isotropic: whether E is one number."""

    name: str
    card: Card
    elastic: Card | None = None
    density: Card | None = None

    @property
    def isotropic(self) -> bool:
        """Whether one Young's modulus stands for it."""
        return self.elastic is not None and self.elastic.options.get("TYPE", "ISO") in ("ISO", "ISOTROPIC")

    @property
    def E(self) -> float:
        """Young's modulus, or the first modulus of a material with several."""
        return float(self.elastic.lines[0].words[0])

    @property
    def rho(self) -> float:
        """Density; 0 where none is given."""
        return float(self.density.lines[0].words[0]) if self.density is not None else 0.0


LAYER_MATERIAL, LAYER_ORIENTATION = 2, 3  # words of a line of a layer, behind its thickness and its integration points


def layered(card: Card) -> bool:
    """Whether a section has layers, a line for each."""
    return card.keyword == "SHELL SECTION" and "COMPOSITE" in card.options


def materials_of(card: Card) -> list[str]:
    """The materials that a section names, each once."""
    if not layered(card):
        return [card.options.get("MATERIAL", "")]
    return list(dict.fromkeys(word_at(line, LAYER_MATERIAL).upper() for line in card.lines))


def word_at(line: Line, at: int) -> str:
    """A word of a line of data (from 0); empty beyond the last."""
    return line.words[at].strip('"') if at < len(line.words) else ""


@dataclass
class Support:
    """dofs: (node, direction 1 to 6) that a boundary condition holds, under the name of its node set."""

    name: str
    dofs: list[tuple[int, int]]
    card: Card


@dataclass
class Group:
    """Elements (numbers) that share section, material and sets; owner: the section, *MASS or *SPRING of their properties.

    Of a laminate, the layers of that material: groups of its other materials have the same elements.
    """

    name: str
    elements: list[int]
    owner: Card
    material: Material | None

    @property
    def shell(self) -> bool:
        """Whether its elements have one thickness."""
        return self.owner.keyword == "SHELL SECTION" and not self.laminate

    @property
    def constant(self) -> float:
        """Of springs, their stiffness: the first number behind the directions, which SPRINGA has none of."""
        return float(self.owner.lines[min(1, len(self.owner.lines) - 1)].words[0].upper().replace("D", "E"))

    @property
    def laminate(self) -> bool:
        """Whether its elements have layers."""
        return layered(self.owner)


@dataclass(frozen=True)
class Clamp:
    """A node of shells whose rotations are held: axis (0 to 2) of their normal, half of the thickness along it, with its sign."""

    axis: int
    half: float


@dataclass
class InputModel:
    """nodes: coordinates by number; elements: type and nodes by number; kept: the cards of the model, without steps and supports.

    every: all cards of the file, included files in their place. ignored: keywords without effect on K and M, and how often.
    turned: axes (3, 3), in columns, of nodes whose supports and equations are in directions of their own (*TRANSFORM).
    own_axes: of those that are held in some of these directions: their degrees of freedom have them.
    """

    path: str
    every: list[Card] = field(default_factory=list)
    kept: list[Card] = field(default_factory=list)
    nodes: dict[int, np.ndarray] = field(default_factory=dict)
    elements: dict[int, tuple[str, tuple[int, ...]]] = field(default_factory=dict)
    nsets: dict[str, list[int]] = field(default_factory=dict)
    elsets: dict[str, list[int]] = field(default_factory=dict)
    materials: dict[str, Material] = field(default_factory=dict)
    supports: list[Support] = field(default_factory=list)
    groups: list[Group] = field(default_factory=list)
    ignored: dict[str, int] = field(default_factory=dict)
    remarks: list[Diagnostic] = field(default_factory=list)
    turned: dict[int, np.ndarray] = field(default_factory=dict)
    own_axes: dict[int, np.ndarray] = field(default_factory=dict)
    clamps: dict[int, Clamp] = field(default_factory=dict)

    @property
    def own(self) -> dict[int, Clamp | None]:
        """The nodes, and how shells stand at those whose rotations are held."""
        return dict.fromkeys(self.nodes) | self.clamps

    @property
    def known(self) -> tuple[dict[int, Clamp | None], frozenset[int], dict[int, int], dict[int, np.ndarray]]:
        """What tells the rows of the solver: `own`, `pointed`, `layers` and `own_axes`."""
        return self.own, self.pointed, self.layers, self.own_axes

    @property
    def layers(self) -> dict[int, int]:
        """Nodes through the thickness that the solver makes of a node of shells: three at corners of quadratic ones, else two."""
        from mouse_cli.importing.keywords import SHELLS

        found: dict[int, int] = {}
        for kind, nodes in self.elements.values():
            corners = SHELLS.get(kind, 0)
            for k, node in enumerate(nodes if corners else ()):
                found[node] = max(found.get(node, 2), 3 if k < corners < len(nodes) else 2)
        return found

    @property
    def pointed(self) -> frozenset[int]:
        """Nodes at which springs, masses or equations act: in the solver they have rows of their own beside those of solids."""
        points = [each for kind, each in self.elements.values() if kind.startswith(("SPRING", "MASS"))]
        lines = (line for card in self.kept if card.keyword == "EQUATION" for line in card.lines)
        words = (word for line in lines for word in line.words[::3])
        return frozenset({n for each in points for n in each} | {int(word) for word in words if word.isdigit()})

    @property
    def expanded(self) -> bool:
        """Whether some elements are made solids of by CalculiX."""
        from mouse_cli.importing.keywords import expanded

        return any(expanded(kind) for kind, _ in self.elements.values())
