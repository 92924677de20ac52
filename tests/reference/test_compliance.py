"""A motion that the model does not let the structure make: soil that rocks, whose flexibility adds to that of a chain."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import COMPLIANCE, UNKNOWN, Choices

K = np.array([52.0, 38.0, 61.0, 33.0, 47.0, 29.0, 41.0, 25.0]) * 1e6  # of each storey, N/m
M = np.array([4.1, 2.6, 3.9, 2.2, 3.4, 2.8, 3.7, 1.9]) * 1e3  # kg
HEIGHT = np.arange(1, 9) * 3.0  # m
NAMES = ("mass", "mass-loss", "ground-spring", "stiffness-loss", "stiffness-gain", "oscillator")


def chain(k: np.ndarray) -> np.ndarray:
    """Of storeys on the ground (n, n)."""
    return np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)


def deck(soil: float, seed: int = 3) -> str:
    """Five modes of the chain on soil of the rotational flexibility `soil` (rad/Nm), with noise; the model stands on rock."""
    rng = np.random.default_rng(seed)
    lam, X = eigh(np.linalg.inv(np.linalg.inv(chain(1.03 * K)) + soil * np.outer(HEIGHT, HEIGHT)), np.diag(M))
    hz, X = np.sqrt(lam[:5]) / 2 / np.pi, X[:, :5] / np.abs(X[:, :5]).max(axis=0)
    hz = hz * (1 + 1e-3 * rng.normal(size=5))
    X = X + 0.01 * rng.normal(size=X.shape)
    entries = [
        f"[{i + 1}, {j + 1}, {v:.17g}]" for i, row in enumerate(chain(K)) for j, v in enumerate(row) if j >= i and v
    ]
    listed = ", ".join(entries)
    return f"""mouse: 1
model:
  stiffness: {{order: 8, entries: [{listed}]}}
  mass: {{diagonal: {M.tolist()}}}
parameters:
  - {{name: springs, nominal: 1, sd: 5 %, transform: log, stiffness: [{listed}]}}
test:
  modes:
    dofs: [1, 2, 3, 4, 5, 6, 7, 8]
    frequency: {hz.tolist()}
    frequency_sd: 0.1 %
    shapes: {X.tolist()}
    shape_sd: 0.01
