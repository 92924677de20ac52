"""MD3xx: rules that every deck obeys, whatever its format."""

from mouse_cli.codes import Code

CODES = {
    "MD301": Code(
        "index outside the matrix",
        "A row or column number of K, M, A or of a listed element is below 1 or above the order of that matrix. Rows of A "
        "are listed elements, columns of A are properties; both count from 1.",
        "Correct the index, or the order of the model.",
    ),
    "MD302": Code(
        "not a finite number",
        "A value is infinite, not a number, or so large that no products can be made of it (1e150 and more).",
        "Give a finite number.",
    ),
    "MD303": Code(
        "element given twice",
        "K and M are symmetric, so that (i,j) and (j,i) are one element. Two equal values are harmless and only warned of; two "
        "different ones contradict each other.",
        "Give each element once, in the upper triangle.",
    ),
    "MD304": Code(
        "mass not positive",
        "Every diagonal element of M must be positive, and so must be the mass of every motion: a degree of freedom, or a motion, "
        "without mass has an infinite eigenvalue. As a warning: translations of a structure that have stiffness and no mass, which "
        "follow the masses statically.",
        "Give the mass, or condense the degree of freedom out of the model.",
    ),
    "MD305": Code(
        "element below the diagonal",
        "A listed element has its row after its column; it is taken as its mirror image.",
        "List the upper triangle.",
    ),
    "MD306": Code(
        "element listed twice", "Each element that may vary is listed once (group RS).", "Delete the repetition."
    ),
    "MD307": Code("partial derivative given twice", "One element of A is given twice.", "Give each element of A once."),
    "MD308": Code(
        "element that no property moves",
        "A listed element has a row of zeros in A: no property changes it, so listing it has no effect.",
        "Give its row of A, or leave it out of the list.",
    ),
    "MD309": Code(
        "property that moves nothing",
        "A property has a column of zeros in A: it changes no element of K or M, so no test can revise it.",
        "Give its column of A, or leave the property out.",
    ),
    "MD310": Code("name used twice", "Two parameters have one name.", "Give each parameter its own name."),
    "MD311": Code(
        "standard deviation of a property",
        "The standard deviation of a property must be positive, or 0 to hold the property at its prior value.",
        "Give the standard deviation in the unit of the property.",
    ),
    "MD312": Code(
        "property without standard deviation",
        "A property whose standard deviation is 0 is certain: it stays at its prior value whatever the test.",
        "Give a standard deviation if the property may vary.",
    ),
    "MD313": Code(
        "prior value outside its limits",
        "The nominal value of a parameter must lie between its lower and upper limit, and these must differ.",
        "Give lower < upper with the nominal value between them.",
    ),
    "MD314": Code(
        "logarithm of a value that is not positive",
        "transform: log estimates the logarithm of the parameter, which needs a positive nominal value.",
        "Give a positive nominal value, or transform: identity.",
    ),
    "MD315": Code(
        "logarithm with fixed total mass",
        "Holding the total mass is a linear condition on the parameters; it cannot be kept exactly for logarithms.",
        "Use lower: 0 instead of transform: log.",
    ),
    "MD316": Code(
        "impossible prior covariance",
        "A covariance matrix is symmetric and has no negative eigenvalue.",
        "Check the correlations: each within -1 to 1, and no contradictions among them.",
    ),
    "MD317": Code(
        "degree of freedom of the total mass",
        "fix_total_mass names a degree of freedom that the model has not.",
        "Give numbers from 1 to the order of the model.",
    ),
    "MD320": Code(
        "mode number",
        "Mode numbers are system mode numbers, rigid-body modes counted, strictly ascending and at most the order of the model.",
        "Give the number of each measured mode in ascending order.",
    ),
    "MD321": Code("frequency not positive", "A test frequency is zero, negative or infinite.", "Give it in Hz."),
    "MD322": Code(
        "frequencies not ascending",
        "Measured modes are given in ascending order of frequency.",
        "Sort the modes; their shapes and accuracies follow.",
    ),
    "MD323": Code(
        "measured degree of freedom outside the model",
        "A measured point is a degree of freedom of the model, counted from 1.",
        "Correct the number.",
    ),
    "MD324": Code("degree of freedom measured twice", "Each measured point is named once.", "Delete the repetition."),
    "MD325": Code(
        "accuracy of a frequency",
        "The standard deviation of a frequency must be positive, in Hz: 0 would make a certain datum.",
        "Give what repeats of the test show.",
    ),
    "MD326": Code(
        "accuracy of a shape component",
        "The standard deviation of a shape component must be positive, in the units of the shape.",
        "Give what repeats of the test show.",
    ),
    "MD327": Code("test without data", "The test holds neither a frequency nor a shape component.", "Give one."),
    "MD328": Code(
        "sensor that reads nothing",
        "The position of a sensor cannot move in its direction: the model has no such direction, the point lies on a support, or "
        "all weights are 0. The sensor would read 0 whatever the model does. A sensor on the node of a support is no error: it "
        "reads 0 of the model as it is, and the motion of a support that is flexible. A force that a support takes is one.",
        "Correct its node, point or direction, mount it on the node of the support, or leave it out.",
    ),
    "MD329": Code(
        "sensor at a position that the model does not have",
        "A sensor is mounted on a node that the model does not have, or on a node or point of a model of bare matrices.",
        "Correct the node; for bare matrices give weights of degrees of freedom.",
    ),
    "MD335": Code(
        "sensor far from the structure",
        "The point of a sensor lies farther from the nearest element than that is long (without elements: farther from the nearest "
        "node than its neighbours are). The sensor is taken to move with it as if a rigid arm joined them. As an error: all "
        "sensors together are as small or as large against the structure as another unit of length would make them.",
        "Check the coordinates, their order and their unit, that of the nodes.",
    ),
    "MD330": Code(
        "rigid-body mode named as measured",
        "A mode number of the test belongs to a mode of zero frequency: its accuracy would become a zero variance. Mode numbers "
        "count the rigid-body modes.",
        "Add the number of rigid-body modes to the mode numbers.",
    ),
    "MD331": Code(
        "shape unrelated to the model's",
        "A measured shape is nearly orthogonal to the model's mode that it is paired with, so that it cannot be brought to its "
        "scale. Where most modes of a test are the model's, `mouse check` warns of it: `mouse run` refuses such a test, "
        "`mouse diagnose` does not.",
        "Check mode numbers and the order of the points. If they are right, the model lacks what makes the mode: `mouse diagnose`.",
    ),
    "MD332": Code(
        "more rigid-body modes than in 1972",
        "The program of 1972 allowed three rigid-body modes; --legacy enforces that.",
        "Run without --legacy.",
    ),
    "MD336": Code(
        "close modes put in order",
        "Two frequencies do not ascend, and differ by less than three standard deviations of their difference: noise has put close "
        "modes out of order. They are sorted, each with its shape; mode numbers stay as they are.",
        "Nothing; or write them in ascending order.",
    ),
    "MD334": Code(
        "unknown estimator",
        "The deck names an estimator that neither mouse nor an installed plug-in has.",
        "Choose one that `mouse list estimators` shows.",
    ),
    "MD333": Code(
        "deck without a test",
        "`mouse run` revises a model by a test, and the deck has none.",
        "Add `test:`; `mouse modes` needs none.",
    ),
}
