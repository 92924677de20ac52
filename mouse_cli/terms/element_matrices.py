"""Matrices of the elements of one set at any values of the parameters, before supports and links act."""

from collections.abc import Iterator

import numpy as np

from mouse_cli.model.mesh import Binding, ElementSet
from mouse_cli.model.term import MATRICES
from mouse_cli.terms.bound_properties import BoundProperties, nominal_properties
from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties

_BLOCK = 512  # elements worked on at a time: their matrices stay in the cache


class _Part:
    """Some elements of a set, `members`, in blocks."""

    def __init__(self, kind: ElementType, layout: Layout, members: np.ndarray):
        self.kind, self.members = kind, members
        self.slices = [slice(i, min(i + _BLOCK, len(members))) for i in range(0, len(members), _BLOCK)]
        self.layouts = [layout.of(members[s]) for s in self.slices]

    def blocks(self, properties: Properties) -> Iterator[tuple[slice, Matrices]]:
        """Matrices of each block, and which of the members these are."""
        for s, layout in zip(self.slices, self.layouts, strict=True):
            yield s, self.kind.damped(layout, {name: value[s] for name, value in properties.items()})


class ElementMatrices:
    """K, M, C, D of e elements over d = 6 k directions of their nodes, and derivatives, as lists of entries.

    standing: mask (e, d, d) of the entries that differ from zero in any of the matrices, `names`. diagonals: size (e, d) of
    the diagonal of each. Entries are counted by np.flatnonzero of a mask like `standing`, see `choose`.
    """

    def __init__(self, kind: ElementType, elements: ElementSet, layout: Layout, bindings: tuple[Binding, ...]):
        self.kind, self.elements, self.layout = kind, elements, layout
        self.bound = BoundProperties(kind, elements, layout, bindings)
        fixed = np.setdiff1d(np.arange(len(elements)), self.bound.members)
        self._fixed, self._moving = _Part(kind, layout, fixed), _Part(kind, layout, self.bound.members)
        d = 6 * elements.nodes.shape[1]
        self.standing = np.zeros((len(elements), d, d), bool)
        self.diagonals: dict[str, np.ndarray] = {}
        self._nominal = nominal_properties(kind, elements, layout)
        self.probe = self.bound.near_nominal(random=True)  # no entry vanishes there by chance
        self._look(self._fixed, {name: value[fixed] for name, value in self._nominal.items()})
        if bindings:
            self._look(self._moving, self.bound.at(self.probe)[0])

    def _look(self, part: _Part, properties: Properties) -> None:
        for s, found in part.blocks(properties):
            at = part.members[s]
            for name, matrix in found.items():
                own = matrix != 0
                if own.any():
                    self.standing[at] |= own
                    sizes = self.diagonals.setdefault(name, np.zeros(self.standing.shape[:2]))
                    sizes[at] = np.abs(np.einsum("eii->ei", matrix))

    @property
    def names(self) -> tuple[str, ...]:
        """Matrices that these elements have."""
        return tuple(name for name in MATRICES if name in self.diagonals)

    def nominal(self) -> Iterator[tuple[np.ndarray, Matrices]]:
        """Block by block, which elements, and their matrices at nominal values of all properties."""
        whole = _Part(self.kind, self.layout, np.arange(len(self.elements)))
        for s, found in whole.blocks(self._nominal):
            yield whole.members[s], found

    def tension(self, u: np.ndarray) -> np.ndarray | None:
        """Axial force (e,) at nominal properties under displacements u (e, d); None for elements that have none."""
        return None if self.kind.axial is None else self.kind.axial(self.layout, self._nominal, u)

    def choose(self, chosen: np.ndarray) -> None:
        """From now on entries are those of the mask `chosen` (e, d, d), in the order of np.flatnonzero."""
        counts = chosen.reshape(len(chosen), -1).sum(axis=1)
        first = np.concatenate([[0], np.cumsum(counts)])
        self._count = int(first[-1])
        self._sources = [
            [(np.flatnonzero(chosen[at := part.members[s]]), ranges(first[at], counts[at])) for s in part.slices]
            for part in (self._fixed, self._moving)
        ]

    def fixed(self) -> dict[str, np.ndarray]:
        """Entries of each matrix that no parameter moves; 0 where one does."""
        properties = {name: value[self._fixed.members] for name, value in self._nominal.items()}
        return self._gathered(0, self._fixed, properties, np.real)

    def at_nominal(self) -> dict[str, np.ndarray]:
        """Entries of each matrix at nominal values of all properties."""
        properties = {name: value[self._moving.members] for name, value in self._nominal.items()}
        return self._gathered(1, self._moving, properties, np.real, self.fixed())

    def add_moving(self, theta: np.ndarray, entries: dict[str, np.ndarray]) -> None:
        """Sets the entries that parameters move to their values at theta."""
        self._gathered(1, self._moving, self.bound.at(theta)[0], np.real, entries)

    def derivatives(self, theta: np.ndarray, property: str) -> dict[str, np.ndarray]:
        """Derivatives of the entries by the property of their element, by a complex step."""
        properties, step = self.bound.at(theta, property)
        return self._gathered(1, self._moving, properties, np.imag, None, 1 / step)

    def _gathered(self, which, part, properties, taken, entries=None, scale=None) -> dict[str, np.ndarray]:
        found = {name: np.zeros(self._count) for name in self.names} if entries is None else entries
        for (s, matrices), (source, at) in zip(part.blocks(properties), self._sources[which], strict=True):
            for name, out in found.items():
                matrix = matrices.get(name)
                if matrix is None:
                    out[at] = 0.0
                    continue
                values = taken(matrix)
                values = values if scale is None else values * scale[s, None, None]
                out[at] = values.reshape(-1)[source]
        return found


def ranges(first: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """All numbers from first[i] on, counts[i] of them, for each i, one after the other."""
    if len(first) and (first[1:] == first[:-1] + counts[:-1]).all():
        return np.arange(first[0], first[-1] + counts[-1])
    return np.arange(counts.sum()) + np.repeat(first - np.cumsum(counts) + counts, counts)