"""


def found_in(soil: float):
    return diagnose(assemble(yaml_deck.read(deck(soil), "chain.yaml")), choices=Choices(NAMES, causes=2))


def test_soil_that_rocks_is_a_compliance():
    """The motion that it adds is the rigid rotation; the deck with it is not rejected and predicts modes left out."""
    found = found_in(0.4 / (HEIGHT @ chain(K) @ HEIGHT))
    assert found.kind == UNKNOWN and found.field.property == COMPLIANCE
    motion = np.array([each.value for each in found.field.values])
    assert abs(motion @ HEIGHT) / np.linalg.norm(motion) / np.linalg.norm(HEIGHT) > 0.98
    held = found.field.held_out
    assert held.revised.rms_frequency_error < 0.5 * held.baseline.rms_frequency_error
    assert not found.extended_result.rejected


def test_a_function_beside_the_modes_agrees():
    """One receptance of the same chain, 2 % noise: rivals that have other spreads and lengths are judged by both."""
    soil, rng = 0.4 / (HEIGHT @ chain(K) @ HEIGHT), np.random.default_rng(1)
    lam, X = eigh(np.linalg.inv(np.linalg.inv(chain(1.03 * K)) + soil * np.outer(HEIGHT, HEIGHT)), np.diag(M))
    hz = np.linspace(3, 30, 80)
    H = (X[7] * X[3] / (lam * (1 + 0.04j) - (2 * np.pi * hz[:, None]) ** 2)).sum(axis=1)
    H = H * (1 + 0.02 * (rng.normal(size=80) + 1j * rng.normal(size=80)))
    value = ", ".join(f"{z.real:.6g}{z.imag:+.6g}j" for z in H)
    outputs = f"outputs: {{8: {{value: [{value}]}}}}, sd: 2 %"
    more = f"  frf:\n    - {{title: tap, unit: m/N, input: 4, frequency: {hz.tolist()}, {outputs}}}\n"
    found = diagnose(assemble(yaml_deck.read(deck(soil) + more, "chain.yaml")), choices=Choices(NAMES, causes=1))
    held = found.field.held_out
    assert (found.kind, found.field.property) == (UNKNOWN, COMPLIANCE)
    assert held.revised.rms_frequency_error < 0.5 * held.baseline.rms_frequency_error


def test_rock_is_none():
    """Without it no rival is asked for, and nothing is missing."""
    found = found_in(0.0)
    assert found.exit_code == 0 and found.field is None


@pytest.mark.parametrize("sign", [1, -1])
def test_a_change_of_rank_one_stays_positive_definite(sign):
    """Whatever the motion: of a spring K + b b', of a compliance K^-1 + h h'."""
    from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
    from mouse_cli.diagnosis.nameless.fit import _spreads

    problem = assemble(yaml_deck.read(deck(0.0), "chain.yaml"))
    model = reduced(problem, problem.prior.mean)
    (field,) = (each for each in _spreads(model) if each.rival.signs == (sign,))
    base = field.over(model, *field.grid[-1])
    z = np.full(base.L.shape[1], 3.0)
    changed, own = base.matrices(z)[0], model.matrices(z[: base.deck])[0]
    assert np.linalg.eigvalsh(changed)[0] > 0
    h = z[base.deck :] @ base.of_field
    more = np.outer(h, h)
    assert changed == pytest.approx(
        own + more if sign > 0 else np.linalg.inv(np.linalg.inv(own) + more), rel=1e-6, abs=1e-6 * own.max()
    )


STOREYS = """mouse: 1
model:
  structure:
    nodes: {nodes}
    elements:
      - {{id: 1-4, type: storey, nodes: 0-4, TX: [5.0e+7, 4.0e+7, 3.0e+7, 2.0e+7]}}
      - {{id: 11-14, type: mass, nodes: 1-4, mass: [4.0e+3, 3.0e+3, 3.0e+3, 2.0e+3]}}
    supports: {{0: all}}
    directions: {directions}
parameters:
  - {{name: storey, elements: 1-4, property: TX, factor: true, sd: 5 %}}
test:
  modes: {{frequency: [5.0, 13.0, 20.0], frequency_sd: 0.1 %}}
"""


@pytest.mark.parametrize(("directions", "even"), [("[TX]", "support"), ("[TX, TY]", "")])
def test_a_straight_motion_of_storeys_is_that_of_their_foundation(directions, even):
    """u = drift + phi h on a spring k against turning has K^-1 + h h' / k; storeys of unlike heights."""
    from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
    from mouse_cli.diagnosis.nameless.fit import _spreads
    from mouse_cli.model.arrays import dense

    high, turning = np.array([6.0, 9.0, 13.0, 16.0]), 2e9
    nodes = ", ".join(f"{i}: [0, 0, {z}]" for i, z in enumerate([0.0, *high]))
    problem = assemble(yaml_deck.read(STOREYS.format(nodes=f"{{{nodes}}}", directions=directions), "storeys.yaml"))
    model = reduced(problem, problem.prior.mean)
    (field,) = (each for each in _spreads(model) if each.rival.key == "compliance")
    bent, straight = (field.over(model, 1.0, share, -1) for share in (0.2, np.inf))
    assert (bent.nameless.rival.even, straight.nameless.rival.even) == ("", even)
    if even:
        motion = np.linalg.solve(model.V, high / np.sqrt(turning))
        w, left, *_ = np.linalg.lstsq(straight.of_field.T, motion, rcond=None)
        assert left[0] < 1e-18 * motion @ motion
        K = dense(model.assembly.matrices(model.theta)[0])
        on_soil = np.linalg.inv(np.linalg.inv(K) + np.outer(high, high) / turning)
        said = straight.matrices(np.append(model.z, w))[0]
        assert np.linalg.inv(model.V).T @ said @ np.linalg.inv(model.V) == pytest.approx(
            on_soil, rel=1e-6, abs=1e-6 * on_soil.max()
        )
