"""MD700 to MD739: coupled and modified structures."""

from mouse_cli.codes import Code

CODES = {
    "MD700": Code(
        "a deck for another command",
        "A deck holds one of `model`, `couple` and `modify`: a model with its test; substructures; or changes of another deck's "
        "model. Each is read by commands of its own.",
        "Use the command that the message names, or move the other keys into a deck of their own.",
    ),
    "MD701": Code(
        "a name that is no substructure",
        "Interfaces, connections, responses and forces name substructures by the keys below `couple: substructures:`.",
        "Write the name as it stands there.",
    ),
    "MD702": Code(
        "interfaces whose sides differ",
        "The two lists of an interface go pair by pair: the first degree of freedom of one moves with the first of the other.",
        "Name equally many degrees of freedom on both sides, in the same order.",
    ),
    "MD703": Code(
        "a degree of freedom that the part does not have",
        "A degree of freedom of a model is a label such as `12TY`, `12-TY` where it is read backwards, a number of a "
        "model of matrices, or the name of a sensor of its modal test. Of measured FRFs it is the name of a "
        "response or of a force.",
        "Name one of those that the note lists. A degree of freedom that is supported cannot be joined: free it first.",
    ),
    "MD704": Code(
        "functions that are not there",
        "A part that is measured needs exactly one measurement: the only one of `test.frf` of its deck, the one whose title is "
        "named, or a file whose functions name response and force.",
        "Name the measurement, or describe the file in `test.frf` of a deck.",
    ),
    "MD705": Code(
        "parts of different units",
        "Decks of coupled structures compute with the numbers of their parts as they are; parts that declare different units "
        "would be joined by numbers that mean different things.",
        "Write all decks in one system of units.",
    ),
    "MD706": Code(
        "nothing is left",
        "Decoupling takes a part away from what it is in. Here every part is to be taken away.",
        "Leave `remove` out for the assembled structure.",
    ),
    "MD707": Code(
        "no frequencies, or no responses",
        "Functions are computed at the lines of what was measured, or at those that the deck gives; a structure with a measured "
        "part has no other answer than functions.",
        "Give `lines`, and name `responses` and `forces`.",
    ),
    "MD708": Code(
        "a connection that contradicts itself",
        "An item of `connections` or `changes` is a mass, an absorber, or a spring and a dashpot side by side; these may have a "
        "second end `to`, at another degree of freedom.",
        "Give each thing an item of its own.",
    ),
    "MD710": Code(
        "a function that was not measured",
        "Coupling needs every FRF between the degrees of freedom of a part that are joined or requested. One is missing, and "
        "so is its reciprocal, with response and force exchanged.",
        "Measure it, or leave the degree of freedom out. One without a force can be a response, but cannot be joined.",
    ),
    "MD711": Code(
        "lines that parts do not share",
        "All parts are coupled line by line. Measured functions of several parts have no common lines in the requested "
        "band, or lines were requested at which nothing was measured.",
        "Measure all parts with one spacing of lines, or widen the band. Nothing is interpolated: between lines resonances go "
        "lost.",
    ),
    "MD712": Code(
        "exponential windows that differ",
        "Functions measured with an exponential window are those of s = a + i omega. Parts can be coupled only where a is the "
        "same.",
        "Measure all parts with the same window.",
    ),
    "MD713": Code(
        "an interface that noise decides",
        "The condition number of the interface flexibility times its relative noise bounds the relative error of the forces at the "
        "interface. At the listed lines it is above 1: the result there is not reliable.",
        "Truncate (`truncate: 0.01`), join fewer degrees of freedom, or measure better. The variances in the answer "
        "hold to first order only.",
    ),
    "MD714": Code(
        "an interface without an answer",
        "The flexibility of the interface is singular: two conditions are equal, or a part does not move at all where it "
        "is joined.",
        "Leave out the repeated condition, or give `truncate`.",
    ),
    "MD715": Code(
        "modes of parts that are measured or taken away",
        "Natural frequencies and modal coupling need the matrices of every part; measured functions have none, and a part that is "
        "taken away leaves no definite mass matrix.",
        "Leave `modes` out; resonances show in the functions. Or give the models of the parts.",
    ),
    "MD716": Code(
        "a reduction that there is not",
        "`modes: methods:` names a reduction that is not known.",
        "Choose from those that `mouse list reductions` shows.",
    ),
    "MD718": Code(
        "a mode that cannot be moved there",
        "A mass at a degree of freedom lowers mode i at most to the frequency below it at which that point stands still (its "
        "antiresonance, or the mode below), a spring raises it at most to the one above. The target frequency lies beyond.",
        "Choose a closer target or another location from the table, or change more than one thing.",
    ),
    "MD719": Code(
        "a mode that the model does not have",
        "A target, sweep or absorber names a mode beyond those of the model, or a rigid-body mode, which nothing tunes.",
        "Name one of the elastic modes that `mouse modes` lists.",
    ),
    "MD720": Code(
        "a modified model that is not physical",
        "More mass or stiffness is taken away than there is: the modified model has a negative mass or stiffness.",
        "Take away less.",
    ),
    "MD721": Code(
        "dashpots, loss factors and gyroscopic effects have no part in natural frequencies",
        "Natural frequencies and modal coupling are those without damping.",
        "Request FRFs, which include all of it.",
    ),
}
