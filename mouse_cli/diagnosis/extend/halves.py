"""The deck on elements of half the length, which bear the numbers of those that they were part of."""

from collections.abc import Container
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.extend.deck import with_what_is_held_out
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import every_beam, every_cable
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements._beam import AT_ENDS


def halved(problem: Problem, but: Container[int] = ()) -> Problem:
    """The deck with every beam in two halves, cables in four quarters, and their masses spread along them; beams `but`, by their
    numbers, are left whole.

    The second half of element n, and the node between, are called `beyond` + n; further quarters 2 and 3 times that more.
    """
    edit, step = Edit(problem), beyond(problem)
    cables, whole, names = set(every_cable(edit)), set(), _Names(edit)
    for s, i in sorted({*every_beam(edit), *cables}, reverse=True):
        number = int(edit.sets[s].ids[i])
        if number in but:
            whole.add(s)
            continue
        edit.split((s, i), 0.5)
        for half in (i + 1, i) if (s, i) in cables else ():
            edit.split((s, half), 0.5)
        names.given(number, step)
    names.put()
    for s in {s for s, _ in (*every_beam(edit), *cables)} - whole:
        if edit.sets[s].options.get("mass") in AT_ENDS:
            edit.option(s, mass="consistent")
    return with_what_is_held_out(edit.done(), problem)


def beyond(problem: Problem) -> int:
    """The power of ten above all numbers of elements and nodes.

    >>> import mouse_cli
    >>> beyond(mouse_cli.read_deck("decks/cantilever.yaml"))
    100
    """
    mesh = problem.mesh
    return 10 ** len(str(max(int(each.max()) for each in (mesh.node_ids, *(own.ids for own in mesh.elements)))))


class _Names:
    """What new elements and nodes of an edit are called, after the element that they were a part of."""

    def __init__(self, edit: Edit):
        self.edit, self.elements, self.nodes = edit, {}, {}
        self.last, self.count = self._last(), len(edit.node_ids)

    def _last(self) -> int:
        return max(int(each.ids.max()) for each in self.edit.sets)

    def given(self, number: int, step: int) -> None:
        """Those that came since the last time are parts of element `number`."""
        last, count = self._last(), len(self.edit.node_ids)
        for first, end, names in ((self.last + 1, last + 1, self.elements), (self.count, count, self.nodes)):
            names |= {new: number + step * (k + 1) for k, new in enumerate(range(first, end))}
        self.last, self.count = last, count

    def put(self) -> None:
        """Into the edit."""
        for index, name in self.nodes.items():
            self.edit.node_ids[index] = name
        self.edit.sets = [
            replace(each, ids=np.array([self.elements.get(i, i) for i in each.ids.tolist()], int)) for each in self.edit.sets
        ]
