"""A joint that twists: what a spring in torsion at a share of a bar takes from its stiffness, and the jump of its shapes there."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change
from mouse_cli.diagnosis.effects.losses import matrices_of
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.terms.elements import _beam as beam

_STILL = 1e-9  # share of the largest motion below which a bar does not twist


def torsion(model: Reduced, chosen: list[int]) -> dict[int, float]:
    """GJ / l (N m/rad) of bars by number; 0 of one that no coordinate twists."""
    bars, found = model.bars, {}
    whole = {s: matrices_of(model, s)["K"] for s in {int(bars.set[bar]) for bar in chosen}}
    for bar in chosen:
        K, axis = whole[int(bars.set[bar])][int(bars.member[bar])], bars.axis[bar]
        turns = np.abs(np.diff(bars.twist[bar], axis=0)).max() > _STILL * np.abs(bars.twist[bar]).max()
        found[bar] = max(float(axis @ K[9:12, 9:12] @ axis), 0.0) if turns else 0.0
    return found


def twisted(beside: Change, bars: Bars, bar: int, share: float, GJ: float, k: float) -> Change:
    """What turns beside it, and a spring k (N m/rad) in torsion at a share of a bar of stiffness `GJ` over its length.

    In series with the bar it leaves GJ / (1 + GJ / k), and the angle is that torque over k.
    """
    twist, soft = bars.twist[bar], GJ / (1 + GJ / k)
    angle = twist[1] - twist[0]
    planes = bars.twins[int(bars.set[bar]), int(bars.member[bar])]
    inertia = sum(float(bars.section_inertia[each]) for each in planes)
    along, parting = beam.parted(float(bars.length[bar]), share)
    jump = soft / k * angle
    half = inertia * np.outer(along @ twist + 0.5 * parting * jump, jump)
    return replace(beside, K=(soft - GJ) * np.outer(angle, angle), M=beside.M + half + half.T)
