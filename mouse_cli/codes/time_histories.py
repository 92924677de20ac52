"""MD64x: recordings that cannot be simulated."""

from mouse_cli.codes import Code

CODES = {
    "MD641": Code(
        "law of a local force not understood",
        "An entry of `laws` names sizes or a variant that its law does not have, or degrees of freedom that the model has not.",
        "`docs/reference/yaml.md` lists laws, variants and sizes; give one degree of freedom (against the ground) or two.",
    ),
    "MD640": Code(
        "recording that cannot be simulated",
        "Diagnosis by recordings simulates the model under the measured force. A record of the deck has no channel of a force at a "
        "degree of freedom of the model, or none of a displacement, velocity or acceleration.",
        "Name force and responses under inputs and outputs with their quantity and unit; `mouse identify` does without.",
    ),
}
