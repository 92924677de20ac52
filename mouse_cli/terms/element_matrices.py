"""Matrices of the elements of one set at any values of the parameters, before supports and links act."""

from dataclasses import replace

import numpy as np

from mouse_cli.model.mesh import Binding, ElementSet
from mouse_cli.model.term import MATRICES
from mouse_cli.terms.elements import ElementType, Layout, Matrices, Properties

_STEP = 1e-20  # of the complex step, times the value: the truncation error, of order step^2, is far below rounding


class BoundProperties:
    """Properties of those elements of a set that parameters move, `members` (b,); what does not move is nominal.

    A property is its nominal value, or the value of a parameter, times the factors that are bound to it.
    """

    def __init__(self, kind: ElementType, elements: ElementSet, layout: Layout, bindings: tuple[Binding, ...]):
        self.kind = kind
        touched = [np.asarray(b.members, int) for b in bindings]
        self.members = np.unique(np.concatenate([*touched, np.zeros(0, int)])).astype(int)
        self.bindings = tuple(
            replace(b, members=np.searchsorted(self.members, m)) for b, m in zip(bindings, touched, strict=True)
        )
        self.names = tuple(dict.fromkeys(b.property for b in bindings))
        axial = None if layout.axial is None else layout.axial[self.members]
        self.layout = Layout(layout.coordinates[self.members], layout.options, axial)
        self._nominal = {name: value[self.members] for name, value in elements.properties.items()}
        self._own = {name: sorted((b for b in self.bindings if b.property == name), key=_order) for name in self.names}

    def at(self, theta: np.ndarray, stepped: str | None = None) -> tuple[Properties, np.ndarray | None]:
        """All properties (b,) each at theta, and the imaginary step (b,) taken in the property `stepped`."""
        found: Properties = {}
        step = None
        for name, declared in self.kind.properties.items():
            value = nominal(declared, name, self._nominal, self.layout, found)
            if name in self._own:
                value = np.array(value)
                for b in self._own[name]:
                    value[b.members] = theta[b.parameter] * (value[b.members] if b.factor else 1.0)
            if name == stepped:
                step = _STEP * np.where(value == 0, 1.0, value)
                value = value + 1j * step
            found[name] = value
        return found, step

    def partials(self, theta: np.ndarray) -> list[np.ndarray]:
        """For each binding, d(property)/d(theta) (b,) of the elements; a property is a product in which each theta stands once."""
        properties, found = self.at(theta)[0], []
        for b in self.bindings:
            at, own = theta[b.parameter], properties
            if at == 0:
                at, other = 1.0, theta.copy()
                other[b.parameter] = at
                own = self.at(other)[0]
            share = np.zeros(len(self.members))
            share[b.members] = own[b.property][b.members] / at
            found.append(share)
        return found

    def nominal_theta(self) -> np.ndarray:
        """Parameters (as many as the bindings know of) at which every property is near its nominal value."""
        theta = np.ones(1 + max((b.parameter for b in self.bindings), default=-1))
        for b in self.bindings:
            if not b.factor and b.property in self._nominal:
                theta[b.parameter] = self._nominal[b.property][b.members].mean() or 1.0
        return theta


def _order(binding: Binding) -> bool:
    return binding.factor  # values first, then the factors that multiply them


def nominal(declared, name: str, given: Properties, layout: Layout, found: Properties) -> np.ndarray:
    """Value (e,) of a property before any parameter acts: as given, its default, or what follows from those `found`."""
    if name in given:
        return given[name]
    if callable(declared.default):
        return declared.default(layout, found)
    return np.full(len(layout), 0.0 if declared.default is None else declared.default)


def all_nominal(kind: ElementType, elements: ElementSet, layout: Layout) -> Properties:
    """Nominal values (e,) of every property of `kind`."""
    found: Properties = {}
    for name, declared in kind.properties.items():
        found[name] = nominal(declared, name, elements.properties, layout, found)
    return found


class ElementMatrices:
    """K, M, C, D (e, d, d) of a set of elements over d = 6 k degrees of freedom each, and their derivatives.

    standing: for each matrix that there is, mask (e, d, d) of the entries that may differ from zero.
    """

    def __init__(self, kind: ElementType, elements: ElementSet, layout: Layout, bindings: tuple[Binding, ...]):
        self.kind, self.layout = kind, layout
        self.nominal = kind.damped(layout, all_nominal(kind, elements, layout))
        self.bound = BoundProperties(kind, elements, layout, bindings)
        self.standing = {name: self.nominal[name] != 0 for name in MATRICES if name in self.nominal}
        self._probes = self._random_thetas()
        for theta in self._probes:
            for name, matrix in self.at(theta).items():
                mask = self.standing.setdefault(name, np.zeros((len(layout), *matrix.shape[1:]), bool))
                mask[self.bound.members] |= matrix != 0
        self.standing = {name: mask for name, mask in self.standing.items() if mask.any()}

    def _random_thetas(self) -> list[np.ndarray]:
        """Parameters at which no entry vanishes by chance."""
        draw, theta = np.random.default_rng(1), self.bound.nominal_theta()
        return [theta * draw.uniform(0.6, 1.4, len(theta)) for _ in range(2)] if self.bound.bindings else []

    def at(self, theta: np.ndarray) -> Matrices:
        """Matrices (b, d, d) of the elements that parameters move."""
        return self.kind.damped(self.bound.layout, self.bound.at(theta)[0])

    def derivatives(self, theta: np.ndarray, name: str) -> Matrices:
        """Derivatives (b, d, d) by the property `name` of each element, by a complex step."""
        properties, step = self.bound.at(theta, name)
        found = self.kind.damped(self.bound.layout, properties)
        return {key: matrix.imag / step[:, None, None] for key, matrix in found.items() if np.iscomplexobj(matrix)}

    def diagonal(self, name: str, share: float) -> np.ndarray:
        """Mask (e, d) of the diagonal entries that may be more than `share` of the largest one of their element."""
        found = np.einsum("eii->ei", self.standing[name]).copy()
        matrix = self.nominal.get(name)
        if matrix is not None:
            values = np.abs(np.einsum("eii->ei", matrix))
            small = (values > 0) & (values <= share * values.max(axis=1, keepdims=True))
            found &= ~small
        return found

    @property
    def probes(self) -> list[np.ndarray]:
        """Parameters at which no entry vanishes by chance, for finding out patterns."""
        return self._probes
