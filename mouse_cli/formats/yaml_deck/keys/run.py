"""Keys of `run:`; each is an option of `mouse run`."""

from typing import Any

from mouse_cli.formats.yaml_deck.kinds import Key, Section
from mouse_cli.model.problem import (
    CONFIDENCES,
    CONVERGENCE_RULES,
    MOST_COVARIANCE,
    PAIRINGS,
    RECURSIONS,
    STEPS,
    RunOptions,
)

_RUN = RunOptions()


def _option(name: str, kind: str, meaning: str, **limits: Any) -> Key:
    """A run option, with the default that RunOptions gives it."""
    return Key(kind, meaning, _shown(getattr(_RUN, name)), **limits)


def _shown(value: Any) -> str:
    """A default as YAML writes it."""
    return "null" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


SECTIONS = {
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
            "cycles": _option(
                "cycles", "whole", "exactly so many cycles, whatever the result of the convergence test", low=0
            ),
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
            "print_covariance": _option(
                "print_covariance", "flag", f"form the covariance of more than {MOST_COVARIANCE} properties too"
            ),
            "exact": _option("exact", "flag", "partial derivatives of large models exact to rounding, in every cycle"),
            "legacy": _option("legacy", "flag", "the limits of the 1972 program are errors"),
        },
    ),
    "total_mass": Section(
        "Which masses make the total that stays.",
        {"dofs": Key("dofs", "degrees of freedom whose masses are summed", required=True)},
    ),
}
