"""A sweep: how the answer depends on quantities that are not known exactly, and how much of that is due to each."""

from collections.abc import Iterator

import numpy as np

from mouse_cli._errors import WARNING, Diagnostic
from mouse_cli.batch import changes
from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.campaigns import answers, design
from mouse_cli.formats import file_bytes
from mouse_cli.model.campaign import Answered, Moved, Sweep
from mouse_cli.model.problem import Problem

_FAR = 1.0  # posterior standard deviations by which an answer may move before it is said to depend on what was varied


def jobs(deck: str, varied: tuple[design.Varied, ...], points: list, base: dict, outside: bool) -> list[Job]:
    """The job of each point, `base` being options of all."""
    return [Job(deck, options=base | design.options(varied, point), outside=outside) for point in points]


def checked(deck: str, problem: Problem, varied: tuple[design.Varied, ...]) -> None:
    """Raise DeckError (MD932, MD933) for a quantity that the deck does not have, before any point is run."""
    for share in (0.0, 1.0):
        asked = design.options(varied, tuple(each.at(share) for each in varied))
        changes.edited(file_bytes(deck), deck, asked)
        changes.changed(problem, asked)


def summed(
    problem: Problem, varied: tuple[design.Varied, ...], points: list, outcomes: list[Outcome], first: Outcome
) -> Sweep:
    """What the answers say together; `first`: of the deck as it is, which pairs the modes."""
    names = [each.name for each in problem.parameters]
    numbers, modes = paired(first)
    found = tuple(answers.read(each, names, modes) for each in outcomes)
    usable = [i for i, each in enumerate(found) if each.found]
    groups = grouped([points[i] for i in usable], len(varied))
    whole, by_chance = [found[i] for i in usable], any(not each.values for each in varied)
    parameters = tuple(
        _moved(each.name, each.unit, [a.theta[i] for a in whole], [a.sd[i] for a in whole], groups, by_chance)
        for i, each in enumerate(problem.parameters)
    )
    frequencies = tuple(
        _moved(str(number), "Hz", [a.hz[i] for a in whole], [], groups, by_chance) for i, number in enumerate(numbers)
    )
    exit_code = max((each.exit_code for each in found), default=0)
    warned = tuple(_remarks(problem, varied, found, parameters))
    quantities = tuple(each.name for each in varied)
    return Sweep(problem, quantities, tuple(points), found, parameters, frequencies, exit_code, warned)


def paired(outcome: Outcome) -> tuple[list[int], list[int]]:
    """Numbers of the measured modes of the deck as it is, and the modes of the model, from 0, that they are."""
    modes = answers.document(outcome).get("modes", [])
    return [each["mode"] for each in modes], [each["model_mode"] - 1 for each in modes]


def _moved(name: str, unit: str, values: list, sds: list, groups: list[np.ndarray], by_chance: bool) -> Moved:
    """Over the points that have an answer; groups: of each varied quantity the group of every point."""
    y = np.array(values, float)
    finite = [sd for sd in sds if np.isfinite(sd)]
    sd = float(np.median(finite)) if finite else np.nan
    if not len(y) or not np.isfinite(y).all():
        return Moved(name, unit, np.nan, np.nan, sd, np.nan, (np.nan,) * len(groups))
    low, high = float(y.min()), float(y.max())
    lengths = (high - low) / sd if sd > 0 else np.nan
    return Moved(name, unit, low, high, sd, lengths, tuple(share(y, each, by_chance) for each in groups))


def _remarks(
    problem: Problem, varied: tuple[design.Varied, ...], found: tuple[Answered, ...], parameters: tuple[Moved, ...]
) -> Iterator[Diagnostic]:
    """What a careful reader of a sweep should know."""
    for each in parameters:
        if each.lengths > _FAR:
            by = "" if each.most_by is None else f", most by {varied[each.most_by].name}"
            message = f"{each.name} moves by {each.lengths:.2g} of its posterior standard deviations over the sweep{by}"
            yield Diagnostic(
                "MD930", WARNING, message, help="state the posterior with that spread, or find out what was varied"
            )
    silent = sum(not each.found for each in found)
    if silent:
        message = f"{silent} of {len(found)} points have no answer and are left out"
        yield Diagnostic("MD931", WARNING, message, help="see their codes in the table")


_MOST, _EACH = 8, 4  # groups of values that are all different, and points in each at least


def grouped(points: list[tuple], count: int) -> list[np.ndarray]:
    """For each of `count` quantities the group (n,) of every point: equal values together, or neighbours where all differ."""
    return [_groups([point[j] for point in points], alone=count == 1) for j in range(count)]


def _groups(values: list, alone: bool) -> np.ndarray:
    distinct = sorted(set(values), key=lambda value: (isinstance(value, str), value))
    place = np.array([distinct.index(value) for value in values], int)
    if alone or len(distinct) < len(values):
        return place
    return place * max(1, min(_MOST, len(values) // _EACH)) // max(1, len(distinct))


def share(y: np.ndarray, group: np.ndarray, by_chance: bool) -> float:
    """Of the variance of y (n,), what the means of the groups (n,) explain: the correlation ratio R^2 (first-order index of Sobol).

    by_chance: points were drawn, so that means differ by chance too: 1 - (1 - R^2)(n - 1)/(n - groups), zero at least. In a grid
    all groups have the same values of all other quantities.
    """
    kinds, n = np.unique(group), len(y)
    total = float(np.sum((y - y.mean()) ** 2))
    if not total > 0:
        return 0.0
    ratio = float(sum(np.count_nonzero(group == g) * (y[group == g].mean() - y.mean()) ** 2 for g in kinds)) / total
    if not by_chance or len(kinds) == n:
        return ratio
    return max(0.0, 1 - (1 - ratio) * (n - 1) / (n - len(kinds)))
