"""MD65x, MD68x: modal identification of recordings and frequency response functions."""

from mouse_cli.codes import Code

CODES = {
    "MD650": Code(
        "no mode found",
        "No pole stayed where it was while the order of the model rose, or none of those that did improved the fit more than "
        "noise would. `mouse identify` lists the rejected ones with reasons.",
        "Check the stabilisation diagram (--plot); choose another --band, or measure for longer.",
    ),
    "MD651": Code(
        "too few lines or samples",
        "Modal identification takes at least 16 spectral lines in the band; for output-only records so many samples that the "
        "scatter of their correlations can be seen.",
        "Take finer lines (mouse spectra --lines), a wider --band, or a longer record.",
    ),
    "MD652": Code(
        "mode at or beyond the edge of the band",
        "The half-power bandwidth of a mode reaches beyond the lines used, or a pole outside of the band was needed to fit those "
        "within. Its frequency and damping are not to be trusted, and it is left out; modes near it may suffer.",
        "Move the edge away from the resonance with --band, or measure there.",
    ),
    "MD653": Code(
        "resonance narrower than the spacing of the lines",
        "The half-power bandwidth of a mode holds fewer than two spectral lines. Its damping rests on the flanks alone, and "
        "leakage of a window would have broadened it.",
        "Measure with finer lines: longer blocks, a zoom, or a periodic excitation.",
    ),
    "MD654": Code(
        "poor fit near a mode",
        "Near the mode the fitted functions differ from the measured ones by more than a third of their size. Something else "
        "than this mode is there: another mode, a nonlinearity, or noise.",
        "Check the fit (--plot) and the coherence there.",
    ),
    "MD655": Code(
        "sets that are not one test",
        "Sets of functions are repeats of one measurement, or have different forces; they share their lines, their responses and "
        "their kind. Recordings without forces share their responses and their sample rate. These do not.",
        "Identify those that are alike by themselves: give these files alone, or of a deck `--recording TITLE`. For "
        "`mouse diagnose --recordings` give those of each set-up a folder of their own.",
    ),
    "MD656": Code(
        "functions of another kind than stated",
        "The residues of all modes are turned by about 90 degrees from those of a structure: accelerance that is mobility, or "
        "the other way round, does that.",
        "Correct `kind` or the unit of the channels.",
    ),
    "MD657": Code(
        "driving point of the wrong sign",
        "Where the force acts, a structure yields along it: the residue of the driving point has the phase of the force for all "
        "modes. Here it does not: sensor or force cell look the other way, or are not at one point.",
        "Turn the sign of one of them (12-TY in the deck), or do not name both alike.",
    ),
    "MD658": Code(
        "fit errs more than the stated noise",
        "The errors of the fit are larger than the variances of the FRFs: a mode is missing in the model, the structure "
        "is not linear or changed during the test, or windows leak. Where they are, the standard deviations were raised to them.",
        "Trust the raised standard deviations, or find what the modes do not explain.",
    ),
    "MD659": Code(
        "nothing to identify",
        "The source holds neither recordings nor frequency response functions, or nothing that can be used as such.",
        "Give a file of functions or of time histories, or a deck with `test: {frf: ...}` or `test: {recordings: ...}`.",
    ),
    "MD681": Code(
        "two modes in one bandwidth, perhaps",
        "Near a mode the fit leaves errors that have its resonance, but are no multiple of its shape: a second mode much less "
        "than a bandwidth away, which one force could not separate from it. A structure that is not linear, or changed during the "
        "test, leaves such errors too.",
        "Measure with a force at another point as well: two columns separate modes a tenth of a bandwidth apart. Compare two "
        "levels of force.",
    ),
    "MD680": Code(
        "functions without modes",
        "A diagnosis by frequency response functions first seeks mechanisms by the modes identified from them; none were found.",
        "Check the result of `mouse identify` on the same deck, or give measured modes besides the FRFs (test.modes).",
    ),
    "MD682": Code(
        "short record of outputs alone",
        "Outputs alone are identified by their correlations, averaged over blocks whose scatter gives the standard deviations. "
        "This record takes shorter correlations, in fewer blocks, than usual: modes close to one another may run into one, weak "
        "ones stay unseen, and standard deviations are rough.",
        "Record for longer, or give repeats with the same channels: their correlations are averaged.",
    ),
    "MD683": Code(
        "free decay that leaves more than noise",
        "What the damped vibrations leave of a free decay is larger while the motion is large. Noise stays as it is: the force "
        "still acted at the beginning, frequency or damping depend on the amplitude, or a mode is missing. Standard deviations "
        "do not hold.",
        "Begin later (`--segment`), and compare the modes of the loud part with those of the quiet one.",
    ),
    "MD684": Code(
        "sweep without a measured force",
        "The responses are one frequency that passes through the band: a machine that runs up or down, a swept sine whose force "
        "was not recorded. Output-only identification takes the force for broadband, which holds for a slow passage, but not at "
        "the frequency at which it begins or ends: the jump of the response there looks like a resonance, and hides one that is "
        "near. What is found there is left out.",
        "Begin and end the sweep away from resonances, or record the force too.",
    ),
}
