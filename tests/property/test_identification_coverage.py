"""Stated intervals of identified modes hold the truth as often as they say: closed forms, noise by numpy, 200 draws each."""

import numpy as np
import pytest
import vibrating
from proofs import proofs

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.model.recording import OUTPUT, Channel, Recording
from mouse_cli.records.identify import identify_frf, identify_recordings

DRAWS = 200
NINETY = 1.6449  # standard deviations to either side
# 200 draws of three modes: sd of a share of 90 % is 1.2 points; neighbours are correlated, so twice that and more is allowed
LEAST, MOST = 0.85, 0.95
HZ = np.arange(4, 70, 0.25)
FOUND: dict[str, tuple[np.ndarray, int, int]] = {}


def frf_draw(seed: int, stated: bool):
    omega, zeta, shapes = vibrating.modes(0.02)
    H, variance = vibrating.disturbed(
        vibrating.accelerance(HZ, omega, zeta, shapes, [2]), 0.01, np.random.default_rng(seed)
    )
    variance = variance if stated else np.full(H.shape, np.nan)
    test = FrfTest(HZ, H, "accelerance", np.arange(3), np.array([2]), variance, ("1", "2", "3"), ("3",))
    return identify_frf([test])


def output_draw(seed: int, _: bool):
    samples = vibrating.responses(150.0, 20000, 0.02, 0.01, np.random.default_rng(seed))
    channels = tuple(Channel(str(k + 1), OUTPUT, "acceleration") for k in range(3))
    return identify_recordings([Recording("chain", 1 / 150.0, channels, samples)], (4.0, 70.0))


def scores(modes) -> np.ndarray:
    """Errors over stated sd: frequencies, dampings, shape components."""
    omega, zeta, shapes = vibrating.modes(0.02)
    if modes.scale[0] == "largest component 1":  # lengths are not measured: compared at the length of the estimate
        shapes = shapes * np.linalg.norm(modes.shapes.real, axis=0) / np.linalg.norm(shapes, axis=0)
    shapes = shapes * np.sign((shapes * modes.shapes.real).sum(axis=0))
    frequency = (modes.frequency_hz - omega / 2 / np.pi) / modes.frequency_sd_hz
    damping = (modes.damping - zeta) / modes.damping_sd
    return np.concatenate([frequency, damping, ((modes.shapes.real - shapes) / modes.shape_sd).ravel()])


def draws(kind: str) -> tuple[np.ndarray, int, int]:
    """Scores (draws, 15), how many modes were spurious, and how many missed, in all draws of a kind."""
    if kind not in FOUND:
        draw = output_draw if kind == "outputs" else frf_draw
        answers = [draw(seed, kind == "stated").modes for seed in range(DRAWS)]
        whole = [scores(modes) for modes in answers if modes.m == 3]
        FOUND[kind] = np.array(whole), sum(max(m.m - 3, 0) for m in answers), sum(max(3 - m.m, 0) for m in answers)
    return FOUND[kind]


@pytest.mark.parametrize("kind", proofs(["stated", "unstated", "outputs"]))
def test_ninety_per_cent_intervals_hold_the_truth(kind):
    found, spurious, missed = draws(kind)
    assert spurious == 0
    assert missed <= (2 if kind == "outputs" else 0)
    inside = np.abs(found) < NINETY
    for what, columns in (("frequency", slice(0, 3)), ("damping", slice(3, 6)), ("shape", slice(6, 15))):
        share = inside[:, columns].mean()
        assert LEAST <= share <= MOST, f"{what}: {share:.3f}"
