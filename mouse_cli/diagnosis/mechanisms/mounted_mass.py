"""A body on soft mounts, free along every axis: a machine, a pump, a battery that the model lacks; as many modes more as axes."""

from dataclasses import replace

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import node_at
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.likelihoods.modal.scales import BODY, highest, lowest, total_mass
from mouse_cli.diagnosis.mechanisms import Candidate
from mouse_cli.diagnosis.sites.points import Points, in_all_directions, placed
from mouse_cli.diagnosis.sites.reasons import translations
from mouse_cli.model.geometry import DIRECTIONS
from mouse_cli.model.problem import Problem

_PLACES = 6  # about so many of those on a line to begin from: there are many sizes for each
_BEGUN = 14, 5  # frequencies to begin from, of mounts that are alike, and of others, which the same looks begin
_ALIKE = 0.5  # prior probability that its mounts are as stiff along every axis


def recipes(model: Reduced, candidate: Candidate) -> list[Recipe]:
    """K + m [B, -1]'W^2 [B, -1], M + m on its own motion, for the translations B of a place and W = 2 pi f, one or each its own."""
    alike, each = in_all_directions(model), in_all_directions(model, "each direction its own")
    return [
        _recipe(model, candidate, replace(p, starts=p.starts[:: max(1, len(p.starts) // _PLACES)]), own, np.log(share))
        for points, own, share in ((alike, False, _ALIKE), (each, True, 1 - _ALIKE))
        for p in points
    ]


def _recipe(model: Reduced, candidate: Candidate, point: Points, own: bool, share: float) -> Recipe:
    """own: each direction has a frequency of its own."""
    d, hz = len(point.dofs), np.sqrt([lowest(model), highest(model)]) / (2 * np.pi)
    m = Unknown("mass", "kg", *(BODY * total_mass(model)))
    f = Unknown("frequency", "Hz", 0.3 * hz[0], 1.5 * hz[1])
    measured = model.data.test.frequency_hz[model.data.has_frequency]
    begun = np.concatenate([steps(f, _BEGUN[own]), measured])[:, None]  # one of those measured may be its own
    each = tuple(replace(f, name=f"frequency, {DIRECTIONS[k]}") for k in point.dofs) if own else (f,)
    made = placed(candidate, point, (m, *each), (np.zeros(1),) * (1 + len(each)), _change, _with_mounts, own=d)
    grid = [
        np.concatenate([[mass], np.repeat(hz, len(each)), at])
        for mass in steps(m, 2)
        for hz in begun
        for at in point.starts
    ]
    return replace(made, grid=np.array(grid), log_prior=made.log_prior + float(share))


def _change(sizes: np.ndarray, B: np.ndarray) -> Change:
    d = len(B)
    along = np.hstack([B, -np.eye(d)])
    M = np.zeros((along.shape[1],) * 2)
    M[-d:, -d:] = sizes[0] * np.eye(d)
    return Change((along.T * (sizes[0] * (2 * np.pi * np.broadcast_to(sizes[1:], d)) ** 2)) @ along, M)


def _with_mounts(problem: Problem, point: Points, at: np.ndarray, mass: float, *hz: float) -> Problem:
    edit, site = Edit(problem), point.site(at)
    node, along = node_at(edit, site), tuple(DIRECTIONS[k] for k in point.dofs)
    free = edit.node(edit.coordinates[node])
    edit.bind(f"mass on mounts at {site.text}", edit.add("mass", [[free]], {"mass": mass}), ("mass",), unit="kg")
    rates = dict(zip(along, np.broadcast_to(mass * (2 * np.pi * np.array(hz)) ** 2, len(along)).tolist(), strict=True))
    spring = edit.add("spring", [[node, free]], rates)
    for own in [along] if len(hz) == 1 else [(one,) for one in along]:
        edit.bind(f"mounts at {site.text}" + ("" if own == along else f", {own[0]}"), spring, own, unit="N/m")
    return edit.done()


CANDIDATE = Candidate(
    "mounted-mass",
    "a body on soft mounts",
    "oscillator",
    "a machine, a pump or an instrument on isolators that the model lacks, which moves against the structure along every axis: "
    "K + k [B, -1]'[B, -1] for the translations B of a place, with one frequency on its mounts or one for each axis",
    recipes,
    translations,
)
