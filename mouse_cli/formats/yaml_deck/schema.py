"""Every key of a YAML deck, once, as data: for the reader, the JSON Schema and the reference table."""

from dataclasses import dataclass
from typing import Any

from mouse_cli.formats.matrix_files import MAX_ORDER
from mouse_cli.model.modal_test import SCALES
from mouse_cli.model.parameter import TRANSFORMS
from mouse_cli.model.problem import CONFIDENCES, CONVERGENCE_RULES, PAIRINGS, RECURSIONS, STEPS, RunOptions

VERSION = 1
MAX_WHOLE = 2**31 - 1

PERCENT = r"^\s*[0-9]*\.?[0-9]+([eE][-+]?[0-9]+)?\s*%\s*$"
_NUMBER = {"type": "number"}
_WHOLE = {"type": "integer"}
_PERCENT = {"type": "string", "pattern": PERCENT}
_MAYBE = {"type": ["number", "null"]}
_NAME = {"type": ["string", "number"]}


def _list(*items: dict[str, Any], **limits: int) -> dict[str, Any]:
    """JSON Schema of a list; several `items` are those of a list of fixed length."""
    if len(items) == 1:
        return {"type": "array", "items": items[0], **limits}
    return {"type": "array", "prefixItems": list(items), "items": False, "minItems": len(items)}


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of value: as messages call it, and as JSON Schema checks it."""

    words: str
    schema: dict[str, Any]


_FILE = {"$ref": "#/$defs/file"}
KINDS = {
    "text": Kind("text", _NAME),
    "flag": Kind("true or false", {"type": "boolean"}),
    "choice": Kind("one of a few words", {}),
    "whole": Kind("a whole number", _WHOLE),
    "number": Kind("a number", _NUMBER),
    "sd": Kind("a number or a percentage such as 5 %", {"anyOf": [_NUMBER, _PERCENT]}),
    "texts": Kind("a list of names", _list(_NAME)),
    "numbers": Kind("a list of numbers", _list(_NUMBER, minItems=1)),
    "wholes": Kind("a list of whole numbers", _list(_WHOLE)),
    "maybes": Kind("a list of numbers, null where not measured", _list(_MAYBE, minItems=1)),
    "dofs": Kind("a list of degrees of freedom, by number from 1 or by label", _list(_NAME)),
    "square": Kind("a list of rows of numbers", _list(_list(_NUMBER, minItems=1), minItems=1)),
    "pairs": Kind("a list of [row, column]", _list(_list(_WHOLE, _WHOLE))),
    "triples": Kind("a list of [row, column, value]", _list(_list(_WHOLE, _WHOLE, _NUMBER))),
    "triples or file": Kind(
        "a list of [row, column, value], or {file: name}",
        {"anyOf": [_list(_list(_WHOLE, _WHOLE, _NUMBER)), _FILE]},
    ),
    "links": Kind("a list of [parameter, parameter, correlation]", _list(_list(_NAME, _NAME, _NUMBER))),
    "sds": Kind(
        "a number, a percentage such as 2 %, or a list of numbers",
        {"anyOf": [_NUMBER, _PERCENT, _list(_MAYBE)]},
    ),
    "grid": Kind(
        "a list of rows of numbers (null where not measured), or {file: name}",
        {"anyOf": [_list(_list(_MAYBE)), _FILE]},
    ),
    "sd grid": Kind(
        "a number, a percentage such as 2 %, a list of rows of numbers, or {file: name}",
        {"anyOf": [_NUMBER, _PERCENT, _list(_list(_MAYBE)), _FILE]},
    ),
    "flag or dofs": Kind(
        "true, false or {dofs: [...]}",
        {"anyOf": [{"type": "boolean"}, {"$ref": "#/$defs/total_mass"}]},
    ),
    "path": Kind("the name of a file", {"type": "string", "minLength": 1}),
}


@dataclass(frozen=True, slots=True)
class Key:
    """One key: kind of value (of KINDS, `section NAME` or `list NAME`), meaning, default, unit, limits."""

    kind: str
    meaning: str
    default: str = ""
    unit: str = ""
    required: bool = False
    choices: tuple[Any, ...] = ()
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True, slots=True)
class Section:
    """A mapping: its keys; `forms`, sets of keys of which exactly one is given; `later`, keys to come."""

    meaning: str
    keys: dict[str, Key]
    forms: tuple[tuple[str, ...], ...] = ()
    later: dict[str, str] | None = None


_RUN = RunOptions()


def _option(name: str, kind: str, meaning: str, **limits: Any) -> Key:
    """A run option, with the default that RunOptions gives it."""
    return Key(kind, meaning, _shown(getattr(_RUN, name)), **limits)


def _shown(value: Any) -> str:
    """A default as YAML writes it."""
    return "null" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


_NO_STRUCTURE = "this release reads bare matrices: give model: {stiffness: ..., mass: ...}"
_MODES_ONLY = "this release reads measured modes: give test: {modes: ...}"

SECTIONS = {
    "deck": Section(
        "The whole deck.",
        {
            "mouse": Key("whole", "version of the format", required=True, low=VERSION, high=VERSION),
            "title": Key("text", "heading of the printout", "empty"),
            "source": Key("text", "where the deck or its numbers come from", "empty"),
            "model": Key("section model", "the matrices before the test", required=True),
            "elements": Key("section elements", "order in which the varying elements are listed (RS)", "see below"),
            "parameters": Key("list parameter", "what may be revised: one entry is one column of A", "none"),
            "prior": Key("section prior", "how the parameters are correlated before the test", "uncorrelated"),
            "test": Key("section test", "what was measured", "none: the deck asks only for modes"),
            "run": Key("section run", "how to run", "the defaults below"),
        },
    ),
    "model": Section(
        "The baseline: symmetric K and M at the nominal values of the parameters.",
        {
            "stiffness": Key("section matrix", "K", unit="N/m", required=True),
            "mass": Key("section matrix", "M", unit="kg", required=True),
            "labels": Key("texts", "names of the degrees of freedom", "1, 2, ..."),
        },
        later={"structure": _NO_STRUCTURE, "damping": _NO_STRUCTURE},
    ),
    "matrix": Section(
        "A symmetric matrix, in one of five forms.",
        {
            "order": Key("whole", "number of rows", low=1, high=MAX_ORDER),
            "entries": Key("triples", "diagonal and upper triangle as [row, column, value], from 1; the rest is 0"),
            "dense": Key("square", "all rows"),
            "diagonal": Key("numbers", "the diagonal; the rest is 0"),
            "identity": Key("whole", "order of a unit matrix", low=1, high=MAX_ORDER),
            "file": Key("path", "matrix file (.mtx, .npz, .csv) below the folder of the deck"),
        },
        forms=(("order", "entries"), ("dense",), ("diagonal",), ("identity",), ("file",)),
    ),
    "file": Section(
        "Values kept in a file.",
        {"file": Key("path", "matrix file (.mtx, .npz, .csv) below the folder of the deck", required=True)},
    ),
    "elements": Section(
        "Order of the varying elements, in which their partial derivatives are printed; default: as the "
        "parameters name them, stiffness first.",
        {
            "stiffness": Key("pairs", "elements of K as [row, column]", "[]"),
            "mass": Key("pairs", "elements of M as [row, column]", "[]"),
        },
    ),
    "parameter": Section(
        "One property of the structure: K = K0 + (value - nominal) x its stiffness, and M likewise.",
        {
            "name": Key("text", "what the printout calls it", required=True),
            "nominal": Key("number", "value before the test", "0: the parameter is a change"),
            "unit": Key("text", "unit of the value", "empty"),
            "sd": Key(
                "sd",
                "prior standard deviation; a percentage is of the nominal value; 0 holds the parameter",
                "required, unless prior.covariance is given",
            ),
            "lower": Key("number", "least value allowed", "none"),
            "upper": Key("number", "largest value allowed", "none"),
            "transform": Key("choice", "log keeps the value positive", "identity", choices=TRANSFORMS),
            "stiffness": Key("triples or file", "dK/d(parameter): [row, column, value], upper triangle", "[]"),
            "mass": Key("triples or file", "dM/d(parameter): [row, column, value], upper triangle", "[]"),
        },
        later={"elements": _NO_STRUCTURE, "property": _NO_STRUCTURE},
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
    "test": Section(
        "What was measured.",
        {"modes": Key("section modes", "natural frequencies and mode shapes", required=True)},
        later={"frf": _MODES_ONLY, "recordings": _MODES_ONLY, "hold_out": _MODES_ONLY},
    ),
    "modes": Section(
        "m measured modes at s degrees of freedom.",
        {
            "number": Key("wholes", "system mode number of each measured mode, rigid-body modes counted", "1 to m"),
            "frequency": Key("maybes", "natural frequencies, null where not measured", unit="Hz", required=True),
            "frequency_sd": Key(
                "sds",
                "their standard deviations; a percentage is of each frequency",
                unit="Hz",
                default="required where a frequency is given",
            ),
            "dofs": Key("dofs", "degrees of freedom of the sensors", "none: frequencies only"),
            "shapes": Key("grid", "mode shapes: one row for each of dofs, one column for each mode", "none"),
            "shape_sd": Key(
                "sd grid",
                "their standard deviations, in the units of shapes; a percentage is of the "
                "largest component of the mode",
                "required with shapes",
            ),
            "scale": Key("choice", "how shapes are brought to the scale of the theory", "fitted", choices=SCALES),
        },
    ),
    "run": Section(
        "How to run; each key is also an option of `mouse run`.",
        {
            "estimator": _option("estimator", "text", "row of Table 3-1"),
            "recursion": _option(
                "recursion",
                "choice",
                "where each cycle starts: from the last revision (1972), or anchored to the prior",
                choices=RECURSIONS,
            ),
            "confidence": _option(
                "confidence", "choice", "level of the convergence test (KONF)", unit="%", choices=CONFIDENCES
            ),
            "partials": _option("partials", "whole", "most computations of the partial derivatives (NPARD)", low=1),
            "passes": _option("passes", "whole", "passes of O-7 and O-8 for each of them (ITERMX)", low=1),
            "cycles": _option("cycles", "whole", "exactly so many cycles, whatever the convergence test says", low=0),
            "convergence": _option(
                "convergence",
                "choice",
                "exceedances against non-exceedances (ratio) or against all data (fraction)",
                choices=CONVERGENCE_RULES,
            ),
            "extra_update": _option("extra_update", "flag", "one more cycle after the test has passed"),
            "pairing": _option(
                "pairing",
                "choice",
                "measured modes go with computed ones by number, or by shape (mac)",
                choices=PAIRINGS,
            ),
            "step": _option("step", "choice", "expansion of the model in each cycle", choices=STEPS),
            "limit_sd": _option(
                "limit_sd",
                "number",
                "no correction beyond so many prior standard deviations; null: no limit",
                low=0.001,
            ),
            "fix_total_mass": _option("fix_total_mass", "flag or dofs", "component masses vary, their total does not"),
            "print_partials": _option("print_partials", "flag", "print the partial derivatives (JFLAG)"),
            "legacy": _option("legacy", "flag", "the limits of the 1972 program are errors"),
        },
    ),
    "total_mass": Section(
        "Which masses make the total that stays.",
        {"dofs": Key("dofs", "degrees of freedom whose masses are summed", required=True)},
    ),
}
