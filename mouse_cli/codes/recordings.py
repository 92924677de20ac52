"""MD6xx: recordings and frequency response functions."""

from mouse_cli.codes import Code

CODES = {
    "MD600": Code(
        "no such channel",
        "The deck or the command line names a channel that the file does not hold, or a name that several channels have.",
        "Give a name of the message, or the number of the channel, counted from 1. Column 3 of a table `A` of a MAT, NPZ or "
        "HDF5 file is `A[3]`; a field of a struct is `struct.field`.",
    ),
    "MD601": Code(
        "no measured data in the file",
        "The file could be read, but holds no vector, table or function of numbers.",
        "Give the file of the recording; export text as columns of numbers.",
    ),
    "MD602": Code(
        "sample rate unknown",
        "The sample rate is unknown: neither the deck, nor the file, nor an evenly spaced time column gives it.",
        "Give `sample_rate` in Hz, or name the time column with `time`.",
    ),
    "MD603": Code(
        "sample rates contradict each other",
        "The deck, the file and its time column, or two channels of one recording, give sample rates that differ by more than a "
        "thousandth. All frequencies and dampings are proportional to it.",
        "Find out which is right, and correct or delete the other.",
    ),
    "MD604": Code(
        "samples missing",
        "The time column leaps: samples were dropped while recording, or several recordings were joined, or time runs backwards "
        "or stands still. Spectra over such a gap are wrong.",
        "Use a stretch without a leap: `segment: [first, last]`, samples counted from 0, the last one not included.",
    ),
    "MD605": Code(
        "gap in the samples",
        "Samples are empty, NaN or infinite.",
        "Use a stretch without gaps: `segment: [first, last]`. In functions write null where nothing was measured.",
    ),
    "MD606": Code(
        "channel clipped",
        "Samples stand still at the largest or the smallest value of the channel, reached at once from well below: the amplifier "
        "or the converter was overloaded. Clipping makes harmonics that resemble a nonlinear structure.",
        "Measure again with a wider range, use a stretch without it, or leave the channel out.",
    ),
    "MD607": Code(
        "channel dead or constant",
        "All samples of the channel are the same.",
        "Leave the channel out; look for a broken cable or a wrong channel number.",
    ),
    "MD608": Code(
        "lengths differ",
        "Channels of one recording have different numbers of samples, or parts of one function different numbers of lines.",
        "Record them together, or cut the file to what they share.",
    ),
    "MD609": Code(
        "impossible segment",
        "`segment: [first, last]` takes samples first up to but without last, counted from 0; it does not lie within the file.",
        "Give 0 <= first < last <= number of samples.",
    ),
    "MD610": Code(
        "units contradict each other",
        "The deck states one unit or quantity of a channel or FRF and its file another, or a unit does not belong to the "
        "quantity. g for m/s2 is a factor of 9.80665 in every mass and stiffness.",
        "Delete `unit` where the file is right; else correct it.",
    ),
    "MD611": Code(
        "unit not understood",
        "The unit is none that is known, or volts without a sensitivity, or the kind of FRF that was measured is not stated.",
        "Units that are converted: N, kN, lbf; m/s2, mm/s2, g; m/s; m, mm, in; rad; N m; Pa; and V with `sensitivity: 100 mV/g`.",
    ),
    "MD612": Code(
        "no unit given",
        "Neither deck nor file states the unit of a channel; the units of the deck, SI where it declares none, were taken.",
        "Give `unit`.",
    ),
    "MD613": Code(
        "channel stands still",
        "For many samples in a row the channel keeps one value that is neither zero nor an extreme: the transmission stopped.",
        "Use a stretch before or after it.",
    ),
    "MD614": Code(
        "lines do not fit",
        "Frequencies must ascend from 0 on, be the same in all functions of one measurement, and some must lie in `band`.",
        "Name the channel of the frequencies, and give measurements that differ titles of their own.",
    ),
    "MD615": Code(
        "complex where real is expected",
        "The channel holds complex numbers, and a real part, a magnitude, a phase or samples in time are expected.",
        "Name it as `value`, or give the right channel.",
    ),
    "MD616": Code(
        "measured data without a file",
        "A deck names the files of recordings and frequency response functions; those of this problem were read from no deck.",
        "Write them to a file, and name it in the deck.",
    ),
    "MD617": Code(
        "deck away from its recordings",
        "The files that a deck names lie below its folder; those of the deck to be written would not.",
        "Write the deck to the folder of its recordings, or copy them first.",
    ),
    "MD618": Code(
        "no functions of these channels",
        "Frequency response functions are of motion per force: a recording has no input or no output, or a channel of "
        "another quantity.",
        "Name forces as inputs and responses as outputs; leave other channels out.",
    ),
    "MD619": Code(
        "forces that cannot be separated",
        "Several forces moved together, or one of them was zero, or the estimator is defined for one force alone; periodic "
        "excitation needs as many experiments as forces.",
        "Drive the forces with independent signals, or one at a time; use --estimator h1 or hv.",
    ),
    "MD620": Code(
        "recording shorter than a block",
        "Blocks of twice as many samples as lines do not fit into the recording, or after no stroke of the hammer.",
        "Take fewer --lines.",
    ),
    "MD621": Code(
        "double stroke",
        "The hammer hit twice within one block; the spectrum of the force then has zeros. The block is left out.",
        "Hit more briefly, or with a lighter hammer.",
    ),
    "MD622": Code(
        "too few averages",
        "With as many averages as forces every coherence is 1, whatever the noise. Variances are left unknown.",
        "Take fewer --lines, or record for longer.",
    ),
    "MD623": Code(
        "function given twice",
        "One measurement holds two functions of the same response and force, of which the last is used.",
        "Choose one of them, or give repeats titles of their own.",
    ),
    "MD624": Code(
        "no mode shapes",
        "The universal file holds no data set 55 or 2414 of normal or complex modes at nodes.",
        "Export the modes of the analysis as data set 55; functions and time histories belong to `frf` and `recordings`.",
    ),
    "MD625": Code(
        "force window too short",
        "The window that takes the force for 0 after the stroke of a hammer ends before the stroke does; functions are too large.",
        "Give a longer --force-window, or no length: it is found in the strokes.",
    ),
    "MD626": Code(
        "no recording of the model in the folder",
        "No file of the folder has channels that are sensors of the model. A channel is a sensor by its name: that of a sensor in "
        "`test.sensors`, or the label of a degree of freedom, `12TY`; or by an option of the command line.",
        "Map the channels: `--force SENSOR=CHANNEL --response SENSOR=CHANNEL`; or call the sensors of the deck as the channels.",
    ),
    "MD627": Code(
        "file of the folder passed over",
        "The file can be read, but it is no recording of the model: it holds functions, no channel of it is a sensor, or a force "
        "was measured and its location is not stated.",
        "Name channels: `--force SENSOR=CHANNEL`, `--response SENSOR=CHANNEL`.",
    ),
    "MD628": Code(
        "window that weakens a stroke",
        "A block begins with the stroke of the hammer, where windows for random forces are near 0; functions would be of noise.",
        "Leave --window out: with --impact it is uniform; or take --window exponential where the response outlasts the block.",
    ),
}
