"""Keys of `model: structure:`; what an element may be given follows from the element library."""

from mouse_cli._texts import capital
from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.terms.elements import AXES, END_DIRECTIONS, END_VECTORS, VECTOR, ElementType, Property, registry

PLANES = {"XY": ("TX", "TY", "RZ"), "XZ": ("TX", "TZ", "RY"), "YZ": ("TY", "TZ", "RX")}
_FORMS = {VECTOR: "vector", AXES: "two vectors", END_VECTORS: "end vectors", END_DIRECTIONS: "end directions"}
ELEMENT = "element_"  # section of a type of element: ELEMENT and its key


def _element(kind: ElementType) -> Section:
    """The keys of one type of element: what every type has, then its properties and options."""
    nodes = " or ".join(map(str, kind.nodes))
    keys = {
        "type": Key("choice", "type of element", required=True, choices=(kind.key,)),
        "id": Key("ids", "numbers of the elements, each once in the deck", "on from the highest so far"),
        "nodes": Key(
            "chain", f"nodes that they join, {nodes} each; a range or plain list makes a chain", "from file or dofs"
        ),
        "dofs": Key("dofs", "instead of nodes: degrees of freedom of a matrix model, by number or label"),
        "file": Key(
            "path", "table below the folder of the deck, a line for each element: id, nodes, properties by name"
        ),
        "material": Key("text", "name of one of materials"),
        "section": Key("text", "name of one of sections"),
    }
    if kind.properties.get("TX") and "stiffness" in kind.properties["TX"].meaning:
        keys["stiffness"] = Key("section stiffnesses", "the properties TX to RZ, as a mapping")
    properties = {name: _property(about) for name, about in kind.properties.items()}
    return Section(f"{capital(kind.meaning)}.", keys | properties | _options(kind))


def _property(about: Property) -> Key:
    default = "required" if about.default is None else "see there" if callable(about.default) else f"{about.default:g}"
    only = f" (with {', '.join(about.only)})" if about.only else ""
    return Key("value or values", about.meaning + only, default, about.unit)


def _options(kind: ElementType) -> dict[str, Key]:
    return {
        name: Key(
            "choice" if option.choices else _FORMS.get(option.form, "text"),
            option.meaning,
            "none" if option.default is None else str(option.default),
            choices=option.choices,
        )
        for name, option in kind.options.items()
    }


SECTIONS = {
    "structure": Section(
        "Nodes, elements between them, supports and rigid links; K and M follow.",
        {
            "nodes": Key("positions", "where the nodes are", "those of a matrix model's degrees of freedom", "m"),
            "materials": Key("map material", "materials by name", "none"),
            "sections": Key("map cross_section", "cross sections by name", "none"),
            "elements": Key("list element", "what joins the nodes", required=True),
            "supports": Key("supports", "directions that cannot move", "none"),
            "rigid_links": Key("list rigid_link", "nodes that move together as a rigid body", "none"),
            "plane": Key("choice", "keep the directions of this plane only", "all six", choices=tuple(PLANES)),
            "directions": Key("direction", "keep these directions only", "all six"),
            "gravity": Key("vector", "acceleration whose axial forces stiffen or soften (P-delta)", "none", "m/s2"),
            "generic": Key(
                "list generic_group",
                "like beams whose stiffness --method generic revises",
                "a group for each section and length",
            ),
        },
    ),
    "generic_group": Section(
        "Beams after Euler and Bernoulli, or generic ones, that have one stiffness U0 k U0' (lecture 21-1).",
        {
            "name": Key("text", "what the report calls them", required=True),
            "elements": Key("ids", "their numbers", required=True),
            "couplings": Key(
                "texts",
                "which of k12, k13, k23 may differ from zero; k12 and k13 for elements that are not symmetric",
                "none",
            ),
        },
    ),
    "node_block": Section(
        "Nodes on a line, or from a table.",
        {
            "line": Key("section node_line", "evenly spaced nodes"),
            "file": Key("path", "table below the folder of the deck, a line for each node: id, x, y, z"),
        },
        forms=(("line",), ("file",)),
    ),
    "node_line": Section(
        "Nodes `from` to `to`, evenly spaced from `start` to `end`.",
        {
            "from": Key("whole", "number of the first node", required=True, low=0),
            "to": Key("whole", "number of the last node", required=True, low=0),
            "start": Key("vector", "where the first node is", unit="m", required=True),
            "end": Key("vector", "where the last node is", unit="m", required=True),
        },
    ),
    "material": Section(
        "An isotropic material.",
        {
            "E": Key("number", "modulus of elasticity", unit="Pa"),
            "G": Key("number", "shear modulus", "E / (2 (1 + nu))", "Pa"),
            "nu": Key("number", "Poisson's ratio", "that of the element"),
            "density": Key("number", "mass per volume", unit="kg/m3"),
            "loss_factor": Key("number", "structural damping: D = loss_factor K", "0"),
        },
    ),
    "cross_section": Section(
        "A cross section: a shape, or its properties; a property that is given replaces that of the shape. "
        "Width is along local y, height along local z, which is upward unless an element states otherwise.",
        {
            "A": Key("number", "area", unit="m2"),
            "Iy": Key("number", "second moment of area about local y (bending in the local x-z plane)", unit="m4"),
            "Iz": Key("number", "second moment of area about local z (bending in the local x-y plane)", unit="m4"),
            "J": Key("number", "torsion constant", unit="m4"),
            "kappa_y": Key("number", "share of A that carries shear along local y"),
            "kappa_z": Key("number", "share of A that carries shear along local z"),
            "rectangle": Key("numbers", "[width, height]", unit="m"),
            "circle": Key("number", "diameter", unit="m"),
            "tube": Key("numbers", "[outer diameter, wall]", unit="m"),
            "rectangular_tube": Key("numbers", "[width, height, wall], outer dimensions", unit="m"),
            "i_section": Key("numbers", "[flange width, height, web, flange thickness]", unit="m"),
        },
    ),
    "element": Section(
        "One element or several alike, of one of these types.", {}, variants=tuple(ELEMENT + key for key in registry())
    ),
    **{ELEMENT + key: _element(kind) for key, kind in registry().items()},
    "stiffnesses": Section(
        "Stiffnesses of a spring or joint.",
        {
            name: Key("value or values", f"along {name}", "0", "N/m" if name[0] == "T" else "N m/rad")
            for name in DIRECTIONS
        },
    ),
    "rigid_link": Section(
        "Dependent nodes move with an independent one as if a rigid bar joined them.",
        {
            "independent": Key("whole", "the node that the others follow", required=True),
            "dependent": Key("ids", "the nodes that follow", required=True),
            "directions": Key("direction", "in which they follow", "all that are kept"),
        },
    ),
}
