"""MD53x: figures."""

from mouse_cli.codes import Code

CODES = {
    "MD530": Code(
        "figures need matplotlib",
        "`--plot` draws with the package matplotlib, which is not installed. Nothing else needs it.",
        "Install it, e.g. with `pip install 'mouse-cli[plot]'`, or leave --plot out.",
    ),
    "MD531": Code(
        "figures that cannot be written",
        "The figures could not be written: the kind of file is not known, the folder is missing, or the disk is full.",
        "Name a folder, or a file that ends in .pdf, .png or .svg, in a folder that exists.",
    ),
    "MD532": Code(
        "nothing to draw",
        "`--plot` was given, and no figure has anything to show: `mouse run` draws fitted functions and recordings, not modes.",
        "`mouse plot` draws frequencies, parameters and shapes of an answer in JSON; `--figure` selects one it has values for.",
    ),
}
