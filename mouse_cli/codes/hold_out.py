"""MD430 to MD439: what is held out of a test."""

from mouse_cli.codes import Code

CODES = {
    "MD430": Code(
        "no such mode or sensor to hold out",
        "`test.hold_out` keeps modes and sensors of the test from every fit; it names one that the test does not have.",
        "Give mode numbers as in test.modes.number, and sensors as in test.modes.dofs.",
    ),
    "MD431": Code(
        "impossible altered configuration",
        "An entry of `test.hold_out.altered` adds masses or springs to the structure and gives the frequencies it then has. One "
        "of them is at no free degree of freedom of the model, or the frequencies are not positive, without accuracies, or "
        "their mode numbers do not ascend.",
        "Name locations by node and direction (12TY), masses by node too; give each frequency mode number and standard deviation.",
    ),
    "MD432": Code(
        "nothing left to fit",
        "All modes of the test, or all of its data, are held out.",
        "Leave some modes to the fit; the highest third is a good choice to hold out.",
    ),
    "MD433": Code(
        "no such recording or function to hold out",
        "`test.hold_out` keeps recordings, stretches of them, frequency response functions or lines of them from every fit; it "
        "names one that the test does not have.",
        "Give titles as they stand in test.recordings and test.frf, samples as the file counts them from 0, frequencies in Hz.",
    ),
}
