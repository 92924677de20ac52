"""Matrices of element sets at the parameters where causes are weighed."""

from collections.abc import Iterable

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.terms.bound_properties import BoundProperties, nominal_properties
from mouse_cli.terms.elements import Layout, Matrices, registry


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
