"""The term of one set of elements: its matrices at the free degrees of freedom, and their derivatives."""

import numpy as np

from mouse_cli.model.mesh import Binding
from mouse_cli.model.term import Places, Slopes
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.element_matrices import ElementMatrices

_SAME = 1e-8  # relative difference of derivatives at two values of the parameters that still counts as linear


class _Entries:
    """Entries of one matrix at the free degrees of freedom: `source` entry of the elements (flat), times `factor`.

    moved: entries of elements that parameters move; bound_source: where these are in the matrices of those elements;
    member: which of those elements.
    """

    def __init__(self, standing: np.ndarray, dofs: np.ndarray, members: np.ndarray, motion: Motion):
        element, i, j = np.nonzero(standing)
        entry, row, col, factor = motion.spread(dofs[element, i], dofs[element, j])
        element, d = element[entry], standing.shape[1]
        within = i[entry] * d + j[entry]
        self.places = Places(row, col)
        self.source = element * d * d + within
        self.factor = factor
        position = np.full(len(standing), -1)
        position[members] = np.arange(len(members))
        self.moved = np.flatnonzero(position[element] >= 0)
        self.member = position[element[self.moved]]
        self.bound_source = self.member * d * d + within[self.moved]

    def whole(self, matrices: np.ndarray) -> np.ndarray:
        """Values (z,) from the matrices (e, d, d) of all elements."""
        return matrices.ravel()[self.source] * self.factor

    def bound(self, matrices: np.ndarray) -> np.ndarray:
        """Values at `moved` from the matrices (b, d, d) of the elements that parameters move."""
        return matrices.ravel()[self.bound_source] * self.factor[self.moved]


class ElementTerm:
    """Values and slopes of one set of elements; see `Term`. dofs (e, d): directions of nodes, as `motion` numbers them.

    Whether it is linear is found out: derivatives are exact, so they agree at three values of the parameters or they do not.
    """

    def __init__(self, matrices: ElementMatrices, dofs: np.ndarray, motion: Motion):
        self.matrices = matrices
        members = matrices.bound.members
        entries = {name: _Entries(mask, dofs, members, motion) for name, mask in matrices.standing.items()}
        self._entries = {name: entry for name, entry in entries.items() if len(entry.places)}
        self.places = {name: entry.places for name, entry in self._entries.items()}
        self._base = {name: self._whole(name, entry) for name, entry in self._entries.items()}
        self._patterns = self._pattern()
        self.linear = True
        self._constant: dict[str, Slopes] | None = None
        if matrices.bound.bindings:
            self._find_linear()

    def _whole(self, name: str, entry: _Entries) -> np.ndarray:
        given = self.matrices.nominal.get(name)
        return np.zeros(len(entry.places)) if given is None else entry.whole(given)

    def _pattern(self) -> dict[tuple[str, int], np.ndarray]:
        """For each matrix and binding that moves it, the entries among `moved` that have a derivative."""
        found = {}
        bound = self.matrices.bound
        for property in bound.names:
            standing: dict[str, np.ndarray] = {}
            for theta in self.matrices.probes:
                for name, matrix in self.matrices.derivatives(theta, property).items():
                    if name in self._entries:
                        standing[name] = standing.get(name, False) | (self._entries[name].bound(matrix) != 0)
            for k, b in enumerate(bound.bindings):
                if b.property == property:
                    found |= {
                        (name, k): pick for name, mask in standing.items() if len(pick := self._own(name, mask, b))
                    }
        return found

    def _own(self, name: str, mask: np.ndarray, binding: Binding) -> np.ndarray:
        own = np.zeros(len(self.matrices.bound.members), bool)
        own[binding.members] = True
        return np.flatnonzero(mask & own[self._entries[name].member])

    def _find_linear(self) -> None:
        theta = self.matrices.bound.nominal_theta()
        here, *others = (self._parts(at) for at in (theta, *self.matrices.probes))
        self.linear = all(_agree(here[key][-1], other[key][-1]) for other in others for key in here)
        if not self.linear:
            return
        self._constant = self._joined(here)
        self._positions = {name: self._position(name) for name in self._constant}
        at_theta = self._direct(theta)
        for name, slopes in self._constant.items():
            self._base[name] = at_theta[name] - self._moved_by(name, slopes, theta)

    def _position(self, name: str) -> np.ndarray:
        moved = self._entries[name].moved
        return np.concatenate([moved[pick] for (key, _), pick in self._patterns.items() if key == name])

    def _moved_by(self, name: str, slopes: Slopes, theta: np.ndarray) -> np.ndarray:
        return np.bincount(
            self._positions[name], slopes.value * theta[slopes.parameter], minlength=len(self.places[name])
        )

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Values (z,) of each matrix at theta."""
        if self._constant is None:
            return self._direct(theta) if self.matrices.bound.bindings else self._base
        moved = {name: self._moved_by(name, slopes, theta) for name, slopes in self._constant.items()}
        return {name: base + moved[name] if name in moved else base for name, base in self._base.items()}

    def _direct(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Values from the elements themselves."""
        given, found = self.matrices.at(theta), {}
        for name, entry in self._entries.items():
            found[name] = self._base[name].copy()
            found[name][entry.moved] = entry.bound(given[name]) if name in given else 0.0
        return found

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """First derivatives of each matrix that moves."""
        if self._constant is not None:
            return self._constant
        return self._joined(self._parts(theta)) if self.matrices.bound.bindings else {}

    def _parts(self, theta: np.ndarray) -> dict[tuple[str, int], tuple[np.ndarray, ...]]:
        """parameter, row, col, value for each matrix and each binding that moves it."""
        bound, found = self.matrices.bound, {}
        shares = bound.partials(theta)
        for property in bound.names:
            given = self.matrices.derivatives(theta, property)
            by_entry = {name: entry.bound(given[name]) for name, entry in self._entries.items() if name in given}
            for k, b in enumerate(bound.bindings):
                for name in self._entries:
                    if b.property == property and (name, k) in self._patterns:
                        found[name, k] = self._part(name, k, by_entry.get(name), shares[k])
        return found

    def _part(self, name: str, k: int, by_entry: np.ndarray | None, share: np.ndarray) -> tuple[np.ndarray, ...]:
        entry, pick = self._entries[name], self._patterns[name, k]
        at = entry.moved[pick]
        value = np.zeros(len(pick)) if by_entry is None else by_entry[pick] * share[entry.member[pick]]
        parameter = np.full(len(pick), self.matrices.bound.bindings[k].parameter)
        return parameter, entry.places.row[at], entry.places.col[at], value

    def _joined(self, parts: dict[tuple[str, int], tuple[np.ndarray, ...]]) -> dict[str, Slopes]:
        found = {}
        for name in dict.fromkeys(name for name, _ in self._patterns):
            own = [parts[key] for key in self._patterns if key[0] == name]
            found[name] = Slopes(*(np.concatenate(columns) for columns in zip(*own, strict=True)))
        return found


def _agree(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether derivatives by one parameter are the same but for rounding."""
    size = np.abs(one) + np.abs(other)
    return bool((np.abs(one - other) <= _SAME * size + 1e-12 * size.max(initial=0.0)).all())
