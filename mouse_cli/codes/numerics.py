"""MD5xx: what the numbers say, and outputs that could not be written."""

from mouse_cli.codes import Code

CODES = {
    "MD501": Code(
        "prior model not physical",
        "The prior K, M have no real natural frequencies: a negative eigenvalue beyond the rounding of a rigid-body mode, a mass "
        "matrix that is not positive definite, or values too large to compute with.",
        "Check signs and units of K and M.",
    ),
    "MD502": Code(
        "property that the data do not revise",
        "After the test the standard deviation of the property is what it was before: the data do not determine it.",
        "Measure a mode or a point that it moves; `mouse run --print-partials` shows which do.",
    ),
    "MD503": Code(
        "properties determined only together",
        "Two properties are correlated so strongly after the test that only a combination of them is known.",
        "Trust the combination, not the single values; measure something that separates them.",
    ),
    "MD504": Code(
        "property at its limit",
        "The data pull the property beyond its limit. Its revised standard deviation has no meaning there.",
        "If the limit is physical, something else is missing in the model.",
    ),
    "MD505": Code(
        "property lost its sign",
        "A property that was positive before the test came out zero or negative.",
        "Use transform: log or lower: 0 if it cannot be negative; check the form of the model.",
    ),
    "MD506": Code(
        "shape compared with another mode",
        "A measured shape has a higher MAC with another model mode than with the one of its number.",
        "Use --pairing mac, or correct the mode numbers.",
    ),
    "MD507": Code(
        "fit closer than the accuracies",
        "What remains of the data after the fit is far smaller than their stated accuracies: these are overstated, or the data "
        "were computed and not measured.",
        "State the accuracies that repeats of the test show.",
    ),
    "MD508": Code(
        "total mass held in vain",
        "fix_total_mass is set, but no property moves an element of M.",
        "Leave it out.",
    ),
    "MD509": Code(
        "measured mode without partner",
        "No mode of the model is near enough to a measured one in shape and frequency. `mouse correlate` leaves it unpaired; "
        "`mouse run` compares every measured mode with some model mode and warns when the two have nothing in common: MAC "
        "below 0.1 and frequencies more than 50 % apart.",
        "Look for missing physics, or for a mode of the rig; take the mode out of the test until it is understood.",
    ),
    "MD510": Code(
        "model mode that the test did not find",
        "A mode of the model lies in the band of the test, and no measured mode was paired with it.",
        "Look for it in the recordings; excite elsewhere; add a sensor where it moves.",
    ),
    "MD518": Code(
        "functions of a model without damping",
        "Frequency response functions are fitted or predicted, and the model has no damping anywhere: its resonances are "
        "infinite, and lines near a measured resonance pull parameters away from it.",
        "Give elements or a material `loss_factor` (structural), `stiffness_damping` or `mass_damping` (viscous), or dashpots, and "
        "make the amount a parameter with `transform: log`; or give `modal_damping: {ratio: 1 %, sd: 100 %}`; in a deck of "
        "matrices `damping` or `structural_damping`.",
    ),
    "MD519": Code(
        "modal damping of a large model",
        "Damping by ratios of modes makes a full matrix C = M X diag(2 zeta omega) X'M, which large models have no room for.",
        "Give elements or their material a `loss_factor`: a damping ratio at a resonance is half of it.",
    ),
    "MD511": Code(
        "plug-in that cannot be used",
        "A distribution registers a member under an entry point of mouse, but it cannot be loaded, or has no `key`. The entry "
        "point must name the object itself, e.g. `package.module:ESTIMATOR`.",
        "Mend or uninstall the distribution that is named.",
    ),
    "MD517": Code(
        "too large for the memory",
        "Before a large model is factorised, the memory that its factor, the vectors of the eigensolution and the adjoint "
        "solutions will take is estimated from the sparsity pattern. It is more than this machine, or the control group of the "
        "process, has.",
        "Take a machine with more memory, a coarser mesh, or shells and beams instead of solids; fewer modes help a little.",
    ),
    "MD512": Code("out of memory", "The model is too large for this machine.", "Use sparse matrices and fewer modes."),
    "MD513": Code(
        "sensor that does not fit",
        "Turning, exchanging, rescaling or leaving out one sensor raises the MACs of several modes far beyond what noise, or an "
        "error of the model, would explain.",
        "Check mounting, direction, cabling and gain of that sensor; a reversed one is written 12-TY in `dofs`.",
    ),
    "MD514": Code(
        "shapes that cannot be expanded",
        "The sensors and the method leave a motion of the structure undetermined, or the matrices are too ill-conditioned for it.",
        "Use another method of `mouse list expansions`, or more sensors.",
    ),
    "MD515": Code(
        "no static reduction",
        "Held at its sensors the structure can still move without force, so that no static shapes exist.",
        "Measure in those directions too, or rely on the reduction by modes.",
    ),
    "MD516": Code(
        "shapes that the sensors cannot distinguish",
        "Two modes of one side have nearly the same components at the sensors (spatial aliasing). Pairs, MAC and orthogonality of "
        "these modes mean little.",
        "Add sensors where the shapes differ.",
    ),
}
