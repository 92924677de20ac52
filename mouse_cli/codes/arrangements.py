"""MD690 to MD691: several arrangements of one structure."""

from mouse_cli.codes import Code

CODES = {
    "MD690": Code(
        "arrangements differ in their parameters or errors of theory",
        "Several decks given to `mouse diagnose` are arrangements of one structure: what they do not share are places, known "
        "changes and tests. Their parameters must be the same, by name, nominal value, standard deviation and transform, and so "
        "must `theory`.",
        "Write the same `parameters`, `prior` and `theory` in every deck.",
    ),
    "MD691": Code(
        "an arrangement without measured modes",
        "Several arrangements are diagnosed by their measured modes: one of the decks has no `test.modes`, or holds some of its "
        "own test out, which is left to whole arrangements (`--held-out`).",
        "Give measured frequencies in every deck; `mouse identify` makes them of recordings and functions.",
    ),
}
