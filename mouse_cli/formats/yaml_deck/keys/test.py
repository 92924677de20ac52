"""Keys of `test:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.modal_test import SCALES

SECTIONS = {
    "test": Section(
        "What was measured.",
        {
            "sensors": Key("list sensor", "sensors that are no plain degrees of freedom", "none"),
            "modes": Key("section modes", "natural frequencies and mode shapes", "none"),
            "frf": Key("list frf", "frequency response functions", "none"),
            "recordings": Key("list recording", "time histories", "none"),
            "hold_out": Key("section hold_out", "what of it no fit uses", "nothing"),
        },
        needs=(("modes",), ("frf",), ("recordings",), ("sensors",)),
    ),
    "sensor": Section(
        "A sensor with a name of its own, in one of three forms; on a matrix model only the last.",
        {
            "name": Key("text", "what `dofs` and the printout call it", required=True),
            "node": Key("whole", "node on which it is mounted"),
            "at": Key(
                "numbers", "point [x, y, z] at which it is mounted, between nodes or beside an element", unit="m"
            ),
            "direction": Key(
                "sensor direction", "what it reads as positive: TX, -TY, RZ, ..., or a vector [x, y, z] of any length"
            ),
            "weights": Key(
                "sensor weights", "degrees of freedom and their shares in the reading: {5TY: 0.5, 6TY: 0.5}"
            ),
        },
        forms=(("name", "node", "direction"), ("name", "at", "direction"), ("name", "weights")),
    ),
    "modes": Section(
        "m measured modes at s sensors: given here, or in a file.",
        {
            "file": Key(
                "path",
                "universal file whose data sets 55 or 2414 give frequencies and shapes, a labelled table (.csv, .tsv, .txt), or "
                "results of CalculiX (.frd); its sensors are called 12TY, ...; `dofs` chooses among them",
                "none",
            ),
            "mount": Key(
                "choice",
                "what mounts sensors of a universal file: numbers of nodes, or coordinates (data sets 15, 2411 and 2420), in "
                "the unit of length of the deck, between the nodes of the model",
                "numbers",
                choices=("numbers", "coordinates"),
            ),
            "number": Key("wholes", "system mode number of each measured mode, rigid-body modes counted", "1 to m"),
            "frequency": Key("maybes", "natural frequencies, null where not measured", "those of `file`", unit="Hz"),
            "frequency_sd": Key(
                "sds",
                "their standard deviations; a percentage is of each frequency",
                unit="Hz",
                default="required where a frequency is given",
            ),
            "dofs": Key(
                "dofs",
                "where shapes were measured: numbers, labels, reversed labels such as 12-TY, names of sensors",
                "all of `sensors`; without sensors none: frequencies only",
            ),
            "shapes": Key("grid", "mode shapes: one row for each of dofs, one column for each mode", "none"),
            "shape_sd": Key(
                "sd grid",
                "their standard deviations, in the units of shapes; a percentage is of the "
                "largest component of the mode",
                "required with shapes",
            ),
            "scale": Key("choice", "how shapes are brought to the scale of the theory", "fitted", choices=SCALES),
        },
        needs=(("frequency",), ("file",)),
    ),
}
