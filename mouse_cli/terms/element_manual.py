"""The element library in words: what `mouse explain elements` tells, written from the types themselves."""

from collections.abc import Iterator

from mouse_cli._texts import capital
from mouse_cli.terms.elements import (
    AXES,
    END_DIRECTIONS,
    END_VECTORS,
    VECTOR,
    ElementType,
    Option,
    Property,
    registry,
)

_FORMS = {
    VECTOR: "[x, y, z]",
    AXES: "[[x, y, z], [x, y, z]]",
    END_VECTORS: "{1: [x, y, z], 2: [x, y, z]}",
    END_DIRECTIONS: "{1: [RZ], 2: [RY, RZ]}",
}
_HEAD = """\
# Elements

Every property is a number that a parameter may revise, as a value or as a factor; options are not. Units are those of a
consistent system, SI as written. Global directions are TX, TY, TZ, RX, RY, RZ.

**Degrees of freedom.** A direction of a node in which no element has stiffness is left out (as after AUTOSPC in Nastran);
where it has mass, mouse says so. Elements whose nodes are joined by rigid links act through them.

**Local axes** of elements along a line: x from the first node to the second; y in the plane of x and `orientation`, and
without that horizontal, Z x x with Z the global Z (global Y where the element stands upright); z = x x y. In the plane XY
local z is global Z, so that beams bend by Iz; in the plane XZ local y is global Y or its opposite, so that they bend by Iy.

**Releases** are eliminated from stiffness, mass and axial stiffness alike, by statics. **Offsets** are rigid arms.

**Damping.** Every type with stiffness has `loss_factor` and `stiffness_damping`, every type with distributed mass
`mass_damping` too. They multiply the element's own K and M, without the stiffness that axial force makes.

**Gravity** (P-delta) gives beams and rods the axial force that linear statics of the nominal model finds under all weights,
and each storey the weight of everything beyond it, seen from the supports, shared equally among storeys between the same two
floors. These forces stay when parameters change; a `preload` comes on top and may be revised."""


def manual() -> str:
    """All types, in Markdown."""
    parts = [_HEAD, *("\n".join(_section(kind)) for kind in registry().values())]
    return "\n\n".join(parts)


def about(kind: ElementType) -> str:
    """One type, in Markdown."""
    return "\n".join(_section(kind))


def _section(kind: ElementType) -> Iterator[str]:
    yield f"## {kind.key}\n"
    counts = " or ".join(str(n) for n in kind.nodes)
    yield f"{capital(kind.meaning)}. Nodes: {counts}.\n"
    yield "| property | meaning | unit | default |"
    yield "|---|---|---|---|"
    for name, declared in kind.properties.items():
        yield f"| `{name}` | {_meaning(declared)} | {declared.unit} | {_default(declared)} |"
    if kind.options:
        yield "\n| option | meaning | value | default |"
        yield "|---|---|---|---|"
        for name, option in kind.options.items():
            yield f"| `{name}` | {option.meaning} | {_values(option)} | {option.default or ''} |"


def _meaning(declared: Property) -> str:
    only = f"; only with {', '.join(declared.only)}" if declared.only else ""
    return f"{declared.meaning}{only}"


def _default(declared: Property) -> str:
    if declared.default is None:
        return "must be given"
    if callable(declared.default):
        return "follows from others"
    return f"{declared.default:.6g}"


def _values(option: Option) -> str:
    return ", ".join(option.choices) or f"`{_FORMS[option.form]}`"
