"""The term of one set of elements: its matrices at the free degrees of freedom, and their derivatives."""

import numpy as np

from mouse_cli.model.term import Places, Slopes
from mouse_cli.terms.constraints import Motion
from mouse_cli.terms.element_matrices import ElementMatrices, ranges

_ROUNDING = 1e-13  # relative change of an entry with a property that counts as none
_SAME = 1e-8  # relative difference of derivatives at two values of the parameters that still counts as linear


class ElementTerm:
    """Values and slopes of one set of elements; see `Term`. dofs (e, d): directions of nodes, as `motion` numbers them.

    Whether it is linear is found out: derivatives are exact, so at two values of the parameters, one of them drawn by lot,
    they agree or they do not.
    """

    def __init__(self, matrices: ElementMatrices, dofs: np.ndarray, motion: Motion):
        self._matrices, self._bound = matrices, matrices.bound
        moves = motion.counts[dofs] > 0
        chosen = matrices.standing & moves[:, :, None] & moves[:, None, :]
        matrices.choose(chosen)
        element, i, j = (index.astype(np.int32) for index in np.nonzero(chosen))
        self._entry, row, col, self._factor = motion.spread(dofs[element, i], dofs[element, j])
        self._element = element if self._entry is None else element[self._entry]
        places = Places(row, col)
        self.places = dict.fromkeys(matrices.names, places) if len(places) else {}
        self._base = matrices.fixed()
        self._constant: dict[str, Slopes] | None = None
        self.linear = True
        if matrices.bound.bindings:
            self._find_rules()
            self._find_linear()

    @property
    def axial(self) -> np.ndarray | None:
        """Axial force (e,) by weight, tension positive; None where weight makes none."""
        return self._matrices.layout.axial

    def _spread(self, entries: np.ndarray) -> np.ndarray:
        """Entries of elements at their places."""
        return entries if self._entry is None else entries[self._entry] * self._factor

    def _find_rules(self) -> None:
        """For each property that parameters move and each matrix: which entries (z,), and by which partial of it each.

        With that, all of the slopes but their values.
        """
        probe, count = self._matrices.probe, len(self._matrices.elements)
        self._rules: list[tuple[str, str, np.ndarray, np.ndarray]] = []
        columns: dict[str, list[np.ndarray]] = {}
        at_probe, properties = self._direct(probe), self._bound.at(probe)[0]
        size = np.zeros(count)
        for property in self._bound.names:
            members, parameter, _ = self._bound.partials(probe, property)
            for name, entries in self._matrices.derivatives(probe, property).items():
                size[self._bound.members] = np.abs(properties[property])
                change = np.abs(self._spread(entries)) * size[self._element]
                standing = np.flatnonzero(change > _ROUNDING * np.abs(at_probe[name])).astype(np.int32)
                first = np.searchsorted(self._element[standing], np.arange(count + 1))
                counts = first[members + 1] - first[members]
                if counts.any():
                    pick = standing[ranges(first[members], counts)]
                    by = np.repeat(np.arange(len(members), dtype=np.int32), counts)
                    self._rules.append((property, name, pick, by))
                    columns.setdefault(name, []).append(parameter.astype(np.int32)[by])
        self._picked = {name: np.concatenate([r[2] for r in self._rules if r[1] == name]) for name in columns}
        self._columns = {}
        for name, pick in self._picked.items():
            place = self.places[name]
            self._columns[name] = np.concatenate(columns[name]), place.row[pick], place.col[pick]

    def _find_linear(self) -> None:
        theta = self._bound.near_nominal()
        here, there = self._slopes(theta), self._slopes(self._matrices.probe)
        self.linear = all(_agree(here[name], there[name]) for name in here)
        if self.linear:
            self._constant, at = here, self._direct(theta)
            moved = self._change(theta)
            self._base = {name: at[name] - moved.get(name, 0.0) for name in at}

    def _change(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """What the parameters of a linear term add to each matrix."""
        found = {}
        for name, slopes in self._constant.items():
            weights = slopes.value * theta[slopes.parameter]
            found[name] = np.bincount(self._picked[name], weights, minlength=len(self._element))
        return found

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Values (z,) of each matrix at theta."""
        if self._constant is None:
            return self._direct(theta)
        found = self._change(theta)
        for name, base in self._base.items():
            found[name] = found[name] + base if name in found else base
        return found

    def nominal(self) -> dict[str, np.ndarray]:
        """Values (z,) of each matrix where every property is as the mesh gives it."""
        return {name: self._spread(entries) for name, entries in self._matrices.at_nominal().items()}

    def _direct(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """Values from the elements themselves."""
        entries = self._base
        if self._bound.bindings:
            entries = {name: base.copy() for name, base in self._base.items()}
            self._matrices.add_moving(theta, entries)
        return {name: self._spread(values) for name, values in entries.items()}

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """First derivatives of each matrix that moves."""
        if self._constant is not None:
            return self._constant
        return self._slopes(theta) if self._bound.bindings else {}

    def _slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        values = {name: np.empty(len(pick)) for name, pick in self._picked.items()}
        done = dict.fromkeys(values, 0)
        for property in self._bound.names:
            entries = self._matrices.derivatives(theta, property)
            _, _, partial = self._bound.partials(theta, property)
            for _, name, pick, by in (rule for rule in self._rules if rule[0] == property):
                at = slice(done[name], done[name] + len(pick))
                np.multiply(self._spread(entries[name])[pick], partial[by], out=values[name][at])
                done[name] = at.stop
        return {name: Slopes(*self._columns[name], values[name]) for name in values}


def _agree(one: Slopes, other: Slopes) -> bool:
    """Whether derivatives are the same but for rounding."""
    a, b, size = np.abs(one.value), np.abs(other.value), np.zeros(one.parameter.max(initial=0) + 1)
    np.maximum.at(size, one.parameter, a)
    return bool((np.abs(one.value - other.value) <= _SAME * (a + b) + 1e-12 * size[one.parameter]).all())
