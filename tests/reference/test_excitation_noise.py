"""Noise of a force channel is passed on to what simulations predict: against its covariance by definition, and on records
that scipy integrated, whose force was then falsified.
"""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import sqrtm
from test_channel_nuisances import K3, answer, cubic
from two_masses import linear, record

import mouse_cli
from mouse_cli.updating.recordings.excitation_noise import Repeated
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import fitted, study


def noisy(x: np.ndarray, share: float = 0.02) -> np.ndarray:
    """A force channel with white noise."""
    return x + share * x.std() * np.random.default_rng(5).standard_normal(len(x))


def test_stretches_are_made_white_by_the_covariance_of_what_the_excitation_passes_on():
    t = np.arange(60) * 0.02
    pulses = np.stack([np.exp(-0.5 * t) * np.sin(9 * t), 0.7 * np.exp(-0.5 * t) * np.cos(9 * t)], axis=1)[:, :, None]
    G = np.zeros((2, 60, 60))
    for j in range(60):
        G[:, j:, j] = pulses[: 60 - j, :, 0].T
    G = G.reshape(120, 60)
    exact = np.linalg.inv(sqrtm(np.eye(120) + G @ G.T).real)
    x = np.random.default_rng(1).standard_normal((3, 2, 60, 4))
    own = Repeated(pulses)
    found = own.whitened(x)
    assert np.abs(found - (exact @ x.reshape(3, 120, 4)).reshape(x.shape)).max() < 0.1  # shares below 5 % are left out
    assert np.abs(own.whitened(found, 0.5) - x).max() < 1e-9


@pytest.mark.parametrize("stated", ["", ", noise_sd: 2 %"])
def test_two_percent_of_noise_in_the_force_is_neither_physics_nor_strain(tmp_path, stated):
    deck = Path(record(tmp_path, linear))
    kept = dict(np.load(tmp_path / "run.npz"))
    np.savez(tmp_path / "run.npz", **kept | {"f": noisy(kept["f"])})
    deck.write_text(deck.read_text().replace("quantity: force", f"quantity: force{stated}"))
    problem = mouse_cli.read_deck(str(deck))
    own = study(problem, records(problem))
    one = fitted(own, None)
    assert 0.85 < one.misfit / one.dof < 1.1
    assert np.abs(one.x).max() < 3.5


def test_a_law_is_named_beside_noise_in_the_force(tmp_path):
    found = answer(tmp_path, cubic, "mains: 200", f=noisy)
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "cubic")
    assert found["candidates"][0]["parameters"][0]["value"] == pytest.approx(K3, rel=0.03)


def test_an_excitation_as_wide_as_its_samples_shows_no_noise(tmp_path):
    deck = record(tmp_path, linear)
    kept = dict(np.load(tmp_path / "run.npz"))
    np.savez(tmp_path / "run.npz", **kept | {"f": np.random.default_rng(3).standard_normal(len(kept["f"]))})
    assert not records(mouse_cli.read_deck(deck)).fitted[0].force_noise.any()
