"""Matrices of element sets at the parameters where causes are weighed."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.terms.bound_properties import BoundProperties, nominal_properties
from mouse_cli.terms.elements import Layout, Matrices, registry

_STEP = 1e-4  # of a parameter, in differences


def matrices_of(model: Reduced, s: int, exchanged: Iterable[tuple[str, str]] = (), **instead: float) -> Matrices:
    """Matrices of the elements of set s, at the parameters where causes are weighed; exchanged: pairs of properties that are.

    instead: other values of properties.
    """
    mesh = model.problem.mesh
    elements, kind = mesh.elements[s], registry()[mesh.elements[s].type]
    options = {k: o.default for k, o in kind.options.items()} | elements.options
    layout = Layout(mesh.coordinates[elements.nodes], options)
    properties = {k: np.array(v, float) for k, v in nominal_properties(kind, elements, layout).items()}
    own = tuple(b for b in model.problem.bindings if b.set == s)
    if own:
        bound = BoundProperties(kind, elements, layout, own)
        for name, value in bound.at(model.theta)[0].items():
            properties[name][bound.members] = value
    for name in instead.keys() & properties.keys():
        properties[name][:] = instead[name]
    for one, other in exchanged:
        properties[one], properties[other] = properties[other], properties[one]
    return kind.matrices(layout, properties)


class OfSets:
    """K of the elements of sets (e, 12, 12) at the parameters of any model, found once."""

    def __init__(self) -> None:
        self._found: dict[tuple[int, bytes], np.ndarray] = {}

    def stiffness(self, model: Reduced, elements: Iterable[tuple[int, int]]) -> np.ndarray:
        """That of `elements`, by set and place in it."""
        theta = model.theta.tobytes()
        for s in {s for s, _ in elements}:
            if (s, theta) not in self._found:
                self._found[s, theta] = matrices_of(model, s)["K"]
        return np.array([self._found[s, theta][i] for s, i in elements])


def of_section(model: Reduced, s: int) -> Matrices:
    """Matrices of the elements of set s without what their section only carries."""
    return matrices_of(model, s, nonstructural_mass=0.0)


class Growth:
    """How K and M of elements grow with each parameter of the deck, over what they are: those of a set found once.

    What takes all of a member away takes all of it at any E and density. part(model, s): what of the elements of a set.
    """

    def __init__(self, model: Reduced, part: Callable[[Reduced, int], Matrices] = of_section) -> None:
        self._model, self._part = model, part
        self._found: dict[int, tuple[np.ndarray, np.ndarray]] = {}

    def of(self, elements: Iterable[tuple[int, int]]) -> tuple[np.ndarray, np.ndarray]:
        """Of `elements`, by set and place in it: of K and of M (p,), the multiples of them that come nearest."""
        along, size = (sum(part) for part in zip(*(self._at(*each) for each in elements), strict=True))
        grows = along / np.maximum(size, 1e-300)[:, None]
        return grows[0], grows[1]

    def _at(self, s: int, i: int) -> tuple[np.ndarray, np.ndarray]:
        """<dX/dtheta, X> (2, p) and <X, X> (2,) of K and M of one element."""
        if s not in self._found:
            self._found[s] = self._of_set(s)
        along, size = self._found[s]
        return along[:, :, i], size[:, i]

    def _of_set(self, s: int) -> tuple[np.ndarray, np.ndarray]:
        """The same of all elements (2, p, e) and (2, e); springs have no M."""
        model, own = self._model, self._part(self._model, s)
        along, size = np.zeros((2, len(model.theta), len(own["K"]))), np.zeros((2, len(own["K"])))
        moves = {b.parameter for b in model.problem.bindings if b.set == s}
        for n, name in enumerate(name for name in "KM" if name in own):
            size[n] = (own[name] ** 2).sum(axis=(1, 2))
        for j in moves:
            step = _STEP * (abs(model.theta[j]) or 1.0)
            there = self._part(replace(model, theta=model.theta + step * (np.arange(len(model.theta)) == j)), s)
            for n, name in enumerate(name for name in "KM" if name in own):
                along[n, j] = ((there[name] - own[name]) * own[name]).sum(axis=(1, 2)) / step
        return along, size
