"""Steel frames in space: two or three bays by one to three, two to five storeys, members of hollow sections, masses on floors."""

from dataclasses import dataclass

import numpy as np

from benchmarks.blind.case import ALTERED, DENSITY_SPREAD, E_SPREAD, Case, near
from benchmarks.blind.space.opensees import make, modes
from benchmarks.blind.test_data import Config

E, NU, DENSITY = 2.1e11, 0.3, 7850.0
FEWEST, MOST = 60, 150  # members
KEPT, FITTED = 10, 8  # modes measured, and of them fitted
# Chi-square by which a cause must move the data: with less, one of a hundred members is nobody's to name
VISIBLE = 200.0
_RETUNED = 20  # modes of the sound frame among which those of the other are sought


@dataclass(frozen=True)
class Frame:
    """points (n, 3) in m; members (m, 2): nodes; section (m,): 0 columns, 1 beams; sections (2, 3): A, I, J; kg (n,) on nodes."""

    points: np.ndarray
    members: np.ndarray
    section: np.ndarray
    sections: np.ndarray
    kg: np.ndarray

    @property
    def feet(self) -> list[int]:
        """Nodes on the ground."""
        return np.flatnonzero(self.points[:, 2] == 0).tolist()

    @property
    def span(self) -> float:
        """Its largest dimension."""
        return float(np.ptp(self.points, axis=0).max())

    def middle(self, member: int) -> tuple[float, ...]:
        """The middle of a member."""
        return tuple(self.points[self.members[member]].mean(axis=0).tolist())

    def inputs(self, rng: np.random.Generator) -> dict:
        """What OpenSees needs of the sound structure, which differs a little from its deck; causes are put into it."""
        weight = self.kg.sum() + DENSITY * (self.sections[self.section, 0] * self.lengths).sum()
        top = int(np.argmax(self.points @ [1.0, 1.0, 100.0]))
        return {
            "space": 1, "points": self.points.tolist(), "members": self.members.tolist(), "section": self.section.tolist(),
            "sections": self.sections.tolist(), "E": near(rng, E, E_SPREAD), "nu": NU,
            "density": near(rng, DENSITY, DENSITY_SPREAD), "kg": self.kg.tolist(), "factors": {}, "feet": self.feet,
            "springs": [], "struts": [], "masses": [], "added": [top, float(ALTERED * weight)], "count": KEPT,
        }  # fmt: skip

    @property
    def lengths(self) -> np.ndarray:
        """Lengths (m,) of the members."""
        return np.linalg.norm(np.diff(self.points[self.members], axis=1)[:, 0], axis=1)


def drawn(rng: np.random.Generator) -> Frame:
    """A frame of FEWEST to MOST members."""
    while True:
        bays, storeys = rng.integers([2, 1], [4, 4]), int(rng.integers(2, 6))
        if FEWEST <= _count(*bays.tolist(), storeys) <= MOST:
            break
    xs, ys = (np.concatenate([[0.0], np.cumsum(np.round(rng.uniform(3.5, 7.0, n), 1))]) for n in bays)
    zs = np.concatenate([[0.0], np.cumsum(np.round(rng.uniform(2.8, 4.2, storeys), 1))])
    place = {(i, j, k): n for n, (k, j, i) in enumerate(np.ndindex(len(zs), len(ys), len(xs)))}
    points = np.array([[xs[i], ys[j], zs[k]] for i, j, k in place])
    steps = [((0, 0, 1), 0), ((1, 0, 0), 1), ((0, 1, 0), 1)]
    found = [
        (n, place[other], s)
        for step, s in steps
        for at, n in place.items()
        if (other := tuple(np.add(at, step).tolist())) in place and (at[2] > 0 or s == 0)
    ]
    members = np.array(found)
    widths = rng.uniform([0.18, 0.16], [0.30, 0.24])
    walls = np.round(widths * rng.uniform(0.03, 0.05, 2), 4)
    kg = np.where(points[:, 2] > 0, np.round(rng.uniform(1000, 4000) * rng.uniform(0.8, 1.25, len(points)), 0), 0.0)
    return Frame(points, members[:, :2], members[:, 2], _hollow(np.round(widths, 3), walls), kg)


def _count(x: int, y: int, storeys: int) -> int:
    """Members of x by y bays."""
    return storeys * ((x + 1) * (y + 1) + x * (y + 1) + y * (x + 1))


