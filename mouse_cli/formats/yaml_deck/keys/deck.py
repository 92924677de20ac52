"""Top-level keys of a deck."""

from mouse_cli.formats.yaml_deck.kinds import VERSION, Key, Section
from mouse_cli.model.units import SYSTEMS

SECTIONS = {
    "deck": Section(
        "The whole deck.",
        {
            "mouse": Key("whole", "version of the format", required=True, low=VERSION, high=VERSION),
            "title": Key("text", "heading of the printout", "empty"),
            "source": Key("text", "where the deck or its numbers come from", "empty"),
            "units": Key(
                "choice", "units of length, mass and force; time is in s", "not declared", choices=tuple(SYSTEMS)
            ),
            "model": Key("section model", "the matrices before the test"),
            "couple": Key("section couple", "instead of a model: substructures, for `mouse couple`"),
            "modify": Key("section modify", "instead of a model: changes of another deck's, for `mouse modify`"),
            "modal_damping": Key(
                "section modal_damping", "damping by ratios of modes", "that of elements and matrices alone"
            ),
            "laws": Key("list law", "local forces that are not linear", "none"),
            "elements": Key("section elements", "order in which the varying elements are listed (RS)", "see below"),
            "parameters": Key("list parameter", "what may be revised: one entry is one column of A", "none"),
            "prior": Key("section prior", "how the parameters are correlated before the test", "uncorrelated"),
            "test": Key("section test", "what was measured", "none: the deck is used for modes only"),
            "theory": Key("section theory", "how wrong the model may be beside what is missing", "the defaults below"),
            "run": Key("section run", "how to run", "the defaults below"),
        },
        needs=(("model",), ("couple",), ("modify",)),
    ),
}
