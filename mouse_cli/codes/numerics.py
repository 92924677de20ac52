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
        "After the test the standard deviation of the property is what it was before: the data say nothing of it.",
        "Measure a mode or a point that it moves; `mouse run --print-partials` shows which do.",
    ),
    "MD503": Code(
        "properties determined only together",
        "Two properties are correlated so strongly after the test that only a combination of them is known.",
        "Trust the combination, not the single values; measure something that tells them apart.",
    ),
    "MD504": Code(
        "property at its limit",
        "The data pull the property beyond its limit. Its revised standard deviation has no meaning there.",
        "If the limit is physical, something else is missing in the model.",
    ),
    "MD505": Code(
        "property lost its sign",
        "A property that was positive before the test came out zero or negative.",
        "Use transform: log or lower: 0 if it cannot be negative; doubt the form of the model.",
    ),
    "MD506": Code(
        "shape compared with another mode",
        "A measured shape looks like another model mode than the one of its number.",
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
    "MD511": Code(
        "plug-in that cannot be used",
        "A distribution registers a member under an entry point of mouse, but it cannot be loaded, or has no `key`. The entry "
        "point must name the object itself, e.g. `package.module:ESTIMATOR`.",
        "Mend or uninstall the distribution that is named.",
    ),
    "MD512": Code("out of memory", "The model is too large for this machine.", "Use sparse matrices and fewer modes."),
}
