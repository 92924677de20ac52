"""Supports from as good as free to as good as rigid, on a structure of unlike spans; truths by Hermite elements assembled here."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED

SPAN, TAIL = 2.0, 0.3  # m: a stiff bar between hinges, beyond them a slender tail to a clamp
STIFF, SLENDER = (2.0e5, 20.0), (400.0, 1.0)  # EI (N m2) and mass per length (kg/m)
EACH, FINE = 12, 2  # elements of the deck in either, and of the truth in each of these
COUNT, SENSORS = 5, (3, 6, 9, 13, 15, 17, 19, 21, 23)


def truth(turning: float | None, sliding: float | None) -> tuple[np.ndarray, np.ndarray]:
    """Hz (COUNT,) and deflections of the deck's nodes (25, COUNT); springs of the clamp, None: rigid."""
    n = 2 * EACH * FINE
    K, M = np.zeros((2, 2 * n + 2, 2 * n + 2))
    for e in range(n):
        (EI, m), L = (STIFF, SPAN) if e < n // 2 else (SLENDER, TAIL)
        l, at = L / (EACH * FINE), slice(2 * e, 2 * e + 4)
        unit = np.outer([1, l, 1, l], [1, l, 1, l])
        K[at, at] += EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
        mass = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
        M[at, at] += m * l / 420 * unit * mass
    held = {0, n}
    for dof, k in ((2 * n, sliding), (2 * n + 1, turning)):
        if k is None:
            held.add(dof)
        else:
            K[dof, dof] += k
    own = np.array([i for i in range(2 * n + 2) if i not in held])
    lam, X = eigh(K[np.ix_(own, own)], M[np.ix_(own, own)], subset_by_index=[0, COUNT - 1])
    shapes = np.zeros((2 * n + 2, COUNT))
    shapes[own] = X
    return np.sqrt(lam) / (2 * np.pi), shapes[:: 2 * FINE]


def deck(hz: np.ndarray, shapes: np.ndarray) -> str:
    """Clamped rigidly; 0.1 % and 0.5 % of noise."""
    rng = np.random.default_rng(13)
    shapes = shapes[list(SENSORS)] / np.abs(shapes).max(axis=0)
    rows = ", ".join(
        f"[{', '.join(f'{v:.6f}' for v in row)}]" for row in shapes + 5e-3 * rng.standard_normal(shapes.shape)
    )
    hz = hz * (1 + 1e-3 * rng.standard_normal(COUNT))
    bars = "\n".join(
        f"      - {{id: {first}-{first + EACH - 1}, type: beam, nodes: {first}-{first + EACH}, E: {EI}, A: {m}, density: 1, Iz: 1}}"
        for first, (EI, m) in ((1, STIFF), (1 + EACH, SLENDER))
    )
    return f"""mouse: 1
title: a stiff bar with a slender tail
model:
  structure:
    nodes:
      - {{line: {{from: 1, to: {1 + EACH}, start: [0, 0], end: [{SPAN}, 0]}}}}
      - {{line: {{from: {2 + EACH}, to: {1 + 2 * EACH}, start: [{SPAN + TAIL / EACH}, 0], end: [{SPAN + TAIL}, 0]}}}}
    elements:
{bars}
    directions: [TY, RZ]
    supports: {{1: [TY], {1 + EACH}: [TY], {1 + 2 * EACH}: all}}
parameters:
  - {{name: E of the bar, elements: 1-{EACH}, property: E, sd: 2 %}}
  - {{name: E of the tail, elements: {1 + EACH}-{2 * EACH}, property: E, sd: 2 %}}
test:
  modes:
    frequency: [{", ".join(f"{v:.8g}" for v in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{i + 1}TY" for i in SENSORS)}]
    shapes: [{rows}]
    shape_sd: 0.5 %
"""


@pytest.mark.parametrize(
    ("name", "turning", "sliding"),
    [("support-rotation", 0.5 * SLENDER[0] / TAIL, None), ("support-translation", None, 12 * SLENDER[0] / TAIL**3)],
)
def test_the_true_stiffness_is_far_inside_the_range(name, turning, sliding):
    """Not on the scale of the whole, whose EI / L is that of the stiff bar and 55 times as large as the tail's."""
    problem = assemble(yaml_deck.read(deck(*truth(turning, sliding)), "tail.yaml"))
    study = Study(reduced(problem, problem.prior.mean))
    ranges = [each.unknowns[0] for each in study.recipes(name) if f"node {1 + 2 * EACH}" in each.site(None).text]
    assert ranges
    for k in ranges:
        assert k.lower < 0.05 * (turning or sliding)
        assert k.upper > 100 * (turning or sliding)


@pytest.mark.parametrize(
    ("name", "turning", "sliding"),
    [("support-rotation", 0.5 * SLENDER[0] / TAIL, None), ("support-translation", None, 0.0)],
)
def test_it_is_named(name, turning, sliding):
    """A clamp that turns as easily as the tail bends; a clamp that slides as if nothing held it.

    Beside the latter a law of unknown size is so ill-determined that its Hessian is singular to rounding, which is no evidence.
    """
    found = diagnose(assemble(yaml_deck.read(deck(*truth(turning, sliding)), "tail.yaml")))
    assert (found.kind, [each.physics for each in found.best.causes]) == (NAMED, [name])
    if turning:
        (k,) = found.best.causes[0].sizes
        assert abs(k.value - turning) < 3 * k.sd and k.sd < 0.2 * turning


@pytest.mark.filterwarnings("error")
def test_a_step_far_beyond_the_prior_is_finite():
    """A trial step of a thousand prior sd, as a descent takes beside a support that holds nothing, overflows nowhere."""
    problem = assemble(yaml_deck.read(deck(*truth(None, 0.0)), "tail.yaml"))
    study = Study(reduced(problem, problem.prior.mean))
    (joint, *_) = study.recipes("joint")
    model = study.kind(study.model, (joint,))
    x = np.concatenate([np.full(study.k, 1e5), joint.coordinates(joint.grid[0])])
    assert np.isfinite(model.added(x)[0]).all()


def test_a_hinge_at_the_clamp_is_the_flexible_clamp():
    """There both are one spring against turning, whichever candidate has it; elsewhere along the tail, or at a hinge, it is not."""
    problem = assemble(yaml_deck.read(deck(*truth(None, None)), "tail.yaml"))
    found = {}
    for one in Study(reduced(problem, problem.prior.mean)).recipes("joint"):
        where = one.unknowns[-1]
        if where.name == "place":
            stiff = one.unknowns[0].lower
            for s in (0.0, 0.5 * where.upper, where.upper):
                at = one.coordinates(np.array([stiff, s]))
                found[round(one.site(one.values(at)).position[0], 6)] = one.group(at)
    clamp = SPAN + TAIL
    assert found[clamp] == "support"
    assert {group for x, group in found.items() if x != clamp} == {"local-stiffness"} and len(found) > 2
