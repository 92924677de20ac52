"""What a test has revised of a model, in the words of finite-element programs: materials, sections, springs and masses."""

from dataclasses import dataclass

End = tuple[int, int]  # node, and direction from 1 (TX) to 6 (RZ)
GONE = 0.01  # share left of a part below which it is taken out of a job: what is left would move in modes of its own alone
PART_LEFT = "share of element set {} that is left, and of its mass"  # names of parameters that a diagnosis adds
MASS_GAINED, MASS_LOST = "share of element set {} in mass, gained", "share of element set {} in mass, lost"
E_TIMES, DENSITY_TIMES = "E of element set {}, over that of the deck", "density of element set {}, over that of the deck"
STIFFNESS_LOST, STIFFNESS_GAINED = "share lost by element set {}", "share gained by element set {}"
ON_SPRINGS, ON_ALIKE = "stiffness of the support {}", "stiffness of each of {}"  # one support, or several; with two stiffnesses:
ALONG, ACROSS = " along ", " across "  # this direction; all others
E_OF, DENSITY_OF = "E of {}", "density of {}"  # parameters of `mouse import`, by the material
OF_SPRING = "stiffness of {}"  # a parameter of `mouse import`: the constant of an element set of springs
THICKNESS, TO_THE_POWER = "thickness of {}", " to the power {}"  # of shells, by their element set


@dataclass(frozen=True)
class RevisedMaterial:
    """Constants of a material; None: not known. elements: numbers of those made of it, where the deck has them; notes: on them."""

    name: str
    E: float | None = None
    nu: float | None = None
    density: float | None = None
    notes: tuple[str, ...] = ()
    elements: tuple[int, ...] = ()


@dataclass(frozen=True)
class RevisedSection:
    """Constants of a cross section of beams, of the elements that have it."""

    name: str
    A: float
    Iy: float
    Iz: float
    J: float
    notes: tuple[str, ...] = ()
    elements: tuple[int, ...] = ()


@dataclass(frozen=True)
class RevisedSpring:
    """A spring between two directions of nodes, or between one and the ground; number: of its element, where the deck has one."""

    name: str
    ends: tuple[End, ...]
    stiffness: float
    note: str = ""
    number: int | None = None


@dataclass(frozen=True)
class RevisedMass:
    """A point mass, with moments of inertia about X, Y and Z, and products (xy, xz, yz), about axes through it.

    offset: vector from the node to it. number: of its element, where the deck has one.
    """

    name: str
    node: int
    mass: float
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)
    note: str = ""
    products: tuple[float, float, float] = (0.0, 0.0, 0.0)
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    number: int | None = None


@dataclass(frozen=True)
class RevisedSet:
    """An element set: its E is `left` times that of its material, plus `stiffness` times the nominal one; its density likewise.

    constant: of a set of springs, its stiffness now; None: as in the job.
    """

    name: str
    left: float = 1.0
    stiffness: float = 0.0
    mass: float = 0.0
    note: str = ""
    constant: float | None = None


@dataclass(frozen=True)
class RevisedThickness:
    """Of the shells of the section for element set `name`."""

    name: str
    value: float
    note: str = ""


@dataclass(frozen=True)
class RevisedSupport:
    """A support that moves as a rigid body in `directions` (1 to 6) about its centre, on springs of `stiffness` `along` some."""

    name: str
    directions: tuple[int, ...]
    stiffness: float
    note: str = ""
    along: tuple[int, ...] = (1, 2, 3)


@dataclass(frozen=True)
class JobSection:
    """A property of beams in a job: its number, that of its material, mass per length, shares of A that carry shear (0: none).

    turned: whether its axes are not principal ones, which those of the deck are.
    """

    number: int
    material: int
    mass: float = 0.0
    shear: tuple[float, float] = (0.0, 0.0)
    turned: bool = False


@dataclass(frozen=True)
class Job:
    """What the job calls things that the deck has by name: materials and sections by their names; elements: numbers taken.

    weight: a mass of the deck over the number that stands for it in the job (PARAM,WTMASS).
    """

    materials: dict[str, int]
    sections: dict[str, JobSection]
    elements: frozenset[int]
    weight: float = 1.0


@dataclass(frozen=True)
class Revision:
    """All of it. title, source, units: of the deck; first: number from which new elements count; unwritten: what has no card.

    sets, supports, thicknesses: what only a whole job can have. job: numbers of the job that the deck was imported from.
    """

    title: str
    source: str
    units: str
    materials: tuple[RevisedMaterial, ...] = ()
    sections: tuple[RevisedSection, ...] = ()
    springs: tuple[RevisedSpring, ...] = ()
    masses: tuple[RevisedMass, ...] = ()
    sets: tuple[RevisedSet, ...] = ()
    supports: tuple[RevisedSupport, ...] = ()
    thicknesses: tuple[RevisedThickness, ...] = ()
    unwritten: tuple[str, ...] = ()
    first: int = 900001
    job: Job | None = None
