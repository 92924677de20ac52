"""Values of a structure that no structure has, and the unit in which they would be sound."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from mouse_cli.model.channel_units import unit
from mouse_cli.model.materials import DENSITIES, MODULI, known
from mouse_cli.model.mesh import ElementSet, Mesh
from mouse_cli.model.units import KILOGRAM, SYSTEMS, Units

_LONGEST = 0.5  # radius of gyration over the span of the structure, above which the section is no section of it
_THINNEST, _USUAL = 5e-5, (2e-3, 0.3)  # the same, below which no bar can be; and of most structures
# I / A^2: 1/(4 pi) of a disc, 1/12 of a square, about 1 of rolled sections
_SQUAT, _USUAL_SHAPE = (1e-5, 1e5), (5e-3, 1e2)
_LENGTHS = {"mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.3048}
_TOYS = (
    300.0,
    12000.0,
)  # density in kg/m3 that a deck without units must have for its numbers to be those of a material


@dataclass(frozen=True)
class Odd:
    """What is odd in element set `set`: what was read, why it cannot be, and what to write; about: which property."""

    set: int
    message: str
    help: str
    about: str = ""


def odd(mesh: Mesh, units: Units) -> Iterator[Odd]:
    """Everything of `mesh` that another unit explains: materials, then sections against the size of the structure."""
    reported: set[tuple] = set()
    span = _span(mesh)
    for s, members in enumerate(mesh.elements):
        for each in (*_material(s, members, units), *_section(s, members, span, units)):
            if (each.message, each.help) not in reported:
                reported.add((each.message, each.help))
                yield each


def strange(mesh: Mesh, units: Units) -> int:
    """How many element sets have a material or a section that none has, whether or not another unit explains it."""
    return sum(_unknown(e, units) + _misshapen(e, _span(mesh)) for e in mesh.elements)


def _span(mesh: Mesh) -> float:
    """Length of the diagonal of the box around the nodes."""
    return float(np.linalg.norm(np.ptp(mesh.coordinates, axis=0))) if len(mesh.coordinates) else 0.0


def si(units: Units) -> tuple[float, float]:
    """One of the units of Young's modulus in Pa, and of density in kg/m3."""
    metre = units.metre if units.declared else 1.0
    if not units.declared:
        return 1.0, 1.0
    return unit(units.force).factor / metre**2, 1.0 / KILOGRAM[units.mass] / metre**3


def systems(units: Units) -> Iterator[tuple[str, tuple[float, float]]]:
    """What `si` says of these units, under the name "", and of every other system of units."""
    yield "", si(units)
    yield from ((name, si(each)) for name, each in SYSTEMS.items() if each != units)


def _material(s: int, members: ElementSet, units: Units) -> Iterator[Odd]:
    """Young's modulus with density that no material has, where one has them in other units."""
    if not _unknown(members, units):
        return
    E, density = (float(members.properties[key][0]) for key in ("E", "density"))
    if not units.declared and not (_TOYS[0] <= density <= _TOYS[1] or known(E, 0.0)):
        return
    read = reading(E, density, units)
    if read is None:
        return
    name, in_E, in_density = read
    e, d = si(units)
    parts = []
    if in_E:
        parts.append(("E", E, in_E, f"{E * MODULI[in_E] / e:.6g}", units.of("Pa")))
    if in_density:
        parts.append(("density", density, in_density, f"{density * DENSITIES[in_density] / d:.6g}", units.of("kg/m3")))
    said = " and ".join(f"{key} = {value:.6g} {own}" for key, value, _, _, own in parts)
    rest = "" if len(parts) == 2 else f" beside {'density' if in_E else 'E'} = {density if in_E else E:.6g}"
    remedy = " and ".join(f"{key}: {right}" for key, _, _, right, _ in parts)
    in_units = " and ".join(other for _, _, other, _, _ in parts)
    origin = members.origin.get("E") or members.origin.get("density") or ""
    held = f" (material {origin})" if origin else ""
    yield Odd(s, f"{said}{held} is of no material{rest}; in {in_units} it would be {name}", f"write {remedy}", "E")


def _unknown(members: ElementSet, units: Units) -> bool:
    """Whether Young's modulus and density, alike in all elements, are of no material, not even loosely."""
    E, density = members.properties.get("E"), members.properties.get("density")
    if E is None or density is None or np.ptp(E) or np.ptp(density) or not E[0] > 0 or not density[0] > 0:
        return False
    systems = [units] if units.declared else list(SYSTEMS.values())
    return not any(known(E[0] * e, density[0] * d, loose=True) for e, d in map(si, systems))


