"""Further mass per length on beams, whatever parameters say of theirs."""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.sites.lines import Line
from mouse_cli.model.mesh import Binding
from mouse_cli.model.problem import Problem

_NAME = "nonstructural_mass"


def may_bear_more(problem: Problem, run: Line) -> bool:
    """Whether a row of bars can have further mass: no parameter is its mass per length that has no value to be multiplied."""
    taken = _given(problem, problem.bindings)
    own = zip(run.bars.set[run.members].tolist(), run.bars.member[run.members].tolist(), strict=True)
    return all(taken.get(at, 1.0) > 0 for at in own)


def add_line_mass(edit: Edit, beams: list[tuple[int, int]], name: str, m: float) -> None:
    """m (kg/m) on beams, as a new parameter: their value, or a factor of it where a parameter is one already. Where one is their
    value it is multiplied, by a second parameter if `beams` are of both kinds.
    """
    given = _given(edit.problem, edit.bindings)
    own = [each for each in beams if each not in given]
    if own:
        put_line_mass(edit, own, line_mass(edit, own) + m)
        edit.bind(name, own, (_NAME,), unit="kg/m")
    for value in sorted({given[each] for each in beams if each in given}):
        alike = [each for each in beams if given.get(each) == value]
        edit.bind(f"{name}, over {value:g} kg/m", alike, (_NAME,), factor=1 + m / value)


def line_mass(edit: Edit, beams: list[tuple[int, int]]) -> np.ndarray:
    """Mass per length (e,) of beams beside their own, with the factors of it."""
    factor = _factors(edit)
    return np.array([edit.values(each, _NAME) * factor.get(each, 1.0) for each in beams])


def put_line_mass(edit: Edit, beams: list[tuple[int, int]], values: np.ndarray) -> None:
    """Gives beams mass per length (e,), with the factors of it."""
    factor = _factors(edit)
    edit.put(beams, _NAME, values / np.array([factor.get(each, 1.0) for each in beams]))


def _given(problem: Problem, bindings: Iterable[Binding]) -> dict[tuple[int, int], float]:
    """Mass per length of the elements of which a parameter is that value."""
    return {
        (b.set, int(i)): problem.parameters[b.parameter].nominal
        for b in bindings
        if b.property == _NAME and not b.factor
        for i in b.members
    }


def _factors(edit: Edit) -> dict[tuple[int, int], float]:
    """By what parameters of the deck multiply the mass per length of elements."""
    found: dict[tuple[int, int], float] = {}
    for b in edit.bindings:
        if b.property == _NAME and b.factor:
            value = edit.problem.parameters[b.parameter].nominal
            found |= {(b.set, int(i)): value * found.get((b.set, int(i)), 1.0) for i in b.members}
    return found
