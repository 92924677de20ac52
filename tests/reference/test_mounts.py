"""A mount of several springs that is softer as a whole; truth by the eigenvalues of two matrices of order two."""

import numpy as np
import pytest
from scipy.linalg import eigh

import mouse_cli
from mouse_cli.diagnosis.effects.losses import of_elements
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

M, MOUNT, LINK, LOST = (30.0, 50.0), ((3e5, 2e5), (4e5, 6e5)), (5e5, 1.5e5), 0.6  # kg; N/m along X and Y of each mount


def modes(left: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (4,) in Hz and shapes (4, 4) at 1TX, 2TX, 1TY, 2TY of two masses on mounts, shares `left` of them there."""
    hz, shapes = [], np.zeros((4, 4))
    for d in (0, 1):
        ground = np.array([share * mount[d] for share, mount in zip(left, MOUNT, strict=True)])
        K = np.diag(ground) + LINK[d] * np.array([[1.0, -1.0], [-1.0, 1.0]])
        rates, u = eigh(K, np.diag(M))
        hz.append(np.sqrt(rates) / (2 * np.pi))
        shapes[2 * d : 2 * d + 2, 2 * d : 2 * d + 2] = u / np.abs(u).max(axis=0)
    order = np.argsort(np.concatenate(hz))
    return np.concatenate(hz)[order], shapes[:, order]


def deck(left: tuple[float, float], noise: float = 1.0) -> str:
    rng = np.random.default_rng(11)
    hz, shapes = modes(left)
    hz = hz * (1 + 0.001 * noise * rng.standard_normal(4))
    shapes = shapes + 0.01 * noise * rng.standard_normal((4, 4))
    rows = "\n".join(f"      - [{', '.join(f'{x:.5f}' for x in row)}]" for row in shapes)
    (a, b), (c, d) = MOUNT
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0], 2: [1, 0]}}
    elements:
      - {{id: 1, type: spring, nodes: [1], TX: {a}}}
      - {{id: 2, type: spring, nodes: [1], TY: {b}}}
      - {{id: 3, type: spring, nodes: [2], TX: {c}}}
      - {{id: 4, type: spring, nodes: [2], TY: {d}}}
      - {{id: 5, type: spring, nodes: [1, 2], TX: {LINK[0]}, TY: {LINK[1]}}}
      - {{id: 6-7, type: mass, nodes: [1, 2], mass: [{M[0]}, {M[1]}]}}
    directions: [TX, TY]
parameters:
  - {{name: masses, elements: 6-7, property: mass, factor: true, sd: 1 %, transform: log}}
test:
  modes:
    frequency: [{", ".join(f"{x:.7g}" for x in hz)}]
    frequency_sd: 0.1 %
    dofs: [1TX, 2TX, 1TY, 2TY]
    shapes:
{rows}
    shape_sd: 1 %
"""


def test_a_mount_of_two_springs_that_is_softer_is_named(tmp_path):
    path = tmp_path / "mounts.yaml"
    path.write_text(deck((1 - LOST, 1.0)))
    found = mouse_cli.diagnose(mouse_cli.read_deck(str(path)))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.text) == ("named", "stiffness-loss", "springs 1 to 2, alike")
    (size,) = cause.sizes
    assert size.value == pytest.approx(LOST, abs=3 * size.sd)


@pytest.mark.parametrize(
    ("text", "left"), [("springs 1 to 2, alike", (1 - LOST, 1.0)), ("springs 3 to 4, alike", (1.0, 1 - LOST))]
)
def test_the_deck_with_a_softer_mount_has_the_modes_of_the_truth(text, left):
    """Springs at one node act along axes of their own: one factor, of which each is a part."""
    problem = assemble(yaml_deck.read(deck((1.0, 1.0)), "mounts.yaml"))
    model = reduced(problem, problem.prior.mean)
    recipes = of_elements(model, registry()["stiffness-loss"], directed=True)
    (recipe,) = [each for each in recipes if each.site(each.grid[0]).text == text]
    values = np.array([LOST])
    extended = reduced(there := recipe.extend(problem, values), there.prior.mean)
    assert np.sqrt(extended.eigenvalues) / (2 * np.pi) == pytest.approx(modes(left)[0], rel=1e-9)
    rates = eigh(np.diag(model.eigenvalues) + recipe.change(values).K, eigvals_only=True)
    assert np.sqrt(rates) / (2 * np.pi) == pytest.approx(modes(left)[0], rel=1e-9)


def test_springs_are_alike_by_mount_by_direction_and_all():
    problem = assemble(yaml_deck.read(deck((1.0, 1.0)), "mounts.yaml"))
    recipes = of_elements(reduced(problem, problem.prior.mean), registry()["stiffness-loss"], directed=True)
    found = {text for each in recipes if (text := each.site(each.grid[0]).text).endswith("alike")}
    assert found == {f"springs {own}, alike" for own in ("1 to 2", "3 to 4", "1, 3", "2, 4", "1 to 5")}
