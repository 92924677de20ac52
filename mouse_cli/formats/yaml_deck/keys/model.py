"""Keys of `model:`."""

from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.formats.yaml_deck.kinds import Key, Section

_NO_STRUCTURE = "this release reads bare matrices: give model: {stiffness: ..., mass: ...}"
SECTIONS = {
    "model": Section(
        "The baseline: symmetric K and M at the nominal values of the parameters.",
        {
            "stiffness": Key("section matrix", "K", unit="N/m", required=True),
            "mass": Key("section matrix", "M", unit="kg", required=True),
            "labels": Key("texts", "names of the degrees of freedom", "1, 2, ..."),
        },
        later={"structure": _NO_STRUCTURE, "damping": _NO_STRUCTURE},
    ),
    "matrix": Section(
        "A symmetric matrix, in one of five forms.",
        {
            "order": Key("whole", "number of rows", low=1, high=MAX_ORDER),
            "entries": Key("triples", "diagonal and upper triangle as [row, column, value], from 1; the rest is 0"),
            "dense": Key("square", "all rows"),
            "diagonal": Key("numbers", "the diagonal; the rest is 0"),
            "identity": Key("whole", "order of a unit matrix", low=1, high=MAX_ORDER),
            "file": Key("path", "matrix file (.mtx, .npz, .csv) below the folder of the deck"),
        },
        forms=(("order", "entries"), ("dense",), ("diagonal",), ("identity",), ("file",)),
    ),
    "file": Section(
        "Values kept in a file.",
        {"file": Key("path", "matrix file (.mtx, .npz, .csv) below the folder of the deck", required=True)},
    ),
}
