"""Properties of elements at given values of the parameters."""

from dataclasses import replace

import numpy as np

from mouse_cli.model.mesh import Binding, ElementSet
from mouse_cli.terms.elements import ElementType, Layout, Properties, Property

_SMALL = 1e-280  # a value whose step would be no number
_STEP = 1e-20  # of the complex step, times the value: the truncation error, of order step^2, is far below rounding


class BoundProperties:
    """Properties of those elements of a set that parameters move, `members` (b,); what does not move is nominal.

    A property is its nominal value, or the value of a parameter, times the factors that are bound to it.
    """

    def __init__(self, kind: ElementType, elements: ElementSet, layout: Layout, bindings: tuple[Binding, ...]):
        self.kind, self.bindings = kind, bindings
        touched = [np.asarray(b.members, int) for b in bindings]
        self.members = np.unique(np.concatenate([*touched, np.zeros(0, int)])).astype(int)
        local = [replace(b, members=np.searchsorted(self.members, m)) for b, m in zip(bindings, touched, strict=True)]
        self._layout = layout.of(self.members)
        self._nominal = {name: value[self.members] for name, value in elements.properties.items()}
        self._own: dict[str, list[Binding]] = {}
        for b in sorted(local, key=lambda b: b.factor):  # values first, then the factors that multiply them
            self._own.setdefault(b.property, []).append(b)

    @property
    def names(self) -> tuple[str, ...]:
        """Properties that parameters move."""
        return tuple(self._own)

    def at(self, theta: np.ndarray, stepped: str | None = None) -> tuple[Properties, np.ndarray | None]:
        """All properties (b,) each at theta, and the imaginary step (b,) taken in the property `stepped`."""
        found: Properties = {}
        step = None
        for name, declared in self.kind.properties.items():
            value = _nominal(declared, name, self._nominal, self._layout, found)
            if name in self._own:
                value = np.array(value)
                for b in self._own[name]:
                    value[b.members] = theta[b.parameter] * (value[b.members] if b.factor else 1.0)
            if name == stepped:
                step = _STEP * np.where(np.abs(value.real) < _SMALL, 1.0, value.real)
                value = value + 1j * step
            found[name] = value
        return found, step

    def partials(self, theta: np.ndarray, property: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Which element of the set, which parameter, and d(property)/d(parameter), for each binding of `property` in turn.

        A property is a product in which each parameter stands once.
        """
        value, own = self.at(theta)[0][property], self._own[property]
        found = []
        for b in own:
            at, here = theta[b.parameter], value
            if at == 0:
                at, other = 1.0, theta.copy()
                other[b.parameter] = at
                here = self.at(other)[0][property]
            found.append(here[b.members] / at)
        members = np.concatenate([self.members[b.members] for b in own])
        return members, np.repeat([b.parameter for b in own], [len(b.members) for b in own]), np.concatenate(found)

    def near_nominal(self, random: bool = False) -> np.ndarray:
        """Parameters (as many as the bindings know of) at which every property is about nominal."""
        theta = np.ones(1 + max((b.parameter for own in self._own.values() for b in own), default=-1))
        for own in self._own.values():
            for b in own:
                if not b.factor and b.property in self._nominal:
                    theta[b.parameter] = self._nominal[b.property][b.members].mean() or 1.0
        return theta * np.random.default_rng(1).uniform(0.6, 1.4, len(theta)) if random else theta


def nominal_properties(kind: ElementType, elements: ElementSet, layout: Layout) -> Properties:
    """Nominal values (e,) of every property of `kind`."""
    found: Properties = {}
    for name, declared in kind.properties.items():
        found[name] = _nominal(declared, name, elements.properties, layout, found)
    return found


def _nominal(declared: Property, name: str, given: Properties, layout: Layout, found: Properties) -> np.ndarray:
    """Value (e,) of a property before any parameter acts: as given, its default, or what follows from those `found`."""
    if name in given:
        return given[name]
    if callable(declared.default):
        return declared.default(layout, found)
    return np.full(len(layout), 0.0 if declared.default is None else declared.default)
