"""Sizes of laws in the units of what moves there: a spring between two shafts is in N m/rad."""

import re
from dataclasses import replace

from mouse_cli.model.explanation import Cause
from mouse_cli.model.problem import Problem
from mouse_cli.model.recording import MOMENT, ROTATIONS

_TURNED = {"kg": "kg m2", "N": "N m", "m": "rad"}


def spelled(cause: Cause, problem: Problem) -> Cause:
    """A law with its sizes in the units of the deck, of rotations where the degrees of freedom at its site are."""
    labels = {str(i) for i in cause.site.ids}
    if cause.site.kind == "dof" and labels <= _rotations(problem):
        cause = replace(cause, sizes=tuple(replace(size, unit=turned(size.unit)) for size in cause.sizes))
    return cause.spelled(problem.units)


def turned(unit: str) -> str:
    """A unit of forces and displacements as that of moments and rotations.

    >>> turned("N/m"), turned("N s^2/m^2"), turned("kg"), turned("Hz")
    ('N m/rad', 'N m s^2/rad^2', 'kg m2', 'Hz')
    """
    return re.sub(r"\b(kg|N|m)\b", lambda at: _TURNED[at[1]], unit)


def _rotations(problem: Problem) -> set[str]:
    """Labels of degrees of freedom that turn: by their direction, those of a model of matrices by what is measured of them."""
    labels = problem.structure.labels
    channels = (each for one in problem.recordings for each in one.channels if each.quantity in (MOMENT, *ROTATIONS))
    read = {labels[i] for each in channels for i in each.weights}
    return read | {label for label in labels if label[-2:-1] == "R"}
