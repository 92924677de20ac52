"""Matrices of bars after Timoshenko, as changes of those after Euler and Bernoulli."""

from typing import Any

import numpy as np

from mouse_cli.diagnosis.effects.change import Change, Recipe, Softening, Unknown, steps
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.extend.places import every_beam
from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.sites.bars import Bars
from mouse_cli.model.problem import Problem
from mouse_cli.terms.elements import _beam as beam

_SOLID = 2.0, 10.0  # E / (kappa G) from what no solid section goes below to thin-walled ones


def slender(model: Reduced) -> bool:
    """Whether all bars bend after Euler and Bernoulli without the inertia of turning sections, so that either can be added."""
    if model.bars is None:
        return False
    options = [each.options for each in model.problem.mesh.elements if each.type == "beam"]
    theory = all((o.get("theory") or "euler-bernoulli") == "euler-bernoulli" for o in options)
    return theory and not any(o.get("rotary_inertia") == "included" for o in options)


def shear_range(bars: Bars) -> tuple[float, float]:
    """E / (kappa G) for which EI / (kappa G A L^2) is between 1e-5 and 3e-2, L the longest line; that of solid bars is within."""
    radius = float(np.average(bars.EI / bars.E / bars.A, weights=bars.length))
    return min(1e-5 * bars.span**2 / radius, _SOLID[0]), max(3e-2 * bars.span**2 / radius, _SOLID[1])


def shear(model: Reduced, ratio: float, turning: bool) -> Change:
    """Bars with E / (kappa G) = `ratio`: F_aa = l / (3 EI) (1 + phi), and shapes with phi in the mass."""
    bars = model.bars
    phi = 12 * (bars.EI / bars.E) / bars.A * ratio / bars.length**2
    added = np.zeros((len(bars), 2, 2))
    added[:, 1, 1] = bars.length / (3 * bars.EI) * phi
    thick, slender = _mass(bars, np.stack([phi, 0 * phi]))
    blocks = np.where(lumped(model)[:, None, None], 0.0, thick - slender)
    M = bars.added(blocks) + (rotary(model, phi) if turning else 0.0)
    return Change(M=M, softening=Softening(np.arange(len(bars)), added))


def rotary(model: Reduced, phi: np.ndarray | None = None) -> np.ndarray:
    """Mass (r, r) of sections that turn."""
    bars = model.bars
    _, _, rotation = beam.shapes(bars.length, np.zeros(len(bars)) if phi is None else phi)
    blocks = beam.integral(rotation, bars.section_inertia * bars.length)
    ends = (bars.section_inertia * bars.length / 2)[:, None, None] * np.diag([0.0, 1.0, 0.0, 1.0])
    return bars.added(np.where(lumped(model)[:, None, None], ends, blocks))


def lumped(model: Reduced) -> np.ndarray:
    """Mask (b,) of the bars whose mass is at their ends."""
    sets = model.problem.mesh.elements
    return np.array([sets[s].options.get("mass") in beam.AT_ENDS for s in model.bars.set.tolist()])


def _mass(bars: Bars, phi: np.ndarray) -> np.ndarray:
    """Mass (c, b, 4, 4) of the bars for rows phi (c, b)."""
    count = len(phi)
    w, _ = beam.inertial(np.tile(bars.length, count), phi.ravel())
    return beam.integral(w, np.tile(bars.line_mass * bars.length, count)).reshape(count, len(bars), 4, 4)


def sheared(model: Reduced, candidate: Any, turning: bool) -> list[Recipe]:
    """All bars with phi = 12 EI / (kappa G A l^2), from E / (kappa G); turning: with the inertia of their sections too."""
    if not slender(model):
        return []
    ratio = Unknown("E / (kappa G)", "1", *shear_range(model.bars))
    change = lambda values: shear(model, values[0], turning)
    extend = lambda problem, values: with_shear(problem, values[0], turning)
    return [Recipe(candidate, (ratio,), change, steps(ratio, 8)[:, None], extend=extend)]


def with_shear(problem: Problem, ratio: float, turning: bool) -> Problem:
    """All beams after Timoshenko with E / (kappa G) = `ratio`; kappa is estimated."""
    edit = Edit(problem)
    beams = every_beam(edit)
    for s in sorted({s for s, _ in beams}):
        edit.option(s, theory="timoshenko", rotary_inertia="included" if turning else "omitted")
    kappa = np.array([edit.values(e, "E") / edit.values(e, "G") for e in beams]) / ratio
    for name in ("kappa_y", "kappa_z"):
        edit.put(beams, name, kappa)
    edit.bind("shear coefficient", beams, ("kappa_y", "kappa_z"), unit="1")
    return edit.done()


def with_rotary(problem: Problem, factor: float) -> Problem:
    """The inertia of turning sections of all beams, `factor` times density I."""
    edit = Edit(problem)
    beams = every_beam(edit)
    for s in sorted({s for s, _ in beams}):
        edit.option(s, rotary_inertia="included")
    edit.put(beams, "rotary_factor", np.full(len(beams), factor))
    edit.bind("inertia of turning sections", beams, ("rotary_factor",), unit="1")
    return edit.done()
