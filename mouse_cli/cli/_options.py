"""Options shared by commands: each replaces a key of `run:` in the deck, and is echoed in the printout and the JSON."""

from collections.abc import Callable
from math import isfinite
from typing import Any

import click

from mouse_cli.model.modal_test import SCALES
from mouse_cli.model.problem import CONFIDENCES, CONVERGENCE_RULES, PAIRINGS, RECURSIONS, STEPS

_POSITIVE = click.IntRange(min=1)


def _finite(context: click.Context, option: click.Parameter, value: float | None) -> float | None:
    """A number that is one: nan is within every range."""
    if value is not None and not isfinite(value):
        raise click.BadParameter(f"{value} is not a finite number", context, option)
    return value


RUN = (
    click.option("--estimator", metavar="NAME", help="Row of Table 3-1; see `mouse list estimators`."),
    click.option("--recursion", type=click.Choice(RECURSIONS), help="The loop of 1972, or the true posterior mode."),
    click.option("--scale", type=click.Choice(SCALES), help="How test shapes are brought to the scale of the theory."),
    click.option("--pairing", type=click.Choice(PAIRINGS), help="Pair modes by number, or by MAC and frequency."),
    click.option(
        "--confidence",
        type=click.Choice([str(level) for level in CONFIDENCES]),
        help="Confidence level of the limits, per cent.",
    ),
    click.option("--partials", type=_POSITIVE, help="Most computations of the partial derivatives (NPARD)."),
    click.option("--passes", type=_POSITIVE, help="Passes of O-7/O-8 before the partials are recomputed (ITERMX)."),
    click.option(
        "--cycles",
        type=click.IntRange(min=0),
        help="Exactly so many cycles, whatever the result of the convergence test.",
    ),
    click.option(
        "--convergence",
        type=click.Choice(CONVERGENCE_RULES),
        help="Exceedances against non-exceedances (ratio) or against all data (fraction).",
    ),
    click.option(
        "--legacy-extra-update",
        "extra_update",
        is_flag=True,
        default=None,
        help="One more cycle after the test passed.",
    ),
    click.option(
        "--step", type=click.Choice(STEPS), help="First-order step, or with the curvature of the data along it."
    ),
    click.option(
        "--limit-sd",
        type=click.FloatRange(min=0, min_open=True),
        callback=_finite,
        help="No correction beyond so many prior sd.",
    ),
    click.option(
        "--fix-total-mass", is_flag=True, default=None, help="Hold the total mass while component masses vary."
    ),
    click.option("--print-partials", is_flag=True, default=None, help="Print the partial derivatives (JFLAG)."),
    click.option("--exact", is_flag=True, default=None, help="Partial derivatives of large models exact to rounding."),
    click.option(
        "--print-covariance", is_flag=True, default=None, help="Form the covariance of more than 500 properties too."
    ),
)


def _keep(context: click.Context, option: click.Parameter, value: object) -> None:
    if value not in (None, False, ()):
        context.meta[f"mouse_cli.{option.name}"] = value


def shared(*names: str, **more: object) -> Callable:
    """An option that means the same in every command: kept in click's context for `value_of`, and passed to none."""
    return click.option(*names, expose_value=False, callback=_keep, **more)


def value_of(name: str) -> Any:
    """What a shared option was given; None without it."""
    context = click.get_current_context(silent=True)
    return None if context is None else context.meta.get(f"mouse_cli.{name}")


OUTSIDE = (
    shared(
        "--allow-outside",
        "outside",
        is_flag=True,
        help="Read files outside of the folders of the decks that name them.",
    ),
)  # fmt: skip


def outside() -> bool:
    """Whether this command was allowed to read files outside of the folders of the decks that name them."""
    return bool(value_of("outside"))


