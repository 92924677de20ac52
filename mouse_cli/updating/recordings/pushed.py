"""Parameters that records push out of their prior: the law that does what such a parameter does, begun from what it did.

A mass that was added where the deck has a mass to revise is no residual: the parameter takes it, at any price. A first look beside
that sees nothing; here the parameter goes back to its mean, and the law begins with what it has moved.
"""

from collections.abc import Iterator

import numpy as np

from mouse_cli.terms.laws import Law
from mouse_cli.updating.recordings.acting import Place
from mouse_cli.updating.recordings.adequacy import shifted
from mouse_cli.updating.recordings.polish import Fit
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
    """Laws at a place that do what parameter number i has done, with that much of it."""
    back = one.x.copy()
    back[i] = one.hypothesis.mean[i]
    k = one.hypothesis.linear.k
    there, here = one.hypothesis.linear.matrices(np.array([one.x[:k], back[:k]])), place.directions
    moved = [matrix[0] - matrix[1] for matrix in there]  # M, C, K
    for law in allowed(place, laws):
        if not law.linear or law.motions > 1:
            continue
        for variant, words in enumerate(law.variants):
            K, C, M = law.matrices(np.ones(len(law.parameters)), **words)
            if len(law.parameters) != 1 or len(K) > 1:
                continue
            size = _size(moved, [here @ each @ here.T for each in (M, C, K)])
            hypothesis = one.hypothesis.placed(place).at(law, variant)
            if size > 0:
                x = np.append(back, np.log(size))
                yield Start(hypothesis, np.clip(x, *hypothesis.bounds), 0.0)


def _size(moved: list[np.ndarray], unit: list[np.ndarray]) -> float:
    """How many times `unit` matrices `moved` are; 0 where they are no multiple."""
    flat = [np.concatenate([each.ravel() for each in scaled]) for scaled in _scaled(moved, unit)]
    product, norms = float(flat[0] @ flat[1]), float(np.linalg.norm(flat[0]) * np.linalg.norm(flat[1]))
    return product / float(flat[1] @ flat[1]) if norms > 0 and product > _SAME * norms else 0.0


def _scaled(moved: list[np.ndarray], unit: list[np.ndarray]) -> Iterator[list[np.ndarray]]:
    """Both, each of M, C and K in a unit of its own, so that none is lost beside the others."""
    sizes = [
        max(float(np.abs(one).max()), float(np.abs(other).max())) or 1.0 for one, other in zip(moved, unit, strict=True)
    ]
    yield from ([each / size for each, size in zip(three, sizes, strict=True)] for three in (moved, unit))