def _misshapen(members: ElementSet, span: float) -> bool:
    """Whether the section does not go with the structure, or its area not with its second moment."""
    A, preload = members.properties.get("A"), members.properties.get("preload")
    if A is None or not span > 0 or not (A > 0).all() or (preload is not None and preload.any()):
        return False
    inertia, area = _inertia(members), float(np.max(A))
    if not inertia > 0:
        return area**0.5 > span
    gyration, shape = (inertia / area) ** 0.5, inertia / area**2
    return not (_THINNEST * span <= gyration <= _LONGEST * span and _SQUAT[0] <= shape <= _SQUAT[1])


def _inertia(members: ElementSet) -> float:
    """The larger second moment of area; 0 where there is none."""
    moments = [members.properties[key] for key in ("Iy", "Iz") if key in members.properties]
    return float(np.max(moments)) if moments else 0.0


def reading(E: float, density: float, units: Units) -> tuple[str, str, str] | None:
    """The material, the unit of E and that of density (empty: as declared) in which the numbers are of one; fewest changes."""
    e, d = si(units)
    moduli = [("", e), *((name, size) for name, size in MODULI.items() if abs(size / e - 1) > 1e-6)]
    densities = [("", d), *((name, size) for name, size in DENSITIES.items() if abs(size / d - 1) > 1e-6)]
    trials = sorted(product(moduli, densities), key=lambda pair: bool(pair[0][0]) + bool(pair[1][0]))
    for (in_E, a), (in_density, b) in trials:
        name = known(E * a, density * b)
        if name and (in_E or in_density):
            return name, in_E, in_density
    return None


def _section(s: int, members: ElementSet, span: float, units: Units) -> Iterator[Odd]:
    """A cross section that does not go with the length of the structure, or whose area does not go with its second moment."""
    if not _misshapen(members, span):
        return
    inertia, area = _inertia(members), float(np.max(members.properties["A"]))
    length = units.length if units.declared else "m"
    origin = members.origin.get("A") or members.origin.get("Iz") or members.origin.get("Iy") or ""
    held = f" (section {origin})" if origin else ""
    if not inertia > 0:
        message = f"A = {area:.6g} {length}2{held} is {area**0.5:.3g} {length} squared, the structure {span:.4g} {length} long"
        yield Odd(s, message, _smaller(area, span, length), "A")
        return
    gyration = (inertia / area) ** 0.5
    message = (
        f"A = {area:.6g} {length}2 with I = {inertia:.6g} {length}4{held} has a radius of gyration of {gyration:.3g} {length}, "
        f"in a structure of {span:.4g} {length}"
    )
    fitting = []
    for named, a, i, x in _readings(length):
        r, form = (inertia * i / (area * a)) ** 0.5 / (span * x), inertia * i / (area * a) ** 2
        if _USUAL[0] <= r <= _USUAL[1] and _USUAL_SHAPE[0] <= form <= _USUAL_SHAPE[1]:
            fitting.append((named, area * a, inertia * i))
    if fitting:
        alike = [named[9:] for named, _, _ in fitting if named.startswith("nodes")]
        yield Odd(s, message, _written(*fitting[0], length, alike), "Iz" if fitting[0][0].startswith("I ") else "A")


def _readings(length: str) -> Iterator[tuple[str, float, float, float]]:
    """What may be in another unit, and the factors of A, I and coordinates that mend it."""
    own = {"m": 1.0, "mm": 1e-3, "in": 0.0254, "ft": 0.3048}[length]
    scales = {name: size / own for name, size in {**_LENGTHS, "m": 1.0}.items() if abs(size / own - 1) > 1e-6}
    for name, f in scales.items():
        yield f"A and I in {name}", f**2, f**4, 1.0
    for name, f in scales.items():
        yield f"I in {name}4", 1.0, f**4, 1.0
        yield f"A in {name}2", f**2, 1.0, 1.0
    for name, f in scales.items():
        yield f"nodes in {name}", 1.0, 1.0, f


def _written(named: str, area: float, inertia: float, length: str, alike: list[str]) -> str:
    if named.startswith("nodes"):
        return f"the coordinates look to be in {' or '.join(alike)}: give the nodes in {length}"
    what = {"A and": f"A: {area:.6g} and I: {inertia:.6g}", "I in": f"I: {inertia:.6g}", "A in": f"A: {area:.6g}"}
    return f"{named}? then write {next(v for k, v in what.items() if named.startswith(k))}, in {length}"


def _smaller(area: float, span: float, length: str) -> str:
    for named, a, _, _ in _readings(length):
        if named.startswith("A in") and _USUAL[0] <= (area * a) ** 0.5 / span <= _USUAL[1]:
            return f"{named}? then write A: {area * a:.6g}, in {length}"
    return f"give A in {length}2"
