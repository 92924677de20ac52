"""`--vary NAME=VALUES` of the command line to quantities of a sweep."""

import re
from math import isfinite

import click

from mouse_cli.campaigns.design import Value, Varied, spaced
from mouse_cli.cli._options import RUN, run_changes
from mouse_cli.model.problem import Problem

_RANGE = re.compile(r"(log:)?([^:,]+):([^:,]+)(?::([0-9]+))?")
_MOST = 10_000
_HINT = "--vary"


def varied(text: str, problem: Problem, by_points: bool) -> Varied:
    """The quantity of one `NAME=VALUES`; by_points: the range is filled, its count has no meaning. Raises click.BadParameter."""
    name, found, values = text.partition("=")
    name = name.strip()
    if not found or not name or not values.strip():
        raise click.BadParameter(f"'{text}' is not NAME=VALUES", param_hint=_HINT)
    kind = _kind(name, problem)
    match = _RANGE.fullmatch(values.strip())
    if match and _number(match[2]) is not None:
        return _range(name, kind, match, by_points)
    words = [word.strip() for word in values.split(",")]
    if len(set(words)) < len(words) or "" in words:
        raise click.BadParameter(f"{name}: '{values}' repeats a value or leaves one out", param_hint=_HINT)
    return Varied(name, kind, tuple(_value(name, kind, word) for word in words))


def _kind(name: str, problem: Problem) -> str:
    """Which of a job's options hold it: `run`, `values`, or `texts` for a place of the deck."""
    from mouse_cli.batch.changes import kind

    found = kind(name, problem)
    return "run" if found == "texts" and name.replace("-", "_") in _run_options() else found


def _run_options() -> dict[str, click.Option]:
    """Options of `mouse run` by the names of their keys."""
    command = click.Command("run")
    for decorate in reversed(RUN):
        command = decorate(command)
    return {option.name: option for option in command.params}


def _range(name: str, kind: str, match: re.Match, by_points: bool) -> Varied:
    low, high, log = _number(match[2]), _number(match[3]), bool(match[1])
    if low is None or high is None or not low < high or (log and not low > 0):
        message = f"{name}: '{match[0]}' is no range; low must be below high, and above zero with log:"
        raise click.BadParameter(message, param_hint=_HINT)
    if by_points:
        return Varied(name, _checked(name, kind), low=low, high=high, log=log)
    count = int(match[4] or 0)
    if not 2 <= count <= _MOST:
        message = (
            f"{name}: '{match[0]}' needs a count of 2 to {_MOST}, as in {match[0].split(':')[0]}:...:5, or --points"
        )
        raise click.BadParameter(message, param_hint=_HINT)
    values = spaced(low, high, count, log)
    return Varied(name, kind, tuple(_value(name, kind, repr(value)) for value in values))


def _checked(name: str, kind: str) -> str:
    """Options of a run are words or counts, of which a range between two numbers may hold none."""
    if kind == "run" and _run_options()[name.replace("-", "_")].type.name not in ("float", "float range"):
        raise click.BadParameter(f"{name} wants a list of values with --points", param_hint=_HINT)
    return kind


def _value(name: str, kind: str, word: str) -> Value:
    if kind == "texts":
        return word
    if kind == "values":
        number = _number(word)
        if number is None:
            raise click.BadParameter(f"{name}: '{word}' is no finite number", param_hint=_HINT)
        return number
    return _option_value(name, word)


def _option_value(name: str, word: str) -> Value:
    """As `mouse run` takes it."""
    option, key = _run_options()[name.replace("-", "_")], name.replace("-", "_")
    if option.is_flag:
        if word not in ("true", "false"):
            raise click.BadParameter(f"{name} is true or false, not '{word}'", param_hint=_HINT)
        return word == "true"
    number = _number(word)
    if option.type.name == "integer range" and number is not None and number == int(number):
        word = str(int(number))
    try:
        with click.Context(click.Command("run")) as context:
            return run_changes({key: option.process_value(context, word)})[key]
    except click.BadParameter as error:
        raise click.BadParameter(f"{name}: {error.message}", param_hint=_HINT) from None


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) else None
