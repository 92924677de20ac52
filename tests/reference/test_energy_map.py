"""The map of energy against closed forms: in a statically determinate structure all of it lies in the spring that gave way."""

import numpy as np
import pytest
from test_locate import cantilever, chain, measured, problem

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.localise.energy_map import energy_map
from mouse_cli.diagnosis.search.fit import fit


def mapped(K, M, test):
    """The map of a model without parameters."""
    deck = problem(K, M, test)
    return energy_map(fit(Model(reduced(deck, deck.prior.mean)), np.zeros(0)))


def dense(K, M, test, at):
    """sum of p p' / u'Ku (n, n), and p'Kp / u'Ku of each mode: p'Kp + |W (y - S u)|^2 / alpha, minimised over u as one
    least-squares problem, with the misfit that the data let expect."""
    n, s = len(K), len(at)
    root, whole, errors = np.linalg.cholesky(np.linalg.inv(K)).T, np.zeros((n, n)), []
    for i in range(test.m):
        y, sd = test.shapes[:, i], np.hypot(test.shape_sd[:, i], 2e-3 * np.abs(test.shapes[:, i]).max())
        Z, W = K - (2 * np.pi * test.frequency_hz[i]) ** 2 * M, np.eye(n)[at] / sd[:, None]
        low, high = -6.0, 12.0
        for _ in range(80):
            power = 10 ** ((low + high) / 2)
            u = np.linalg.lstsq(np.vstack([root @ Z, power * W]), np.concatenate([np.zeros(n), power * y / sd]))[0]
            missed = np.sum((y / sd - W @ u) ** 2) > s
            low, high = ((low + high) / 2, high) if missed else (low, (low + high) / 2)
        p = np.linalg.solve(K, Z @ u)
        errors.append(p @ K @ p / (u @ K @ u))
        whole += np.outer(p, p) / (u @ K @ u)
    return whole, np.array(errors)


@pytest.mark.parametrize("soft", range(4))
def test_all_energy_is_in_the_spring_that_gave_way(soft):
    """K p = -dk b b'u, and the chain is determinate: p stretches spring b alone; what is missed is the allowance for theory."""
    K, M = chain(), np.eye(4)
    b = np.eye(4)[soft] - (np.eye(4)[soft - 1] if soft else 0)
    found = mapped(K, M, measured(K - 40e3 * np.outer(b, b), M, [0, 1, 2, 3], 3))
    ends = (str(soft), str(soft + 1)) if soft else ("1",)
    by = {site.ids: share for site, share in zip(found.sites, found.share, strict=True)}
    assert len(by) == 4
    assert by[ends] == pytest.approx(1, abs=0.01)
    assert found.half == 1


def test_springs_against_a_dense_minimum():
    K, M, at = chain(), np.diag([1.0, 2.0, 1.0, 0.5]), [0, 2, 3]
    test = measured(K + 4e4 * np.outer(np.eye(4)[1], np.eye(4)[1]), M, at, 2, noise=0.01, seed=3)
    found, (whole, errors) = mapped(K, M, test), dense(K, M, test, at)
    assert found.error == pytest.approx(errors, rel=1e-4)
    work = [-K[i, i + 1] * (whole[i, i] + whole[i + 1, i + 1] - 2 * whole[i, i + 1]) for i in range(3)]
    expected = np.array([*work, K.sum(axis=1)[0] * whole[0, 0]]) / errors.sum()
    assert found.share == pytest.approx(expected, abs=1e-4)


def test_nodes_against_a_dense_minimum():
    """A beam of two elements, the first one softer: its matrices are no springs."""
    K, M = cantilever(2)
    soft = K.copy()
    soft[:2, :2] -= 0.2 * cantilever(1)[0] * np.array([[8, 4], [4, 2]])
    test = measured(soft, M, [0, 1, 2, 3], 2)
    found, (whole, errors) = mapped(K, M, test), dense(K, M, test, [0, 1, 2, 3])
    work = np.abs(np.diag(whole @ K))
    assert found.error == pytest.approx(errors, rel=1e-4)
    assert found.share == pytest.approx(work / work.sum(), abs=1e-4)


def test_what_is_noise_has_no_energy():
    """Shapes that are no larger than their errors say nothing."""
    K, M = chain(), np.eye(4)
    assert mapped(K, M, measured(K, M, [0, 1, 2, 3], 2, noise=1.0)) is None
