"""A joint that twists: what a spring in torsion at a share of a bar takes from its stiffness, and the jump of its shapes there."""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change
from mouse_cli.diagnosis.effects.of_sets import OfSets, matrices_of
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.diagnosis.sites.left_out import Left, left_out
from mouse_cli.terms.elements import _beam as beam

_TURNS = [3, 4, 5, 9, 10, 11]  # of the motions of two nodes
_STILL = 1e-9  # share of the largest motion below which a bar does not twist


@dataclass(frozen=True)
class Torsion:
    """Of a bar GJ / l (N m/rad), and its inertia (kg m) per length against turns about it, which masses may be modelled without.

    left: what the coordinates leave out of a change of the stiffness; None: nothing.
    """

    GJ: float
    inertia: float
    left: Left | None


def torsion(model: Reduced, chosen: list[int]) -> dict[int, Torsion]:
    """Of the bars `chosen` those that the coordinates twist, by number."""
    bars, found = model.bars, {}
    whole, sets = {s: matrices_of(model, s) for s in {int(bars.set[bar]) for bar in chosen}}, OfSets()
    for bar in chosen:
        axis, element = np.tile(bars.axis[bar], 2), (int(bars.set[bar]), int(bars.member[bar]))
        K, M = (whole[element[0]][name][element[1]][np.ix_(_TURNS, _TURNS)] for name in "KM")
        GJ, polar = float(axis[:3] @ K[3:, 3:] @ axis[:3]), float(axis @ M @ axis)
        if GJ > 0 and np.abs(np.diff(bars.twist[bar], axis=0)).max() > _STILL * np.abs(bars.twist[bar]).max():
            found[bar] = Torsion(GJ, polar / float(bars.length[bar]), _left_out(model, bar, element, sets))
    return found


def _left_out(model: Reduced, bar: int, element: tuple[int, int], sets: OfSets) -> Left | None:
    """See `Torsion`."""
    angle = np.zeros(12)
    angle[_TURNS] = np.concatenate([-model.bars.axis[bar], model.bars.axis[bar]])
    twist = np.outer(angle, angle)[None]
    GJ = lambda there: angle @ sets.stiffness(there, [element])[0] @ angle / 4  # of both ends against one another by 1 each
    return left_out(model, ("torsion", element), model.bars.nodes[[bar]], lambda there: GJ(there) * twist)


def twisted(beside: Change, bars: Bars, bar: int, share: float, own: Torsion, k: float) -> Change:
    """What turns beside it, and a spring k (N m/rad) in torsion at a share of a bar.

    In series with the bar it takes the share GJ / (GJ + k) of its stiffness, and of the angle between its ends.
    """
    twist, lost = bars.twist[bar], own.GJ / (own.GJ + k)  # a share of the stiffness
    angle = twist[1] - twist[0]
    along, parting = beam.parted(float(bars.length[bar]), share)
    jump = lost * angle
    half = own.inertia * np.outer(along @ twist + 0.5 * parting * jump, jump)
    beyond = 0.0 if own.left is None else own.left.correction(-lost)
    return replace(beside, K=beyond - lost * own.GJ * np.outer(angle, angle), M=beside.M + half + half.T)
