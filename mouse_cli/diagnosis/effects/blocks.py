"""A support on a block of its own: it gives way against the ground, and what gives way has a mass.

A flexible support without mass moves as its spring is loaded. A foundation, a pedestal or the table of a test stand has inertia
too, so that structure and block are two bodies: K + k e e', M + m e e' in the motion e of the support, which carries the structure
along as statics says (Wolf, Dynamic Soil-Structure Interaction, 1985, ch. 3). Sought are k and the frequency of the block alone,
sqrt(k / m) / (2 pi): far above the band it is a flexible support, far below it a mass in free space.
"""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Recipe, Unknown, product, steps
from mouse_cli.diagnosis.effects.released import SOFTEST, STIFFEST, followed, free_model, resistance, static
from mouse_cli.diagnosis.effects.support_sets import support_site
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import highest, lowest
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_MOST = 8  # supports that are looked at: those that bear most
_LOADED = 0.02  # share of the largest reaction below which a support is not loaded
_STARTS = 5, 6  # stiffnesses and frequencies to begin from
_BAND = 0.3, 3.0  # of the lowest and the highest measured frequency: own frequencies of blocks


def blocks(model: Reduced, candidate: Candidate, turning: bool) -> list[Recipe]:
    """A recipe for each support that the measured modes load, in translation or in rotation."""
    mesh, kinds = model.problem.mesh, range(3, 6) if turning else range(3)
    if model.motion is None or model.problem.held is not None:
        return []
    held = [(node, d) for node, d in mesh.supports.tolist() if d in kinds and d in mesh.directions]
    free = free_model(model)
    held = [each for each in held if _label(model, *each) in free.place]
    if not held:
        return []
    s = np.array([free.place[_label(model, *each)] for each in held])
    load = np.abs(free.reactions(model, s, slice(0, model.low_modes()))).max(axis=1)
    order = np.sort(np.argsort(-load, kind="stable")[:_MOST])
    own = order[load[order] > _LOADED * load.max()]
    moved = followed(model, free, static(model, free, s[own], np.eye(len(own))))
    against = resistance(model, moved.K, moved.M)
    return [
        _recipe(model, candidate, held[i], moved.part([n], model.r), float(against[n]), len(own))
        for n, i in enumerate(own.tolist())
    ]


def _label(model: Reduced, node: int, d: int) -> str:
    return f"{model.problem.mesh.node_ids[node]}{DIRECTIONS[d]}"


def _recipe(model: Reduced, candidate: Candidate, held: tuple[int, int], moved, against: float, count: int) -> Recipe:
    hz = np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    unit = "N m/rad" if held[1] > 2 else "N/m"
    k = Unknown("stiffness of the ground", unit, SOFTEST * against, STIFFEST * against)
    f = Unknown("frequency of the block alone", "Hz", _BAND[0] * hz[0], _BAND[1] * hz[1])
    support = support_site(model.problem, [held])
    site = replace(support, text=f"{support.text}, on a block")

    def change(values: np.ndarray):
        found, M = moved.on_springs(values[:1]), moved.M.copy()
        M[-1, -1] += _inertia(*values)
        return replace(found, M=M)

    extend = lambda problem, values: _on_block(problem, model.problem, held, *values)
    grid = product(steps(k, _STARTS[0]), steps(f, _STARTS[1]))
    prior = -float(np.log(count))
    return Recipe(
        candidate, (k, f), change, grid, lambda values: site, 1, log_prior=prior, extend=extend, carried=moved.carried
    )


def _inertia(k: float, hz: float) -> float:
    """Mass (kg) or moment of inertia (kg m2) of a block."""
    return k / (2 * np.pi * hz) ** 2


def _on_block(problem: Problem, known: Problem, held: tuple[int, int], k: float, hz: float) -> Problem:
    """The deck with a spring in place of the support, and the inertia of the block, in its direction alone, behind it."""
    edit, (there, d) = Edit(problem), held
    node, text = edit.index(int(known.mesh.node_ids[there])), support_site(known, [held]).text
    edit.supports = [each for each in edit.supports if each != (node, d)]
    unit, name, of = ("N m/rad", f"J{'xyz'[d - 3]}", "kg m2") if d > 2 else ("N/m", "mass", "kg")
    spring = edit.add("spring", [[node]], {DIRECTIONS[d]: k})
    edit.bind(f"stiffness of the ground under {text}", spring, (DIRECTIONS[d],), unit=unit)
    block = edit.add("mass", [[node]], {"mass": 0.0} | {name: _inertia(k, hz)})
    edit.bind(f"inertia of the block under {text}", block, (name,), unit=of)
    return edit.done()
