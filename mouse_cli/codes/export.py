"""MD480 to MD489: what is written for other programs."""

from mouse_cli.codes import Code

CODES = {
    "MD480": Code(
        "a material of which constants are not known",
        "The cards of the program hold a material with all its constants, and a deck of matrices knows only those that are its "
        "parameters, such as E of STEEL.",
        "Give --job, the input file that the deck was imported from: it has the others.",
    ),
    "MD481": Code(
        "nothing to write for the program",
        "No parameter of the deck is a material, a section, a spring or a mass that the program has cards for.",
        "Export the shapes (--shapes), or bind parameters to properties of elements.",
    ),
    "MD482": Code(
        "shapes without nodes",
        "Shapes are written at nodes with coordinates, and the degrees of freedom of the deck are on none.",
        "Give the model `nodes` and `dofs`.",
    ),
    "MD483": Code(
        "a deck that is not of the job",
        "A complete job is the input file with its sets and supports revised, and the deck names others, or no element sets.",
        "Give as --job the input file that `mouse import` made the deck of.",
    ),
}
