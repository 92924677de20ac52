"""Tests of sound structures, solved here by `eigh`: what their update rejects, a diagnosis need not."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli import diagnose, read_deck
from mouse_cli.model.diagnosis import NOTHING, UNKNOWN, Choices

N = 4
SENSORS = list(range(1, 2 * N + 1))


def chain(k: np.ndarray) -> np.ndarray:
    """K (N, N) of springs k (N,) from each mass to the one before, the first to the ground."""
    B = np.eye(N) - np.eye(N, k=-1)
    return B.T @ (k[:, None] * B)


def tower(folder, ratio: float, coupling: float, noise: float, seed: int):
    """The deck of a chain that sways in two directions, the second `ratio` times as stiff; its test is of one in which a share of
    the stiffness couples them, and errs by `noise` times what is stated.
    """
    rng, each = np.random.default_rng(seed), np.diag([1.0, ratio])
    K, M = np.kron(each, chain(np.full(N, 1e5))), 10 * np.eye(2 * N)
    rates, X = eigh(K + coupling * np.kron([[0, 1], [1, 0]], chain(np.full(N, 1e5))), M)
    hz = np.sqrt(rates) / (2 * np.pi) * (1 + 0.002 * noise * rng.standard_normal(2 * N))
    X = X / np.abs(X).max(axis=0) + 0.005 * noise * rng.standard_normal(X.shape)
    order = np.argsort(hz)
    terms = [
        [[i + 1, j + 1, float(k)] for (i, j), k in np.ndenumerate(1e5 * np.kron(each, chain(one))) if k and i <= j]
        for one in np.eye(N)
    ]
    springs = "".join(f"  - {{name: k{i}, nominal: 1, sd: 5 %, stiffness: {own}}}\n" for i, own in enumerate(terms, 1))
    (folder / "tower.yaml").write_text(
        f"mouse: 1\nmodel:\n  stiffness: {{dense: {K.tolist()}}}\n  mass: {{dense: {M.tolist()}}}\nparameters:\n{springs}"
        f"test:\n  modes:\n    frequency: {hz[order].tolist()}\n    frequency_sd: 0.2 %\n    dofs: {SENSORS}\n"
        f"    shapes: {X[:, order].tolist()}\n    shape_sd: 0.005\n"
    )
    return read_deck(folder / "tower.yaml")


@pytest.mark.parametrize("seed", range(3))
def test_close_modes_that_turn_by_less_than_theory_errs_lack_nothing(tmp_path, seed):
    """An extended tower, diagnosed again: springs 0.4 % apart, a thousandth of them turns the modes; the update rejects it."""
    found = diagnose(tower(tmp_path, 1.004, 1e-3, 1.0, seed))
    assert found.result.rejected
    assert found.kind == NOTHING and dict(found.groups)["none"] > 0.5


def test_noise_that_is_somewhat_more_than_stated_is_no_missing_physics(tmp_path):
    """1.4 times the stated errors: nothing is missing, or the scatter of the test is what is found."""
    few = Choices(candidates=("mass", "ground-spring"))
    found = [diagnose(tower(tmp_path, 1.3, 0.0, 1.4, seed), choices=few) for seed in range(4)]
    assert {(each.kind, each.misstated) for each in found} == {(NOTHING, None), (UNKNOWN, "scatter")}
