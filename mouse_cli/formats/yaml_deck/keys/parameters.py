"""Keys of `parameters:`, `elements:` and `prior:`."""

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.parameter import TRANSFORMS

SECTIONS = {
    "elements": Section(
        "Order of the varying elements, in which their partial derivatives are printed; default: as the "
        "parameters name them, stiffness first.",
        {
            "stiffness": Key("pairs", "elements of K as [row, column]", "[]"),
            "mass": Key("pairs", "elements of M as [row, column]", "[]"),
        },
    ),
    "parameter": Section(
        "One property of the structure: a property of elements, such as E; or a matrix, with "
        "K = K0 + (value - nominal) x its stiffness, and M likewise.",
        {
            "name": Key("text", "what the printout calls it", required=True),
            "nominal": Key("number", "value before the test", "that of its elements, 1 for a factor; else 0, a change"),
            "unit": Key("text", "unit of the value", "empty"),
            "sd": Key(
                "sd",
                "prior standard deviation; a percentage is of the nominal value; 0 holds the parameter",
                "required, unless prior.covariance or power_of is given",
            ),
            "lower": Key("number", "least value allowed", "none"),
            "upper": Key("number", "largest value allowed", "none"),
            "transform": Key("choice", "log keeps the value positive", "identity", choices=TRANSFORMS),
            "power_of": Key(
                "power",
                "instead of nominal, sd, limits and transform: it is a power of another parameter, which has transform: log",
                "none",
            ),
            "stiffness": Key("triples or file", "dK/d(parameter): [row, column, value], upper triangle", "[]"),
            "mass": Key("triples or file", "dM/d(parameter): [row, column, value], upper triangle", "[]"),
            "elements": Key("ids", "the elements of a structure whose property it is; or all"),
            "material": Key("text", "instead: the material whose property it is, wherever elements take it from there"),
            "section": Key("text", "instead: the cross section whose property it is"),
            "property": Key("word or words", "property, such as E; several move together as a factor of each"),
            "each": Key(
                "whole", "a parameter for every so many of the elements, named after them", "one for all", low=1
            ),
            "factor": Key("flag", "it multiplies what the elements have", "false, unless the elements differ"),
        },
    ),
    "prior": Section(
        "Correlation of the parameters before the test, in one of three forms.",
        {
            "correlation": Key("square", "whole correlation matrix, in the order of the parameters"),
            "correlations": Key("links", "correlated pairs, by name; the rest is 0"),
            "covariance": Key("square", "whole covariance matrix; its diagonal replaces sd"),
        },
        forms=(("correlation",), ("correlations",), ("covariance",)),
    ),
}
