"""Keys of `modal_damping:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section

SECTIONS = {
    "modal_damping": Section(
        "Viscous damping by ratios of the modes of the nominal model, for models of up to 400 degrees of freedom.",
        {
            "ratio": Key(
                "sds",
                "damping ratio of all elastic modes, such as `1 %`; or a list, from the lowest on, the last of all above",
                required=True,
            ),
            "sd": Key(
                "sd", "of each ratio, which is then estimated: a share of it, such as `100 %`", "ratios are held"
            ),
        },
    ),
}
