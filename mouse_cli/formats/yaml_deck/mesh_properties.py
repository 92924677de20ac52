"""The `materials:` and `sections:` of a structure: numbers by name; width is along local y, height along local z.

Torsion constants and shares of shear from Young and Budynas, Roark's Formulas (7th ed., table 10.1); Cowper, J. Appl. Mech. 33
(1966) 335, with Poisson's ratio 0, for `kappa`; thin walls by Bredt.
"""

from collections.abc import Callable
from math import pi, tanh

from mouse_cli.formats.yaml_deck.sections import Section

Named = dict[str, dict[str, float | None]]  # None: given, and no number


def materials(structure: Section) -> Named:
    """Properties of each material, as given."""
    return {name: _numbers(section) for name, section in structure.named("materials").items()}


def cross_sections(structure: Section) -> Named:
    """Properties of each cross section: those of its shape, replaced by what is given."""
    found = structure.named("sections")
    return {name: _shape(section) | _numbers(section) for name, section in found.items()}


def _numbers(section: Section) -> dict[str, float | None]:
    return {key: section.value(key) for key in section.nodes if key not in SHAPES}


def _shape(section: Section) -> dict[str, float]:
    given = [key for key in SHAPES if key in section]
    if not given:
        return {}
    if len(given) > 1:
        section.error("MD217", f"gives {' and '.join(given)}; a section has one shape", "delete one of the two")
        return {}
    shape, node = given[0], section.nodes[given[0]]
    value = section.value(shape)
    if value is None:
        return {}
    dimensions = [value] if DIMENSIONS[shape] == 1 else value.tolist()
    if len(dimensions) != DIMENSIONS[shape]:
        message = f"{section.what(shape)} has {len(dimensions)} numbers; expected {DIMENSIONS[shape]}"
        section.document.error("MD216", node, message, f"give {section.definition.keys[shape].meaning}")
        return {}
    if impossible(shape, dimensions):
        message = f"{section.what(shape)} is {section.document.written(node)}: there is no such shape"
        section.document.error("MD408", node, message, "give positive dimensions, and walls that fit within them")
        return {}
    return SHAPES[shape](*dimensions)


_ODD_FIFTHS = 1.0045237627951384  # 1 + 1/3^5 + 1/5^5 + ... = 31/32 zeta(5)


def rectangle(width: float, height: float) -> dict[str, float]:
    """A solid rectangle; J by the series of Saint-Venant (Timoshenko and Goodier, section 109)."""
    a, b = max(width, height), min(width, height)
    series = _ODD_FIFTHS - sum((1 - tanh(n * pi * a / (2 * b))) / n**5 for n in range(1, 30, 2))
    J = a * b**3 * (1 / 3 - 64 / pi**5 * b / a * series)
    return _properties(width * height, width * height**3 / 12, height * width**3 / 12, J, 5 / 6, 5 / 6)


def circle(diameter: float) -> dict[str, float]:
    """A solid circle."""
    moment = pi * diameter**4 / 64
    return _properties(pi * diameter**2 / 4, moment, moment, 2 * moment, 6 / 7, 6 / 7)


def tube(diameter: float, wall: float) -> dict[str, float]:
    """A circular tube of any wall."""
    inner = diameter - 2 * wall
    moment, m = pi * (diameter**4 - inner**4) / 64, (inner / diameter) ** 2
    kappa = 6 * (1 + m) ** 2 / (7 * (1 + m) ** 2 + 20 * m)
    return _properties(pi * (diameter**2 - inner**2) / 4, moment, moment, 2 * moment, kappa, kappa)


def rectangular_tube(width: float, height: float, wall: float) -> dict[str, float]:
    """A rectangular tube of one wall thickness; each pair of walls carries the shear along it."""
    b, h = width - 2 * wall, height - 2 * wall
    area = width * height - b * h
    middle, round_about = (width - wall) * (height - wall), 2 * (width + height - 2 * wall)
    return _properties(
        area,
        (width * height**3 - b * h**3) / 12,
        (height * width**3 - h * b**3) / 12,
        4 * middle**2 * wall / round_about,
        2 * wall * width / area,
        2 * wall * height / area,
    )


def i_section(width: float, height: float, web: float, flange: float) -> dict[str, float]:
    """A symmetric I: the web carries the shear along z, the flanges that along y."""
    clear = height - 2 * flange
    area = 2 * width * flange + clear * web
    return _properties(
        area,
        (width * height**3 - (width - web) * clear**3) / 12,
        (2 * flange * width**3 + clear * web**3) / 12,
        (2 * width * flange**3 + (height - flange) * web**3) / 3,
        5 / 3 * width * flange / area,
        web * height / area,
    )


def _properties(A: float, Iy: float, Iz: float, J: float, kappa_y: float, kappa_z: float) -> dict[str, float]:
    return {"A": A, "Iy": Iy, "Iz": Iz, "J": J, "kappa_y": kappa_y, "kappa_z": kappa_z}


SHAPES: dict[str, Callable[..., dict[str, float]]] = {
    "rectangle": rectangle,
    "circle": circle,
    "tube": tube,
    "rectangular_tube": rectangular_tube,
    "i_section": i_section,
}
DIMENSIONS = {"rectangle": 2, "circle": 1, "tube": 2, "rectangular_tube": 3, "i_section": 4}


def impossible(shape: str, dimensions: list[float]) -> bool:
    """Whether no such shape exists: a dimension that is not positive, walls that do not fit in."""
    if not all(0 < value < float("inf") for value in dimensions):
        return True
    if shape == "i_section":
        width, height, web, flange = dimensions
        return web > width or 2 * flange >= height
    return shape in ("tube", "rectangular_tube") and 2 * dimensions[-1] >= min(dimensions[:-1])
