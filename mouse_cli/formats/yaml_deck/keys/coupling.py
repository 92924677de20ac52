"""Keys of `couple:` and `modify:`, which stand in decks of their own."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.coupling import ABOVE, ABSORBER, BELOW, EXACTLY, MASS, SPRING
from mouse_cli.model.frf_test import KINDS

_KIND = Key("choice", "what the functions of the answer are", "receptance", choices=tuple(KINDS))
_RATIO = Key("number", "of critical damping", "0; tuned: Den Hartog's", low=0)
SECTIONS = {
    "couple": Section(
        "Substructuring: coupling and decoupling of substructures by `mouse couple`.",
        {
            "substructures": Key("map substructure", "the parts, by name", required=True),
            "interfaces": Key(
                "joined", "degrees of freedom that move together, such as {left: [3TX, 3TY], right: [1TX, 1TY]}", "none"
            ),
            "connections": Key(
                "list connection", "masses, springs, dashpots, absorbers at degrees of freedom or between them", "none"
            ),
            "responses": Key("points", "where FRFs are requested", "no functions"),
            "forces": Key("points", "where forces act", "where responses are"),
            "lines": Key("section lines", "frequencies of the functions", "those measured"),
            "kind": _KIND,
            "truncate": Key(
                "number",
                "singular values of the interface flexibility below this share of the largest are left out",
                "0: none; 1e-9 where a part is taken away",
                low=0,
                high=1,
            ),
            "modes": Key(
                "section synthesis",
                "natural frequencies of the whole, and what modal coupling makes of them",
                "10 modes",
            ),
        },
    ),
    "substructure": Section(
        "A part: the model of a deck, or measured functions.",
        {
            "deck": Key("path", "deck of the part, below the folder of this one"),
            "measured": Key("flag", "the functions of its `test.frf` stand for it, and not its model", "false"),
            "measurement": Key("text", "title of those functions, where it holds several", "the only ones"),
            "functions": Key("path", "file of functions that names response and force of each, without a deck"),
            "kind": Key("choice", "of the functions in the file", "as in the file", choices=tuple(KINDS)),
            "remove": Key("flag", "the part is taken away from the others (decoupling)", "false"),
            "reciprocal": Key("flag", "a function that is missing is that with response and force exchanged", "true"),
        },
        needs=(("deck",), ("functions",)),
    ),
    "connection": Section(
        "A connection of one degree of freedom, at a point or between two.",
        {
            "name": Key("text", "what the printout calls it", "what it is"),
            "mass": Key("number", "mass or inertia", "none", "kg"),
            "spring": Key("number", "stiffness", "none", "N/m"),
            "loss_factor": Key("number", "of the spring", "0", low=0),
            "dashpot": Key("number", "viscous damping", "none", "N s/m", low=0),
            "absorber": Key("section absorber", "a mass that hangs on a spring and a dashpot", "none"),
            "at": Key(
                "point",
                "where: {substructure: degree of freedom}, or a degree of freedom of the only one",
                required=True,
            ),
            "to": Key("point", "the other end of spring and dashpot", "the ground"),
        },
        needs=(("mass",), ("spring",), ("dashpot",), ("absorber",)),
    ),
    "absorber": Section(
        "A mass on a spring with a natural frequency of its own.",
        {
            "mass": Key("number", "its mass", "", "kg", required=True, low=0),
            "frequency": Key("number", "natural frequency while its foot is held", "", "Hz", low=0),
            "tuned_to": Key(
                "whole", "instead of frequency: mode of the model that is tuned by Den Hartog's rule", low=1
            ),
            "damping_ratio": _RATIO,
        },
        needs=(("frequency",), ("tuned_to",)),
    ),
    "lines": Section(
        "Frequencies of functions: a band with a step, or a list; or a band of those measured.",
        {
            "band": Key("pair", "lowest and highest", "", "Hz"),
            "step": Key("number", "distance of lines in the band", "those measured", "Hz", low=0),
            "frequency": Key("numbers", "the lines themselves", "", "Hz"),
        },
        needs=(("band",), ("frequency",)),
    ),
    "synthesis": Section(
        "Modal coupling of parts that are models, beside the exact answer.",
        {
            "count": Key("whole", "modes of the whole", "10", low=1),
            "keep": Key("wholes", "modes kept of each part; one column each", "none"),
            "methods": Key("texts", "see `mouse list reductions`", "all"),
        },
    ),
    "modify": Section(
        "Changes of one model; `mouse modify` answers.",
        {
            "deck": Key("path", "deck of the model, below the folder of this one", required=True),
            "changes": Key("list connection", "what is added; negative masses and springs are taken away", "none"),
            "targets": Key("list target", "which mass or spring moves a mode to a frequency", "none"),
            "sweeps": Key("list sweep", "one mass, spring or absorber tried at every location", "none"),
            "places": Key("dofs", "locations that targets and sweeps try", "all degrees of freedom that translate"),
            "responses": Key("dofs", "where FRFs are requested", "no functions"),
            "forces": Key("dofs", "where forces act", "where responses are"),
            "lines": Key("section lines", "frequencies of the functions"),
            "kind": _KIND,
            "count": Key("whole", "modes of the answer", "10", low=1),
        },
    ),
    "target": Section(
        "A frequency for a mode.",
        {
            "mode": Key("whole", "number of the mode, rigid-body modes counted", required=True, low=1),
            BELOW: Key("number", "it is to lie there or lower", "", "Hz", low=0),
            ABOVE: Key("number", "it is to lie there or higher", "", "Hz", low=0),
            EXACTLY: Key("number", "it is to lie there", "", "Hz", low=0),
            "by": Key("choice", "a mass, or a spring to the ground", MASS, choices=(MASS, SPRING)),
            "place": Key("text", "degree of freedom", "every location, one by one"),
        },
        needs=((BELOW,), (ABOVE,), (EXACTLY,)),
    ),
    "sweep": Section(
        "One change tried at every location.",
        {
            "mode": Key("whole", "number of the mode, rigid-body modes counted", required=True, low=1),
            "by": Key("choice", "what is tried", MASS, choices=(MASS, SPRING, ABSORBER)),
            "size": Key("number", "mass of mass or absorber, stiffness of the spring", "", "kg or N/m", required=True),
        },
    ),
}
