"""Springs between nodes of the deck that nothing joins there, along the line from one to the other."""

import numpy as np

from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.model.problem import Problem


def with_diagonals(problem: Problem, nodes: np.ndarray, name: str, k: np.ndarray) -> Problem:
    """The deck with springs k (s,) between `nodes` (s, 2), by their numbers, and one parameter: the value of all, or a factor."""
    edit, springs = Edit(problem), []
    for (one, other), rate in zip(nodes.tolist(), k.tolist(), strict=True):
        two = [edit.index(one), edit.index(other)]
        x = edit.coordinates[two[1]] - edit.coordinates[two[0]]
        axes = [x.tolist(), np.eye(3)[np.argmin(np.abs(x))].tolist()]
        springs += edit.add("spring", [two], {"TX": rate}, {"axes": axes})
    edit.bind(name, springs, ("TX",), unit="N/m")
    return edit.done()
