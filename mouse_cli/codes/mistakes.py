"""MD450 to MD459: values in another unit than the deck's, and other slips that only their size shows."""

from mouse_cli.codes import Code

CODES = {
    "MD450": Code(
        "the test in other units than the model",
        "All measured frequencies are one common factor away from those of the model, or become equal to them once a value of the "
        "deck is read in another unit: rad/s, rpm or kHz instead of Hz, E in MPa, density in g/cm3, sections in mm4, springs in "
        "N/mm. The prior of the parameters is taken into account: it shows that no value they may have explains that. The "
        "message names what fits best, the note what fits as well.",
        "Follow the message. If the model is meant to be so far off, give a parameter a prior that allows for it.",
    ),
    "MD451": Code(
        "a property that no material and no section has",
        "Young's modulus and density together belong to no material, or a cross section does not go with its own area or with the "
        "length of the structure, while in another unit they would.",
        "Write the value that the message gives, or declare the units of the deck with `units:`.",
    ),
    "MD452": Code(
        "impossible Poisson's ratio",
        "Poisson's ratio of isotropic material lies above -1 and is at most 0.5, else its shear modulus would be negative or the "
        "material would swell under pressure.",
        "Give a ratio such as 0.3; for a material that is not isotropic give G.",
    ),
    "MD453": Code(
        "a standard deviation that hardly can be meant",
        "A standard deviation is so small against its value that nothing is known so well, or as large as the value: a number "
        "was written where a percentage was meant, or the other way round. A plain number is in the unit of the value.",
        "Write `5 %` for a percentage, else check the number and its unit.",
    ),
    "MD454": Code(
        "shapes that fit in another reading of the sensors",
        "The measured shapes are unlike those of the model, and like them once their signs are left out of the comparison, two "
        "directions are exchanged, the nodes are numbered one on, or a sensor is in another unit than the rest.",
        "Follow the message, and mend the table or `dofs`.",
    ),
    "MD455": Code(
        "two modes that may be one",
        "Two measured modes have nearly one frequency and one shape, as where the peak of one mode was taken twice, or where all "
        "sensors look in one direction.",
        "Give the mode once, or measure what the two modes differ in.",
    ),
    "MD456": Code(
        "functions that fit in another reading",
        "At their resonances the measured frequency response functions are one common factor away from those of the model, in "
        "every mode alike, which another unit of response or force, another kind (receptance, mobility, accelerance), a reversed "
        "sign or a force at another degree of freedom explains; or their phases turn as those of negative damping do; or a "
        "channel of phases or magnitudes holds what no such channel can. `diagnose` looks for the former.",
        "Follow the message: mend `unit`, `kind`, `input` or the channel that is named.",
    ),
    "MD457": Code(
        "recordings that fit in another reading",
        "The linear model, its parameters free within their prior, leaves most of a recording unexplained and little of it in "
        "another reading: all channels of one quantity in another unit, motions of another kind (displacement, velocity, "
        "acceleration), one of them at another scale, two channels exchanged, the force elsewhere, or another sample rate; outputs "
        "that lose what is slow (AC coupling), and on a shake table a channel, or the table's, at another scale or late.",
        "Follow the message: mend `unit`, `quantity`, `sample_rate`, or the sensor that a channel is given to.",
    ),
}
