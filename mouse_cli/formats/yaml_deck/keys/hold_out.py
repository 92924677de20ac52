"""Keys of `test: hold_out:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section

SECTIONS = {
    "hold_out": Section(
        "Data that no fit uses and that a good model predicts: `mouse diagnose` validates by them.",
        {
            "modes": Key("wholes", "mode numbers of the test, as in `number`", "none"),
            "sensors": Key("dofs", "sensors of the test, as in `dofs`", "none"),
            "recordings": Key("texts", "titles of recordings", "none"),
            "segments": Key("list held_segment", "stretches of recordings", "none"),
            "frf": Key("texts", "titles of frequency response functions", "none"),
            "lines": Key("pairs of numbers", "bands of frequency response functions, [lowest, highest]", "none", "Hz"),
            "altered": Key("list altered", "the same structure with masses or springs added", "none"),
        },
    ),
    "held_segment": Section(
        "A stretch of a recording.",
        {
            "recording": Key("text", "title of the recording", required=True),
            "segment": Key("span", "first sample and the one after the last, as its file counts from 0", required=True),
        },
    ),
    "altered": Section(
        "Natural frequencies of the structure after a known change.",
        {
            "title": Key("text", "what the report calls it", required=True),
            "mass": Key(
                "sensor weights", "masses added, {12TY: 0.5}; at a number of a node in all directions", "none", "kg"
            ),
            "spring": Key("sensor weights", "springs to the ground, {12TY: 1e4}", "none", "N/m"),
            "number": Key("wholes", "mode numbers, rigid-body modes counted", "1, 2, ..."),
            "frequency": Key("numbers", "natural frequencies", unit="Hz", required=True),
            "frequency_sd": Key(
                "sds", "their standard deviations; a percentage is of each frequency", unit="Hz", required=True
            ),
        },
    ),
}
