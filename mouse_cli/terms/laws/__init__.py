"""Laws of local forces: one module = one law, found by `registry`; each acts on one relative motion x of the structure."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mouse_cli import _registry
from mouse_cli.model.unknown import Unknown

SIGNS = ({"sign": 1.0}, {"sign": -1.0})
PLAIN = ({},)
UNSEEN = 0.5  # sd of the logarithm of a size from which on 0 or infinity is within two of them


@dataclass(frozen=True)
class Scale:
    """What a motion is like in a record: force over motion (elastic, or of inertia where nothing holds it) and mass of the
    structure against it, rms of x and of its velocity.

    band: lowest and highest frequency in the record, Hz. stiffest: contact that steps of a simulation can follow, 2 m / h^2.
    inertia: rms of the force that accelerates the mass, N: of bodies that move together it is far below stiffness times motion.
    link: stiffness, N/m, of the spring that the model has there; 0 where it has none. least: some times force over motion of the
    structure as a whole, which bends where `stiffness` holds all else still; most: mass of the mode that moves there most. A node
    of a fine mesh is much stiffer and lighter than the structure; None: as stiff and as heavy.
    """

    stiffness: float
    mass: float
    x: float
    v: float
    band: tuple[float, float]
    stiffest: float = 0.0
    inertia: float = np.inf
    link: float = 0.0
    least: float | None = None
    most: float | None = None

    @property
    def softest(self) -> float:
        """N/m from which on what acts there is measured against the structure as a whole."""
        return self.stiffness if self.least is None else self.least

    @property
    def heaviest(self) -> float:
        """Mass, kg, of the mode that moves there most."""
        return self.mass if self.most is None else self.most

    @property
    def forces(self) -> tuple[float, float]:
        """The smallest and the largest force, N, that the motion may stand for."""
        elastic = self.stiffness * self.x
        return min(elastic, self.inertia), elastic


_ANY = Scale(1.0, 1.0, 1.0, 1.0, (1.0, 1.0), link=1.0)  # where ranges do not matter


@dataclass(frozen=True)
class Law:
    """A law of one relative motion x.

    force(x, v, z, p, **variant) -> (F, z): force against the motion and internal states after it, for arrays of any shape and
    parameters p (q, ...) that broadcast with them; z (states, ...): None where there is none. matrices(p) -> K, C, M (1 + a, 1 + a)
    instead, for linear laws, on x and a coordinates of their own. unknowns(scale): parameters. variants: signs and sides, told
    apart as words. homogeneous: indices of parameters with which F grows in proportion. grid: values of each other parameter
    that a first search tries. implicit(v, F before, free, drop, p) -> F, F at the end: of a step, for a law whose force jumps
    with the velocity, see dynamics.response.Implicit. prepare(p): what `force` takes in place of p and depends on p alone, where it
    costs more than a step. at: `anywhere`, `ground` where it acts only between a point and the ground, `link` where the model has a
    spring, `plane` between two directions of one body, or `body` along all that it translates by. limit: index of the unknown that
    a record must show, and the group of what the law is where it does not. motions: how many it couples, the first rows of
    `matrices`. linked: indices of variants that take from a spring which the model has, and no more than all of it. amounts: keys
    of laws, and variants, that at its place make another law of it, and the key of that. massless: whether a coordinate of its
    own has no mass. solitary: whether it acts beside no other linear law: together they would stand for what none of them is.
    """

    key: str
    group: str
    title: str
    meaning: str
    unknowns: Callable[[Scale], tuple[Unknown, ...]]
    force: Callable | None = None
    matrices: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]] | None = None
    variants: tuple[dict[str, float], ...] = PLAIN
    words: tuple[str, ...] = ("",)
    homogeneous: tuple[int, ...] = (0,)
    grid: int | tuple[int, ...] = 12
    states: int = 0
    at: str = "anywhere"
    odd: bool = True
    implicit: Callable | None = None
    limit: tuple[int, str] | None = None
    motions: int = 1
    prepare: Callable | None = None
    linked: tuple[int, ...] = ()
    amounts: tuple[tuple[str, int, str], ...] = ()
    massless: bool = False
    solitary: bool = False

    def variants_at(self, scale: Scale) -> list[int]:
        """Indices of the variants that can act in a motion of that scale."""
        return [i for i in range(len(self.variants)) if i not in self.linked or scale.link > 0]

    def along(self, p: np.ndarray, words: dict[str, float]) -> Callable:
        """Its force(x, v, z) -> (F, z) at parameters p for many steps."""
        held = p if self.prepare is None else self.prepare(p)
        return lambda x, v, z: self.force(x, v, z, held, **words)

    def on(self, count: int, p: np.ndarray, words: dict[str, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, C, M on so many motions, and on coordinates of its own: a law of one acts along each of them alike."""
        own = self.matrices(p, **words)
        return own if count == self.motions else tuple(np.kron(np.eye(count), one) for one in own)

    def seen_as(self, log_sd: np.ndarray) -> str:
        """Its group where its unknowns are known to those sd (q,) of their logarithms; that of its limit where one is not seen."""
        return self.group if self.limit is None or log_sd[self.limit[0]] < UNSEEN else self.limit[1]

    @property
    def linear(self) -> bool:
        """Whether superposition holds."""
        return self.force is None

    @property
    def listed(self) -> bool:
        """Whether a deck states it under `laws`: symmetric matrices do not hold it, or need a point without mass."""
        return not self.linear or self.motions > 1 or self.massless

    @property
    def parameters(self) -> tuple[Unknown, ...]:
        """Its parameters, where their ranges do not matter."""
        return self.unknowns(_ANY)

    @property
    def sizes(self) -> dict[str, str]:
        """Their names by how a deck calls them."""
        return {size.key: size.name for size in self.parameters}

    def inner(self, scale: Scale) -> Iterator[np.ndarray]:
        """Parameters (q,) of a first search: the homogeneous ones such that the first of them is 1."""
        unknowns = self.unknowns(scale)
        free = [i for i in range(len(unknowns)) if i not in self.homogeneous[:1]]
        counts = self.grid if isinstance(self.grid, tuple) else (self.grid,) * len(free)
        axes = [np.geomspace(*self._range(unknowns, i), count) for i, count in zip(free, counts, strict=True)]
        for values in np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(free)) if free else [[]]:
            p = np.ones(len(unknowns))
            p[free] = values
            yield p

    def _range(self, unknowns: tuple[Unknown, ...], i: int) -> tuple[float, float]:
        """Of parameter i; of its ratio to the first homogeneous one when it is homogeneous too."""
        own = unknowns[i]
        if i not in self.homogeneous:
            return own.lower, own.upper
        first = unknowns[self.homogeneous[0]]
        middle = np.sqrt(own.lower * own.upper / first.lower / first.upper)
        reach = np.sqrt(own.upper / own.lower)
        return middle / reach, middle * reach

    def scaled(self, p: np.ndarray, factor: float) -> np.ndarray:
        """Parameters with which the force is `factor` times as large."""
        found = np.array(p, float)
        found[list(self.homogeneous)] *= factor
        return found


def registry() -> dict[str, Law]:
    """All laws by key."""
    return _registry.discover(__name__, "LAW")
