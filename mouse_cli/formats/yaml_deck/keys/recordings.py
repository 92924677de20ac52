"""Keys of `test: recordings:` and `test: frf:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.block_window import WINDOWS
from mouse_cli.model.frf_test import FORMS, KINDS, MOST_LINES
from mouse_cli.model.recording import FRAMES, QUANTITIES

_SENSOR = (
    "where: number or label of a degree of freedom, 12-TY, or a name of `sensors`; `ground`, or groundTX, for the motion of what "
    "holds the model; only in a list of channels"
)
_FRF_UNIT = "unit of the values, as (m/s2)/N or g/lbf"
_GAIN = "standard deviation of the gain of a channel, which is then estimated: `2 %`, or 0.02"
_NOISE = (
    "standard deviation of the white noise of a channel, by its rms: `1 %`, or 0.01; that of an input is passed on to what a "
    "simulation predicts"
)
_DELAY = "standard deviation of the delay of an output behind the inputs, which is then estimated"
SECTIONS = {
    "recording": Section(
        "Time histories of a file, or a stretch of them.",
        {
            "file": Key("path", "file at or below the deck: csv, txt, lvm, mat, npz, wav, h5, tdms, uff, unv", required=True),
            "title": Key("text", "what the report and `hold_out` call it", "the name of the file, and its segment"),
            "sample_rate": Key("number", "samples a second", "the value in the file", unit="Hz"),
            "time": Key("text", "channel that holds the time in s", "a column called t or time, where there is one"),
            "segment": Key("span", "first sample and the one after the last, from 0", "the whole file"),
            "inputs": Key(
                "channels", "what excited it, forces or motion of the ground: {sensor: channel, ...}", "none: output only"
            ),
            "outputs": Key("channels", "what it answered: {sensor: channel, ...}", "all channels of a file that names its sensors"),
            "free_decay": Key("flag", "whether no force acts from its first sample on: ring-down, release from rest", "false"),
            "frame": Key("choice", "whether outputs are motions in space or relative to the ground", FRAMES[0], choices=FRAMES),
            "gain_sd": Key("sd", _GAIN, "they are known"),
            "delay_sd": Key("number", _DELAY, "0: they are known", "s"),
            "mains": Key(
                "number", "frequency of a hum: sinusoids of it and its multiples are left out of every fit", "none", "Hz"
            ),
            "drift": Key("number", "frequency below which outputs drift: slower motion is left out of every fit", "none", "Hz"),
        },
    ),
    "channel": Section(
        "A channel of a recording.",
        {
            "sensor": Key("text", _SENSOR),
            "channel": Key("text", "its name in the file, or its number from 1; column 3 of a table A is A[3]", required=True),
            "quantity": Key(
                "choice", "what it measures", "by its unit; else force of inputs, acceleration of others", choices=QUANTITIES
            ),
            "unit": Key("text", "of its numbers: N, kN, lbf, m/s2, mm/s2, g, m, mm, V, ...", "the value in the file"),
            "sensitivity": Key("text", "of a transducer recorded in volts, as 100 mV/g", "none"),
            "frame": Key("choice", "of an output: in space, or relative to the ground", "`frame` of the recording", choices=FRAMES),
            "gain_sd": Key("sd", _GAIN, "`gain_sd` of the recording"),
            "delay_sd": Key("number", _DELAY, "`delay_sd` of the recording", "s"),
            "noise_sd": Key("sd", _NOISE, "the floor of its spectrum"),
            "moves": Key(
                "sensor weights",
                "of the ground: degrees of freedom that it carries along as a rigid body, and by how much",
                "all of its direction by 1; of a model of matrices without labels all",
            ),
        },
    ),
    "frf": Section(
        "Frequency response functions for e^(+i omega t); entries of one title are one measurement.",
        {
            "file": Key("path", "file below the folder of the deck: csv, txt, mat, npz, h5, uff, unv", "none: given here"),
            "title": Key("text", "what the report and `hold_out` call it", "the name of the file"),
            "kind": Key(
                "choice", "displacement, velocity or acceleration per force", "by `unit`, or as in the file", choices=tuple(KINDS)
            ),
            "unit": Key("text", _FRF_UNIT, "the value in the file, else units of the deck"),
            "frequency": Key(
                "text or numbers", "channel of the frequencies, or they themselves", "one called f, freq, ..., else the first", "Hz"
            ),
            "input": Key("text", "where the force acts, for a file that does not state it: a sensor as in `outputs`"),
            "inputs": Key("renames", "forces of a file that names them: {sensor: name in the file}", "all, under their names"),
            "outputs": Key(
                "functions", "{sensor: channel, ...}; of a file that names them {sensor: its name}", "all, under their names"
            ),
            "band": Key("pair", "lowest and highest frequency that is used", "all lines", "Hz"),
            "sd": Key(
                "accuracy",
                "of the real and the imaginary part; a percentage is of the magnitude, a list the sum of both: without a floor of "
                "their noise antiresonances are as accurate as a percentage of nearly nothing",
                "by coherence and averages, if known",
            ),
            "form": Key(
                "choice", "what is fitted: the functions, ln of their magnitudes, or that and their phases", FORMS[0], choices=FORMS
            ),
            "lines": Key(
                "whole", "most lines that are fitted: half evenly over the band, half where resonances are", str(MOST_LINES), low=1
            ),
            "gain_sd": Key(
                "sd", "of the gain of each response and of each force, which are then estimated: `2 %`, or 0.02", "they are known"
            ),
            "decay_rate": Key(
                "number", "a of an exponential window e^(-a t) on force and response", "the value in the file, else 0", "1/s", low=0
            ),
            "window": Key(
                "choice",
                "of the blocks that H1 averaged: the model is compared with the resonances that it broadens and lowers",
                "the value in the file; else none: lines as of the structure itself",
                choices=WINDOWS,
            ),
            "block": Key("number", "length of those blocks", "the value in the file, else 1 / spacing of lines", "s", low=0),
            "burst": Key(
                "number",
                "share of each block, from its beginning, in which the force acts: 1 for a stationary random one, less for burst "
                "random, 0 for a blow of a hammer",
                "1",
                low=0,
            ),
            "averages": Key("number", "effective number of independent averages, which makes accuracies of coherences", low=1),
        },
    ),
    "function": Section(
        "The values of one response: complex, in two parts, or as magnitude and phase; each a channel of the file or a list.",
        {
            "sensor": Key("text", _SENSOR),
            "value": Key("text or texts", "complex numbers such as 0.1+0.2j"),
            "real": Key("text or numbers", "real part"),
            "imag": Key("text or numbers", "imaginary part"),
            "magnitude": Key("text or numbers", "magnitude"),
            "magnitude_db": Key("text or numbers", "magnitude, 20 log10 of it in `unit`", unit="dB"),
            "phase": Key("text or numbers", "phase", unit="degrees"),
            "phase_rad": Key("text or numbers", "phase", unit="rad"),
            "coherence": Key("text or numbers", "coherence, 0 to 1", "unknown"),
        },
        needs=(
            ("value",), ("real", "imag"), ("magnitude", "phase"), ("magnitude", "phase_rad"), ("magnitude_db", "phase"),
            ("magnitude_db", "phase_rad"),
        ),
    ),
}  # fmt: skip
