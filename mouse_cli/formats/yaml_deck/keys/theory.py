"""Keys of `theory:`; each is a field of Theory, with the default that it has there."""

from dataclasses import fields

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.theory import Theory

SECTIONS = {
    "theory": Section(
        "Errors of theory that `mouse diagnose` allows for beside those of the test: standard deviations as shares, `0.1 %` or "
        "0.001, above 0 and at most 1.",
        {
            each.name: Key("sd", each.metadata["meaning"], f"{100 * each.default:g} %", low=0, high=1)
            for each in fields(Theory)
        },
    ),
}
