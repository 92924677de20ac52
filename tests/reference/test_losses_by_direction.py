"""A spring of two directions that is softer in one of them: masses in a row, whose K is written down and solved by `eigh` here."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis.diagnose import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.lowest import lowest
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import stiffness_loss
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import NAMED

N, STIFF = 4, (1.0e4, 3.1e4)  # masses of 1 kg; N/m along x and y of the spring before each
DECK = """\
mouse: 1
model:
  structure:
    nodes: {{1: [0, 0, 0], 2: [1, 0, 0], 3: [2, 0, 0], 4: [3, 0, 0]}}
    elements:
      - {{id: 1, type: spring, nodes: [1], stiffness: {{TX: 1.0e4, TY: 3.1e4}}}}
      - {{id: 2, type: spring, nodes: [1, 2], stiffness: {{TX: 1.0e4, TY: 3.1e4}}}}
      - {{id: 3, type: spring, nodes: [2, 3], stiffness: {{TX: 1.0e4, TY: 3.1e4}}}}
      - {{id: 4, type: spring, nodes: [3, 4], stiffness: {{TX: 1.0e4, TY: 3.1e4}}}}
      - {{id: 11-14, type: mass, nodes: [[1], [2], [3], [4]], mass: 1.0}}
    supports: {{1-4: [TZ, RX, RY, RZ]}}
parameters:
  - {{name: mass, elements: 11-14, property: mass, sd: 1 %}}
test:
  modes: {{frequency: {hz}, frequency_sd: 0.1 %, dofs: [{dofs}], shapes: {shapes}, shape_sd: 0.01}}
"""


def chain(springs: np.ndarray) -> np.ndarray:
    """K (n, n) of masses in a row, a spring before each."""
    stretch = np.eye(len(springs)) - np.eye(len(springs), k=-1)
    return stretch.T @ (springs[:, None] * stretch)


@pytest.mark.parametrize("weaker", [("TX",), ("TY",), ("TX", "TY")])
def test_the_direction_is_named(weaker, tmp_path):
    springs = [np.full(N, k) for k in STIFF]
    for name in weaker:
        springs[["TX", "TY"].index(name)][2] *= 0.5
    K = np.zeros((2 * N, 2 * N))
    K[:N, :N], K[N:, N:] = (chain(each) for each in springs)
    rates, X = eigh(K)
    random = np.random.default_rng(2)
    hz = np.sqrt(rates) / (2 * np.pi) * (1 + 1e-3 * random.standard_normal(2 * N))
    shapes = X / np.abs(X).max(axis=0) + 0.01 * random.standard_normal(X.shape)
    path = tmp_path / "deck.yaml"
    dofs = ", ".join(f"{n}{axis}" for axis in ("TX", "TY") for n in range(1, N + 1))
    path.write_text(DECK.format(hz=hz.tolist(), dofs=dofs, shapes=shapes.tolist()))
    found = diagnose(read_deck(path))
    assert found.kind == NAMED and found.groups[0][0] == "local-stiffness"
    cause = found.explanations[0].causes[0]
    assert cause.site.text == ("spring 3" if len(weaker) == 2 else f"spring 3, {weaker[0]}")
    assert found.extended.parameters[-1].nominal == pytest.approx(0.5, rel=0.1)


ROW = """\
mouse: 1
model:
  structure:
    nodes: {{line: {{from: 1, to: 40, start: [0, 0, 0], end: [39, 0, 0]}}}}
    elements:
      - {{id: 1-39, type: spring, nodes: 1-40, stiffness: {{TX: 1.0e4}}}}
      - {{id: 50, type: spring, nodes: [13], stiffness: {{TX: 3.0e6}}}}
      - {{id: 51-90, type: mass, nodes: {masses}, mass: 1.0}}
    supports: {{1-40: [TY, TZ, RX, RY, RZ]}}
parameters:
  - {{name: mass, elements: 51-90, property: mass, sd: 1 %}}
test:
  modes: {{frequency: [1, 2, 3], frequency_sd: 1 %, dofs: [1TX], shapes: [[1, 1, 1]], shape_sd: 0.1}}
"""


def test_a_first_look_knows_what_a_stiff_spring_holds(tmp_path):
    """A row of 40 masses, held in its 13th by a spring that is 300 times as stiff; 85 % of that lost, in 24 coordinates."""
    path = tmp_path / "deck.yaml"
    path.write_text(ROW.format(masses=[[n] for n in range(1, 41)]))
    problem = read_deck(path)
    model = lowest(reduced(problem, problem.prior.mean), 12)
    (recipe,) = (
        each for each in stiffness_loss.recipes(model, stiffness_loss.CANDIDATE) if "50" in each.site([0.5]).text
    )
    found = Model(model, (recipe,)).point(np.concatenate([np.zeros(1), recipe.coordinates(np.array([0.85]))]))
    K = chain(np.append(0.0, np.full(39, 1e4)))
    K[12, 12] += 0.15 * 3e6
    assert model.r < 26 and found.eigenvalues[:5] == pytest.approx(eigh(K, eigvals_only=True)[:5], rel=1e-3)
