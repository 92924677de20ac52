"""Two modes in one bandwidth, closed forms with noise by numpy: told apart, or at least doubted; sound modes are not."""

import numpy as np
import pytest

from mouse_cli.model.frf_test import FrfTest
from mouse_cli.records.identify import identify_frf

HZ = np.arange(5.0, 30.0, 0.05)
ZETA, FIRST = 0.01, 15.0  # bandwidth 0.3 Hz, six lines
SHAPES = np.array([[1, 0.8, 0.3, 0.5], [0.7, -0.2, 0.9, -0.6], [0.4, 0.7, -0.6, 0.6], [0.2, -0.9, 0.4, 0.3]])


def identified(gap: float, forces: list[int], seed: int, stated: bool = True):
    """Modes at 10, 15 and 22 Hz, and one `gap` bandwidths above the second; errors of 10 % of the root mean square."""
    omega, w = 2 * np.pi * np.array([10.0, FIRST, FIRST + gap * 2 * ZETA * FIRST, 22.0]), 2 * np.pi * HZ[:, None]
    own = -(w**2) / (omega**2 - w**2 + 2j * ZETA * omega * w)
    H = np.einsum("or,ir,fr->foi", SHAPES, SHAPES[forces], own if gap else own * [1, 1, 0, 1])
    sd, random = 0.1 * np.sqrt((np.abs(H) ** 2).mean(axis=0)), np.random.default_rng(seed)
    H = H + sd * (random.standard_normal(H.shape) + 1j * random.standard_normal(H.shape)) / np.sqrt(2)
    variance = np.broadcast_to(sd**2 if stated else np.nan, H.shape)
    names = tuple("1234"[i] for i in forces)
    return identify_frf([FrfTest(HZ, H, "accelerance", np.arange(4), np.array(forces), variance, tuple("1234"), names)])


def doubted(found) -> list[str]:
    return [d.message for d in found.doubts if d.code == "MD681"]


@pytest.mark.parametrize("gap", [0.1, 0.2, 0.3])
def test_one_force_leaves_a_doubt_and_two_tell_them_apart(gap):
    found = identified(gap, [0], 3)
    assert found.modes.m == 4 or (doubted(found) and found.exit_code == 1)
    assert all("near the mode at 14.99" in message for message in doubted(found))
    both = identified(gap, [0, 2], 3)
    assert both.modes.m == 4 and not doubted(both)
    assert both.modes.frequency_hz[2] - both.modes.frequency_hz[1] == pytest.approx(0.3 * gap, rel=0.15)


@pytest.mark.parametrize("stated", [True, False])
@pytest.mark.parametrize("forces", [[0], [0, 2]])
def test_sound_modes_are_not_doubted(stated, forces):
    for seed in range(10):
        found = identified(0.0, forces, seed, stated)
        assert found.modes.m == 3 and not doubted(found)
