"""MD690 to MD691: several arrangements of one structure."""

from mouse_cli.codes import Code

CODES = {
    "MD690": Code(
        "configurations differ in their parameters or model errors",
        "Several decks given to `mouse diagnose` are configurations of one structure: they may differ in positions, known "
        "changes and tests. Their parameters must be the same, by name, nominal value, standard deviation and transform, and so "
        "must `theory`.",
        "Write the same `parameters`, `prior` and `theory` in every deck.",
    ),
    "MD691": Code(
        "a configuration without measured modes",
        "Several configurations are diagnosed by their measured modes: one of the decks has no `test.modes`, or holds some of its "
        "own test out, which is done for whole configurations (`--held-out`).",
        "Give measured frequencies in every deck; `mouse identify` makes them of recordings and functions.",
    ),
}
