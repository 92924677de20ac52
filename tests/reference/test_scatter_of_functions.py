"""Functions that scatter more than their deck states: noise is unlike from line to line, what physics leaves is not."""

from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.frf.correlated import scatter

LINES, OUTPUTS = 200, 5


def fitted(whitened: np.ndarray) -> SimpleNamespace:
    """A fit that leaves these complex residuals (f, o, 1) of functions."""
    residual = np.concatenate([whitened.real.ravel(), whitened.imag.ravel()])
    block = SimpleNamespace(has=np.ones(whitened.shape, bool))
    base = SimpleNamespace(data=SimpleNamespace(blocks=(block,)))
    point = SimpleNamespace(residual=residual)
    return SimpleNamespace(misfit=float(residual @ residual), dof=len(residual), point=point, model=SimpleNamespace(base=base))


def noise(sd: float) -> np.ndarray:
    real, imaginary = np.random.default_rng(5).standard_normal((2, LINES, OUTPUTS, 1))
    return sd * (real + 1j * imaginary)


def resonance() -> np.ndarray:
    """What a shifted resonance leaves, a dozen lines broad, of unit mean square of real and imaginary part."""
    peak = 1 / (np.arange(LINES) - 80 + 6j)[:, None, None] * np.ones((1, OUTPUTS, 1))
    return peak * np.sqrt(2 / np.mean(np.abs(peak) ** 2))


@pytest.mark.parametrize("sd", [1.1, 1.35, 1.8])
def test_noise_that_is_understated_is_taken_for_the_accuracy(sd):
    assert scatter(fitted(noise(sd))) == pytest.approx(sd**2, rel=0.05)


@pytest.mark.parametrize("left", [0.5, 0.8, 1.2])
def test_what_is_alike_at_neighbouring_lines_is_none(left):
    assert scatter(fitted(noise(1.0) + left * resonance())) == 1.0


def test_neither_is_what_no_test_is_wrong_by_nor_what_is_there():
    assert scatter(fitted(noise(2.5))) == 1.0
    assert scatter(fitted(noise(0.8))) == 1.0
