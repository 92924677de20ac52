"""A bed under a part of a clamped beam: modes by finite elements written here, the part named with its extent."""

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import added_mass
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED

LENGTH, EI, MASS, MODES = 2.0, 2.1e11 * 1.0e-8, 7850 * 4.0e-4, 5  # m, N m2, kg/m
SENSORS = range(3, 29, 2)
BED = 3000 * EI / LENGTH**4  # N/m2


def measured(bed: float, first: float, last: float, more: float = 0.0, lost: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Hz (m,) and deflections (29, m) of inner nodes of 30 elements, each made of four Hermite elements here.

    bed (N/m2) and `more` mass (kg/m) between two shares of the length; lost: a bed all along but there.
    """
    n = 120
    l = LENGTH / n
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = l / 420 * unit * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * n + 2, 2 * n + 2))
    for e in range(n):
        at, within = slice(2 * e, 2 * e + 4), first <= (e + 0.5) * l / LENGTH <= last
        K[at, at] += k + bed * m * (within != lost)
        M[at, at] += (MASS + more * within) * m
    inner = slice(2, 2 * n)
    lam, X = eigh(K[inner, inner], M[inner, inner], subset_by_index=[0, MODES - 1])
    return np.sqrt(lam) / (2 * np.pi), X[6::8]  # node 1 of 30 is the fourth of 120


def clamped(hz: np.ndarray, shapes: np.ndarray, bed: float = 0.0):
    """A clamped beam that has nothing of it, or a bed all along."""
    under = f"\n      - {{id: 31-60, type: foundation, nodes: 1-31, ky: {bed}}}" if bed else ""
    factor = "\n  - {name: bed, elements: 31-60, property: ky, factor: true, sd: 8 %}" if bed else ""
    rng = np.random.default_rng(2)
    shapes = shapes[[n - 2 for n in SENSORS]] / np.abs(shapes).max(axis=0)
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    hz = hz * (1 + 1e-3 * rng.standard_normal(MODES))
    rows = "\n".join(f"      - [{', '.join(f'{value:.4f}' for value in row)}]" for row in shapes)
    deck = f"""mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: 31, start: [0, 0], end: [{LENGTH}, 0]}}}}
    elements:
      - {{id: 1-30, type: beam, nodes: 1-31, E: 2.1e11, nu: 0.3, density: 7850, A: 4.0e-4, Iz: 1.0e-8}}{under}
    supports: {{1: all, 31: all}}
    plane: XY
parameters:
  - {{name: E, elements: 1-30, property: E, sd: 3 %}}{factor}
test:
  modes:
    frequency: [{", ".join(f"{value:.6f}" for value in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(f"{n}TY" for n in SENSORS)}]
    shapes:
{rows}
    shape_sd: 1 %
"""
    return assemble(yaml_deck.read(deck, "beam.yaml"))


def diagnosed(hz: np.ndarray, shapes: np.ndarray):
    """What mouse says of it."""
    return diagnose(clamped(hz, shapes))


@pytest.mark.parametrize(("first", "last"), proofs([(0.0, 0.45), (0.6, 1.0)], (0.6, 1.0)))
def test_a_bed_under_a_part_is_named_with_its_extent(first, last):
    found = diagnosed(*measured(BED, first, last))
    assert (found.kind, found.best.group) == (NAMED, "foundation")
    stiffness, covered = found.best.causes[0].sizes
    assert f"end at element {1 if first == 0 else 30}" in found.best.causes[0].site.text
    assert abs(covered.value - (last - first)) < 0.04
    assert abs(stiffness.value - BED) < 3 * stiffness.sd
    ids = np.array(found.best.causes[0].site.ids)
    assert abs((ids.min() - 1) / 30 - first) < 0.07 and abs(ids.max() / 30 - last) < 0.07  # none that has no bed


@pytest.mark.parametrize(("first", "last"), proofs([(0.3, 0.65), (0.15, 0.4)], (0.3, 0.65)))
def test_a_bed_between_two_places_is_named_with_both(first, last):
    found = diagnosed(*measured(BED, first, last))
    assert (found.kind, found.best.group) == (NAMED, "foundation")
    stiffness, covered, before = found.best.causes[0].sizes
    assert abs(covered.value - (last - first)) < 0.04
    assert abs(before.value * (1 - covered.value) - first) < 0.02
    assert abs(found.best.causes[0].site.position[0] / LENGTH - (first + last) / 2) < 0.02
    assert abs(stiffness.value - BED) < 3 * stiffness.sd
    assert found.extended_result.status.key == "converged" and not found.extended_result.rejected


@pytest.mark.parametrize(("first", "last"), proofs([(0.55, 0.85), (0.0, 0.3)], (0.55, 0.85)))
def test_a_bed_that_is_lost_in_part_is_named_with_its_extent(first, last):
    """A void, a free span: it was a change without a name."""
    found = diagnose(clamped(*measured(BED, first, last, lost=True), BED))
    assert (found.kind, found.best.group) == (NAMED, "void")
    lost, covered, *_ = found.best.causes[0].sizes
    assert lost.value > 0.8 and abs(covered.value - (last - first)) < 0.05
    assert abs(found.best.causes[0].site.position[0] / LENGTH - (first + last) / 2) < 0.03
    assert found.extended_result.status.key == "converged" and not found.extended_result.rejected


@pytest.mark.proof
def test_a_bed_under_all_stays_under_all():
    """Neither an end nor two places where it would begin are asked for."""
    found = diagnosed(*measured(BED, 0.0, 1.0))
    assert (found.kind, found.best.group, len(found.best.causes[0].sizes)) == (NAMED, "foundation", 1)


@pytest.mark.proof
def test_mass_between_two_places_is_named_with_both():
    found = diagnosed(*measured(0.0, 0.25, 0.55, 0.3 * MASS))
    assert (found.kind, found.best.group) == (NAMED, "added-mass")
    mass, covered, _ = found.best.causes[0].sizes
    assert abs(covered.value - 0.3) < 0.04
    assert abs(found.best.causes[0].site.position[0] / LENGTH - 0.4) < 0.02
    assert abs(mass.value - 0.3 * MASS) < 3 * mass.sd


def test_mass_on_the_shortest_piece_is_a_lumped_one():
    """On 5 % of a row it is no farther from its middle than sensors see, and at the limit of its range."""
    problem = clamped(*measured(0.0, 0.25, 0.55, 0.3 * MASS))
    made = added_mass.recipes(reduced(problem, problem.prior.mean), added_mass.CANDIDATE)
    recipe = next(each for each in made if len(each.unknowns) == 2)
    groups = [recipe.group(recipe.coordinates(np.array([1.0, covered]))) for covered in (0.05, 0.3)]
    assert groups == ["mass", "added-mass"]
