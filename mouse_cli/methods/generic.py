"""Generic element matrices (Gladwell and Ahmadian 1995): the stiffness of like elements revised in their own strain modes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.methods import ELEMENTS, SHAPES, Method, refusals
from mouse_cli.methods.found import Found
from mouse_cli.methods.given import Given
from mouse_cli.methods.least_error import Undetermined, Unknowns, least_error
from mouse_cli.model.mesh import Binding, ElementSet, GenericGroup, Mesh
from mouse_cli.model.updated import KEPT, PARTLY, Moved
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import built

_DIAGONAL = {"k11": "symmetric_{}", "k22": "antisymmetric_{}"}
_COUPLED = {"k12": "coupling_{}", "k13": "symmetric_twist_{}", "k23": "antisymmetric_twist_{}"}
_AXES = "yz"  # of bending
_ORDER = {"k11": (0, 0), "k22": (1, 1), "k33": (2, 2), "k12": (0, 1), "k13": (0, 2), "k23": (1, 2)}


@dataclass(frozen=True)
class GenericBeams:
    """assembly of the model with its beams generic; theta (p,): parameters of the deck, then all of k; free: those that act.

    names (k,) of the free ones; entries: group, axis and entry of each of theta beyond the deck's `first` parameters.
    """

    assembly: Assembly
    theta: np.ndarray
    free: np.ndarray
    names: list[str]
    entries: list[tuple[int, str, str]]
    first: int

    def matrices(self, theta: np.ndarray) -> list[np.ndarray]:
        """k (3, 3) of each group in each plane of bending; k33 is common to both."""
        found: dict[tuple[int, str], np.ndarray] = {}
        twist = {group: theta[self.first + i] for i, (group, _, entry) in enumerate(self.entries) if entry == "k33"}
        for i, (group, axis, entry) in enumerate(self.entries):
            if entry != "k33":
                k = found.setdefault((group, axis), np.diag([1.0, 1.0, twist[group]]))
                row, col = _ORDER[entry]
                k[row, col] = k[col, row] = theta[self.first + i]
        return list(found.values())


def generic_beams(given: Given) -> GenericBeams:
    """The groups of the deck, else one for each set of like beams. Raises DeckError where there is no such beam."""
    problem, mesh = given.problem, given.problem.mesh
    groups = mesh.generic or _like(mesh)
    if not groups:
        help = "describe the structure by beams, or use equation-error with parameters of your own"
        raise refusals.lacking(problem, "generic", "beams of Euler and Bernoulli, or generic ones", help)
    wanted = np.concatenate([group.elements for group in groups])
    sets = tuple(_generic(members, wanted) for members in mesh.elements)
    first, entries, bindings, start = len(problem.parameters), [], [], []
    for g, group in enumerate(groups):
        places = [(s, np.flatnonzero(np.isin(members.ids, group.elements))) for s, members in enumerate(sets)]
        places = [(s, at) for s, at in places if len(at)]
        for axis, entry, property in _entries(group):
            number, factor = first + len(entries), entry == "k33"
            entries.append((g, axis, entry))
            start.append(1.0 if factor else float(sets[places[0][0]].properties[property][places[0][1][0]]))
            bindings += [Binding(number, s, at, property, factor) for s, at in places]
    found = built(replace(mesh, elements=sets), (*problem.bindings, *bindings))
    if found.structure.n != problem.structure.n:
        help = "use equation-error with parameters of your own"
        raise refusals.lacking(problem, "generic", "a structure that does not stand on imported matrices", help)
    theta = np.concatenate([problem.prior.mean, start])
    assembly = Assembly(problem.structure, found.terms, len(theta))
    acting = np.unique(assembly.slopes(theta)["K"].parameter)
    free = acting[acting >= first].astype(int)
    names = [_name(groups, *entries[i - first]) for i in free]
    return GenericBeams(assembly, theta, free, names, entries, first)


def _like(mesh: Mesh) -> tuple[GenericGroup, ...]:
    """A group for each set of beams of one section, material and length."""
    found = []
    for members in mesh.elements:
        if members.type != "beam" or (members.options.get("theory") or "euler-bernoulli") == "timoshenko":
            continue
        ends = mesh.coordinates[members.nodes]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        facts = np.column_stack([np.array([float(f"{x:.6g}") for x in length]), *members.properties.values()])
        for row in np.unique(facts, axis=0):
            own = members.ids[(facts == row).all(axis=1)]
            found.append(GenericGroup(f"beams {own[0]}..." if len(own) > 1 else f"beam {own[0]}", own))
    return tuple(found)


def _generic(members: ElementSet, wanted: np.ndarray) -> ElementSet:
    """The set with generic stiffness, equal to what it was; others as they are."""
    if members.type != "beam" or not np.isin(members.ids, wanted).any():
        return members
    names = [name.format(axis) for name in (*_DIAGONAL.values(), *_COUPLED.values()) for axis in _AXES]
    start = {name: np.full(len(members), float("symmetric_" in name and "twist" not in name)) for name in names}
    return replace(
        members, options={**members.options, "theory": "generic"}, properties={**start, **members.properties}
    )


def _entries(group: GenericGroup) -> Iterator[tuple[str, str, str]]:
    """Axis, entry of k, and the property of a beam that it is."""
    for axis in _AXES:
        yield from ((axis, entry, name.format(axis)) for entry, name in _DIAGONAL.items())
        yield from ((axis, entry, _COUPLED[entry].format(axis)) for entry in group.couplings)
    yield "", "k33", "J"


def _name(groups: tuple[GenericGroup, ...], group: int, axis: str, entry: str) -> str:
    return f"{groups[group].name}: {entry}" + (f" about {axis}" if axis else "")


_NEAR = 0.02  # a step may bring the smallest eigenvalue of k down to this share of what it was


def update(given: Given) -> Found:
    """K^e = U0 k U0' with one k for the elements of a group, by equation error; k stays positive definite.

    k is in units of the model's own: 1 on the diagonal and 0 off it before the update. Raises NumericalError for entries of k that
    the measured modes do not determine.
    """
    beams = generic_beams(given)
    lowest = {}

    def admissible(theta: np.ndarray) -> bool:
        """Every k definite, and not much less so than one step before."""
        least = [float(np.linalg.eigvalsh(k)[0]) for k in beams.matrices(theta)]
        sound = all(now > _NEAR * lowest.get(i, 1.0) for i, now in enumerate(least))
        if sound:
            lowest.update(enumerate(least))
        return sound

    k = len(beams.names)
    unknowns = Unknowns(beams.assembly, beams.theta, beams.free, np.ones(k), admissible)
    try:
        found = least_error(given, unknowns)
    except Undetermined as reason:
        loose = [name for name, is_loose in zip(beams.names, reason.loose, strict=True) if is_loose]
        raise refusals.undetermined(given.problem, METHOD.key, loose, str(reason)) from None
    rows = zip(beams.names, beams.theta[beams.free], found.theta[beams.free], strict=True)
    moved = tuple(Moved(name, "", float(before), float(after)) for name, before, after in rows)
    return Found(found.K, found.M, found.iterations, found.change, found.settled, moved, found.conditioning)


METHOD = Method(
    "generic",
    "generic element matrices",
    "K^e = U0 [k11 k12 k13; . k22 k23; . . k33] U0', min sum_i r_i'(K0 + s M)^-1 r_i, r_i = (K - lambda_i M) x_i",
    "lecture 21-1; Gladwell and Ahmadian, Mech. Syst. Signal Process. 9 (1995) 601",
    (
        (PARTLY, "as far as the groups have parameters enough"),
        (KEPT, "k of each group is kept positive definite"),
        (KEPT, "U0 holds strain modes alone: elements do not resist rigid motion"),
        (KEPT, "the elements join what they joined"),
        (KEPT, "k11, k22, k33 are bending, shear and torsion of an element, k12, k13, k23 what couples them"),
    ),
    (SHAPES, ELEMENTS),
    update,
)
