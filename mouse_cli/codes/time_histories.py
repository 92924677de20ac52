"""MD64x: recordings that cannot be simulated."""

from mouse_cli.codes import Code

CODES = {
    "MD641": Code(
        "law of a local force not understood",
        "An entry of `laws` names sizes or a variant that its law does not have, or degrees of freedom that the model has not.",
        "`docs/reference/yaml.md` lists laws, variants and sizes; give one degree of freedom (against the ground) or two.",
    ),
    "MD642": Code(
        "modes without the local laws of the deck",
        "The deck has `laws`, forces that are not linear. Modes, and an update by modes or by frequency response functions, are "
        "those of the linear structure without them.",
        "Nothing, where that is meant: clearances open, small motion. `mouse run` and `mouse diagnose` take laws into account "
        "where the test holds recordings alone.",
    ),
    "MD643": Code(
        "option without meaning for this test",
        "An option of `mouse run`, or a key of `run:`, does nothing here: `pairing` and `scale` are of modes, and a run on "
        "recordings alone is a fit of simulations that has none of the options of the runs of 1972 and after.",
        "Leave it out. Estimator, limits and convergence of such a fit are fixed: the posterior mode, its steps taken to the end.",
    ),
    "MD644": Code(
        "motion of the ground not understood",
        "The motion of what holds the model (`ground`, `groundTX`) stands among the outputs, or is given as a force, or no degree "
        "of freedom moves along with it. Or an output is declared relative to a ground that no input measures. Or it is an "
        "absolute displacement or velocity, while of the ground only a higher derivative is known.",
        "Name the motion of the ground under `inputs`, with its quantity or unit; give `moves`, what it carries along, and with "
        "`frame` whether outputs are absolute or relative.",
    ),
    "MD645": Code(
        "free decay with inputs",
        "A recording with `free_decay: true` moves by its initial state alone; inputs are forces, or motions of the ground, that "
        "act.",
        "Delete `free_decay` where something acts during the recording, or `inputs` where nothing does, with a `segment` that "
        "begins after the force has ended.",
    ),
    "MD646": Code(
        "gain or delay of a channel that cannot be estimated",
        "`gain_sd` or `delay_sd` asks for an error of a channel that records do not show: delays are those of outputs behind the "
        "inputs; and where the ground moves, its measured motion is taken off the outputs before any fit.",
        "State `delay_sd` for outputs alone; with a moving ground delete both, and correct the channels beforehand.",
    ),
    "MD540": Code(
        "simulation that does not stay finite",
        "The deck as it is, simulated under the measured force of its recordings, grows beyond all bounds.",
        "Check the sizes of its laws (a softening spring that overcomes the stiffness?) and the units of the force channels.",
    ),
    "MD640": Code(
        "recording that cannot be simulated",
        "Diagnosis by recordings simulates the model under the measured force. A record of the deck has no channel of a force or "
        "moment at a degree of freedom of the model and is no free decay, or has none of a motion: displacement, rotation or "
        "their derivatives.",
        "Name force and responses under inputs and outputs with their quantity and unit, or state `free_decay: true` where no "
        "force acts; `mouse identify` does without.",
    ),
}