READING = (
    *OUTSIDE,
    shared("--legacy", is_flag=True, help="Enforce the limits of 1972 (140 DOF, 10 modes, ...)."),
    shared("--strip-73-80", is_flag=True, help="Blank columns 73-80, where a deck has sequence numbers."),
    shared(
        "--set",
        "overrides",
        multiple=True,
        metavar="NAME=VALUE",
        help="A number of a card deck, e.g. NPARD=5 or VAR(5)=0.02, instead of the punched one.",
    ),
)

PRIOR = (
    shared(
        "--prior",
        metavar="RESULT",
        help="Begin from what `mouse run --json` found by another test: values and covariance of equal names.",
    ),
    shared(
        "--loosen",
        multiple=True,
        metavar="NAME=SD",
        help="With --prior: by how much a property may have changed since, added to its variance.",
    ),
)

QUIET = (shared("-q", "--quiet", is_flag=True, help="No warnings on standard error."),)


def answer(schema: str) -> tuple[Callable, ...]:
    """Where the answer goes and in what form; `schema` is that of its JSON document."""
    where = shared("-o", "--output", metavar="FILE", help="Write the answer to FILE instead of standard output.")
    return (where, *answer_form(schema))


def answer_form(schema: str) -> tuple[Callable, ...]:
    """In what form the answer is given; `schema` is that of its JSON document."""
    from mouse_cli.report.numbers import STYLES

    return (
        shared("--json", "form", flag_value="json", help=f"One JSON document ({schema}) instead of the printout."),
        shared("--markdown", "form", flag_value="markdown", help="Markdown instead of the printout."),
        shared(
            "--full",
            is_flag=True,
            help="The whole report instead of one screen: evidence, cycles, matrices, covariances.",
        ),
        shared("--numbers", type=click.Choice(STYLES), help="1.28872+04 as in 1972, or 12887.2."),
    )


def options(*groups: tuple[Callable, ...]) -> Callable:
    """Decorator that adds groups of options to a command, in their order."""

    def decorate(function: Callable) -> Callable:
        for option in reversed([option for group in groups for option in group]):
            function = option(function)
        return function

    return decorate


def plotting(help: str = "Write figures: to a folder, or to one file (.pdf, .png, .svg).") -> tuple[Callable, ...]:
    """Where figures go; a command that has these calls `check_figures` before it computes anything."""
    return (shared("--plot", metavar="PATH", help=help),)


def reading() -> dict[str, object]:
    """Arguments of the readers from the options READING. Raises click.BadParameter."""
    values: dict[str, float] = {}
    for item in value_of("overrides") or ():
        name, _, value = item.partition("=")
        try:
            values[name.strip()] = float(value) if "." in value else int(value)
        except ValueError:
            raise click.BadParameter(f"'{item}' is not NAME=NUMBER", param_hint="--set") from None
    return {"legacy": bool(value_of("legacy")), "strip_73_80": bool(value_of("strip_73_80")), "overrides": values}


def earlier() -> dict[str, object]:
    """Arguments of `read_problem` from the options PRIOR. Raises click.BadParameter."""
    prior, loosen = value_of("prior"), value_of("loosen") or ()
    if loosen and not prior:
        raise click.BadParameter("it states what may have changed since the result of --prior", param_hint="--loosen")
    loosened: dict[str, float] = {}
    for item in loosen:
        name, _, value = item.rpartition("=")
        try:
            loosened[name.strip()] = sd = float(value)
        except ValueError:
            sd = -1.0
        if not (name and 0 <= sd < 1e150):  # its square is a variance
            raise click.BadParameter(f"'{item}' is not NAME=SD", param_hint="--loosen")
    return {"prior": prior, "loosened": loosened}


def run_changes(given: dict[str, object]) -> dict[str, object]:
    """Run options as the model wants them, from those of the command line. Raises click.BadParameter."""
    if given.get("estimator"):
        from mouse_cli.estimators import estimator

        try:
            estimator(given["estimator"])
        except ValueError as error:
            raise click.BadParameter(str(error), param_hint="--estimator") from None
    if given.get("confidence"):
        given = {**given, "confidence": int(given["confidence"])}
    return given
