"""Keys of `model:`."""

from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.formats.yaml_deck.kinds import Key, Section

_FILES = "matrix file (.mtx, .npz, .csv, .op4, .pch, .sti, .mas, .hb, .mat, .h5 and others)"
_VARIABLE = Key("text", "which matrix of a file that holds several: its name, or its path with /", "the only one")
SECTIONS = {
    "model": Section(
        "The baseline: symmetric K and M at the nominal values of the parameters, or a structure that makes them, or "
        "a structure that is attached to matrices.",
        {
            "structure": Key("section structure", "nodes and elements"),
            "stiffness": Key("section matrix", "K", unit="N/m"),
            "mass": Key("section matrix", "M", unit="kg"),
            "damping": Key("section matrix", "C, viscous damping", "none", "N s/m"),
            "structural_damping": Key("section matrix", "D, imaginary part of K", "none", "N/m"),
            "labels": Key("texts", "names of the degrees of freedom", "1, 2, ..."),
            "dofs": Key(
                "section file",
                "node and direction of each row: .dof (CalculiX), .mapping (ANSYS), .csv",
                "as files name them",
            ),
            "nodes": Key(
                "section file", "where the nodes of these are: .unv, .inp, .bdf, .csv (number, x, y, z)", "none"
            ),
            "supports": Key(
                "map held", "supports of stiffness and mass, by name; both are then given without them", "none"
            ),
            "sets": Key("map element_set", "element sets by name, with what each gives to stiffness and mass", "none"),
        },
        needs=(("stiffness", "mass"), ("structure",)),
    ),
    "held": Section(
        "What one support of imported matrices holds.",
        {
            "dofs": Key("dofs", "degrees of freedom that it holds"),
            "nodes": Key("ids", "nodes that it holds"),
            "directions": Key("direction", "directions in which it holds them"),
        },
        forms=(("dofs",), ("nodes", "directions")),
    ),
    "element_set": Section(
        "An element set of imported matrices, where `mouse diagnose` may find a part that is softer, stiffer, heavier or missing.",
        {
            "stiffness": Key("section file", "what the set gives to stiffness", "nothing", "N/m"),
            "mass": Key("section file", "what the set gives to mass", "nothing", "kg"),
            "nodes": Key("ids", "nodes of its elements", "none"),
            "thickness": Key("section thickness", "of shells: what it gives by powers of their thickness", "none"),
            "missing": Key("section missing", "what stiffness and mass lose without it, where others hold less then", "none"),
        },
    ),
    "missing": Section(
        "What stiffness and mass lose without an element set, where that is more than it gives.",
        {
            "stiffness": Key("section file", "K less K without the set", "nothing", "N/m"),
            "mass": Key("section file", "M less M without the set", "nothing", "kg"),
        },
    ),
    "thickness": Section(
        "What a set of shells gives to stiffness and mass by powers of its thickness t: the sum of K_n (t / nominal)^n.",
        {
            "nominal": Key("number", "the thickness in the model", required=True),
            "unit": Key("text", "unit of the thickness", "empty"),
            "powers": Key("map thickness_power", "by n: 1 is membrane and mass, 3 bending", required=True),
        },
    ),
    "thickness_power": Section(
        "What goes by one power of a thickness, at its nominal value; over all powers these sum to what the set gives.",
        {
            "stiffness": Key("section file", "K_n", "nothing", "N/m"),
            "mass": Key("section file", "M_n", "nothing", "kg"),
        },
    ),
    "matrix": Section(
        "A symmetric matrix, in one of these forms.",
        {
            "order": Key("whole", "number of rows", low=1, high=MAX_ORDER),
            "entries": Key("triples", "diagonal and upper triangle as [row, column, value], from 1; the rest is 0"),
            "dense": Key("square", "all rows"),
            "diagonal": Key("numbers", "the diagonal; the rest is 0"),
            "identity": Key("whole", "order of a unit matrix", low=1, high=MAX_ORDER),
            "variable": _VARIABLE,
            "file": Key("path", f"{_FILES} below the folder of the deck"),
        },
        forms=(("order", "entries"), ("dense",), ("diagonal",), ("identity",), ("file",), ("variable", "file")),
    ),
    "file": Section(
        "Values kept in a file.",
        {
            "file": Key(
                "path", f"{_FILES}, or of the kind that the key states, below the folder of the deck", required=True
            ),
            "variable": _VARIABLE,
        },
    ),
}