def _hollow(width: np.ndarray, wall: np.ndarray) -> np.ndarray:
    """A, I and J (2, 3) of square hollow sections; J after Bredt."""
    inner, mean = width - 2 * wall, width - wall
    return np.column_stack([width**2 - inner**2, (width**4 - inner**4) / 12, mean**3 * wall])


def quality(rng: np.random.Generator) -> Config:
    """8 to 30 sensors; frequencies to 0.1 to 0.5 %, shapes to 1 to 3 %."""
    sensors = int(rng.integers(8, 31))
    return Config(sensors, round(float(rng.uniform(1e-3, 5e-3)), 4), round(float(rng.uniform(0.01, 0.03)), 3), FITTED)


def visible(inputs: dict, sound: dict, config: Config) -> bool:
    """Whether a cause moves the fitted modes by a chi-square of VISIBLE at least, E of all members and masses refitted."""
    own, other = modes(inputs, FITTED), modes(sound, _RETUNED)
    sites = np.linspace(0, own[1].shape[1] - 1, config.sensors).astype(int)
    a, b = (found[1][:, sites] for found in (own, other))
    a, b = (each / np.linalg.norm(each, axis=1)[:, None] for each in (a, b))
    alike = np.abs(a @ b.T)
    paired = alike.argmax(axis=1)
    shift = np.log(own[0]) - np.log(other[0][paired])
    shape = config.shape_sd * np.abs(a).max(axis=1)
    return bool(
        (((shift - shift.mean()) / config.frequency_sd) ** 2).sum() + ((1 - alike.max(axis=1) ** 2) / shape**2).sum()
        > VISIBLE
    )


def case(family: str, number: int, frame: Frame, inputs: dict, config: Config, truth: str, **about) -> Case:
    """A case of `family`; about: `groups`, `places` and what else a Case has."""
    free = np.flatnonzero(frame.points[:, 2] > 0)
    return Case(
        name=f"space-{family}-{number}",
        kind="space",
        truth=truth,
        inputs=inputs,
        make=make,
        model=deck(frame),
        sites=tuple(f"{n + 1}T{d}" for n in free for d in "XYZ"),
        numbers=tuple(range(1, KEPT + 1)),
        altered=f"{{{inputs['added'][0] + 1}: {inputs['added'][1]:.8g}}}",
        span=frame.span,
        choices=tuple(3 * i + d for i in range(len(free)) for d in (0, 1)),
        config=config,
        **about,
    )


def deck(frame: Frame) -> str:
    """The model of the deck, an element a member, and its parameters."""
    names = ("column", "beam")
    nodes = [f"      - {{{n}: [{x:.9g}, {y:.9g}, {z:.9g}]}}" for n, (x, y, z) in enumerate(frame.points.tolist(), 1)]
    sections = ", ".join(
        f"{name}: {{A: {A:.8g}, Iy: {I:.8g}, Iz: {I:.8g}, J: {J:.8g}}}"
        for name, (A, I, J) in zip(names, frame.sections.tolist(), strict=True)
    )
    elements = [
        f"      - {{id: {n}, type: beam, nodes: [{a + 1}, {b + 1}], material: steel, section: {names[s]}}}"
        for n, ((a, b), s) in enumerate(zip(frame.members.tolist(), frame.section.tolist(), strict=True), 1)
    ]
    first, heavy = len(frame.members), np.flatnonzero(frame.kg)
    elements += [
        f"      - {{id: {first + n}, type: mass, nodes: [{i + 1}], mass: {frame.kg[i]:.8g}}}"
        for n, i in enumerate(heavy, 1)
    ]
    feet = ", ".join(f"{n + 1}: all" for n in frame.feet)
    return "\n".join(
        [
            *("model:", "  structure:", "    nodes:", *nodes),
            f"    materials: {{steel: {{E: {E:.6e}, nu: {NU}, density: {DENSITY}}}}}",
            f"    sections: {{{sections}}}",
            *("    elements:", *elements),
            f"    supports: {{{feet}}}",
            *("", "parameters:"),
            "  - {name: E, material: steel, property: E, sd: 5 %, transform: log}",
            f"  - {{name: masses, elements: {first + 1}-{first + len(heavy)}, property: mass, factor: true, sd: 3 %, "
            "transform: log}",
            "",
        ]
    )
