"""Which system of units a job is in, by E and density of its materials: what a solid can have in it."""

from collections.abc import Iterable, Iterator

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli._span import Span
from mouse_cli.importing.model import InputModel, Material
from mouse_cli.model.units import KILOGRAM, SYSTEMS

_COMMON = ("SI", "mm-t-N", "in-lbf", "m-t-kN", "mm-kg-mN", "ft-lbf")  # systems, the more common first
_STIFF, _HEAVY = (1e5, 2e12), (1.0, 25_000.0)  # Pa, kg/m3: from soft foam to diamond, and to osmium
_SOUND = (10.0, 14_000.0)  # m/s, sqrt(E / rho), of rubber and of beryllium or stiff carbon fibres
_FOAM, _SLOW = 25.0, 1500.0  # kg/m3 below which a solid is a foam; m/s, faster than any foam
_STEEL = "steel has 2.1e11 and 7850 in SI, 2.1e5 and 7.85e-9 in mm-t-N, 3e7 and 7.3e-4 in in-lbf"


def units_of(materials: Iterable[tuple[float, float]]) -> str:
    """The system in which most of the materials (E, density) can be, the first of several, if they are more than half.

    >>> units_of([(2.1e11, 7850.0)]), units_of([(2.1e5, 7.85e-9), (90.0, 8e-11)]), units_of([(2.1e8, 7.85)])
    ('SI', 'mm-t-N', 'm-t-kN')
    >>> units_of([(7.3e10, 2.78e-9)]), units_of([(2.1e11, 7850.0), (7e10, 2700.0), (2.1e11, 1.0)])
    ('', 'SI')
    """
    used = list(materials)
    count = {name: sum(_solid(name, *each) for each in used) for name in _COMMON}
    best = max(count, key=lambda name: count[name])
    return best if count[best] > len(used) / 2 else ""


def told(model: InputModel, given: str | None) -> tuple[str, list[Diagnostic]]:
    """The system of a job, `given` or by its materials, and warnings: which one, and materials that are none in it."""
    used = {group.material.name: group.material for group in model.groups if group.material is not None}
    named = given or units_of((m.E, m.rho) for m in used.values())
    found = [] if named else list(_strange(used.values(), "any one system of units", _COMMON))
    if named:
        found = list(_strange(used.values(), named, (named,)))
    if not given:
        text = f"taken for {named}, as E and density of its materials are" if named else "not determined by its materials"
        message = f"the units of the job are {text}"
        found.insert(0, Diagnostic("MD276", WARNING, message, Span(model.path, 1), help="give --units"))
    return named, found


def _strange(used: Iterable[Material], of: str, names: Iterable[str]) -> Iterator[Diagnostic]:
    """Materials that are none in any of these systems."""
    for material in used:
        if not any(_solid(name, material.E, material.rho) for name in names):
            pair = f"E and density of {material.name}, {material.E:g} and {material.rho:g}"
            message = f"{pair}, are those of no material in {of}"
            help = f"mend them where they are no dummies: {_STEEL}"
            yield Diagnostic("MD276", WARNING, message, material.card.head.span, help=help)


def _solid(system: str, E: float, rho: float) -> bool:
    """Whether a solid can have these constants in a system."""
    units = SYSTEMS[system]
    stiff, heavy = (each / KILOGRAM[units.mass] / units.metre**power for each, power in ((E, 1), (rho, 3)))
    if not (_STIFF[0] <= stiff <= _STIFF[1] and _HEAVY[0] <= heavy <= _HEAVY[1]):
        return False
    sound = (stiff / heavy) ** 0.5
    return _SOUND[0] <= sound <= (_SOUND[1] if heavy >= _FOAM else _SLOW)
