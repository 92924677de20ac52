"""Keys of `laws:`, made from the library of laws."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.terms.laws import registry

_LAWS = [law for law in registry().values() if law.listed]


def _values() -> dict[str, Key]:
    found: dict[str, Key] = {}
    for law in _LAWS:
        for size in law.parameters:
            meaning = f"{size.name}, of {', '.join(each.key for each in _LAWS if size.key in each.sizes)}"
            found[size.key] = Key("number", meaning, "required by its laws", unit=size.unit, low=0)
    return dict(sorted(found.items()))


SECTIONS = {
    "law": Section(
        "A force that symmetric matrices do not hold: not linear, or gyroscopic. Diagnosis by recordings simulates it; "
        "modes are those of the structure without it.",
        {
            "law": Key("choice", "which law", required=True, choices=tuple(law.key for law in _LAWS)),
            "variant": Key(
                "choice",
                "its sign or side",
                "the first of the law",
                choices=tuple(dict.fromkeys(word for law in _LAWS for word in law.words if word)),
            ),
            "at": Key(
                "texts",
                "one degree of freedom: against the ground; two: of the second relative to the first, or those that a gyroscopic "
                "law couples",
                required=True,
            ),
            "values": Key("section law_values", "its sizes", required=True),
        },
    ),
    "law_values": Section("Sizes of a law, each by its name.", _values()),
}
