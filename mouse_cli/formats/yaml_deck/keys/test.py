"""Keys of `test:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.modal_test import SCALES

_MODES_ONLY = "this release reads measured modes: give test: {modes: ...}"
SECTIONS = {
    "test": Section(
        "What was measured.",
        {"modes": Key("section modes", "natural frequencies and mode shapes", required=True)},
        later={"frf": _MODES_ONLY, "recordings": _MODES_ONLY, "hold_out": _MODES_ONLY},
    ),
    "modes": Section(
        "m measured modes at s degrees of freedom.",
        {
            "number": Key("wholes", "system mode number of each measured mode, rigid-body modes counted", "1 to m"),
            "frequency": Key("maybes", "natural frequencies, null where not measured", unit="Hz", required=True),
            "frequency_sd": Key(
                "sds",
                "their standard deviations; a percentage is of each frequency",
                unit="Hz",
                default="required where a frequency is given",
            ),
            "dofs": Key("dofs", "degrees of freedom of the sensors", "none: frequencies only"),
            "shapes": Key("grid", "mode shapes: one row for each of dofs, one column for each mode", "none"),
            "shape_sd": Key(
                "sd grid",
                "their standard deviations, in the units of shapes; a percentage is of the "
                "largest component of the mode",
                "required with shapes",
            ),
            "scale": Key("choice", "how shapes are brought to the scale of the theory", "fitted", choices=SCALES),
        },
    ),
}
