"""Parameters that records push out of their prior: the law that does what such a parameter does, begun from what it did.

A mass that was added where the deck has a mass to revise is no residual: the parameter takes it, at any price. A first look beside
that sees nothing; here the parameter goes back to its mean, and the law begins with what it has moved.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.terms.laws import Law
from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.adequacy import shifted
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.regression import Start, allowed

_FAR, _MOST = 3.0, 3  # prior sd from which on a parameter is pushed; such parameters that are tried
_SAME = 0.999  # cosine between what a law and a parameter do to a matrix, from which on they do the same


def pushed(one: Fit, places: list[Place], laws: list[Law] | None) -> list[Start]:
    """Starts beside the laws of a fit, those of the furthest parameter first."""
    k = one.hypothesis.linear.k
    z = np.abs(shifted(one)[:k])
    far = [i for i in np.argsort(-z, kind="stable").tolist() if z[i] > _FAR][:_MOST]
    return [start for i in far for place in places for start in _alike(one, i, place, laws)]


def _alike(one: Fit, i: int, place: Place, laws: list[Law] | None) -> Iterator[Start]:
    """Laws of one size at a place that do what parameter number i has done, with that much of it."""
    k, back, B = one.hypothesis.linear.k, one.x.copy(), place.directions
    back[i] = one.hypothesis.mean[i]
    there = one.hypothesis.linear.matrices(np.array([one.x[:k], back[:k]]))
    moved = [there[which][0] - there[which][1] for which in (2, 1, 0)]  # K, C, M, as laws have them
    for law in (each for each in allowed(place, laws) if each.linear and len(each.parameters) == 1):
        for variant in law.variants_at(place.scale):
            unit = law.on(B.shape[1], np.ones(1), law.variants[variant])
            size = _size(moved, [B @ each @ B.T for each in unit]) if len(unit[0]) == B.shape[1] else 0.0
            if size > 0:
                hypothesis = one.hypothesis.placed(place).at(law, variant)
                yield Start(hypothesis, np.clip(np.append(back, np.log(size)), *hypothesis.bounds), 0.0)


def _size(moved: list[np.ndarray], unit: list[np.ndarray]) -> float:
    """How many times `unit` matrices `moved` are, K, C and M each in a unit of its own; 0 where they are no multiple."""
    scale = [max(float(np.abs(each).max()) for each in pair) or 1.0 for pair in zip(moved, unit, strict=True)]
    a, b = (
        np.concatenate([(each / s).ravel() for each, s in zip(three, scale, strict=True)]) for three in (moved, unit)
    )
    product, norms = float(a @ b), float(np.linalg.norm(a) * np.linalg.norm(b))
    return product / float(b @ b) if norms > 0 and product > _SAME * norms else 0.0
