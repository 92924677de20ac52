"""Predicted separation of two explanations, against dense eigensolutions of both models by scipy."""

import numpy as np
import pytest
from scipy.linalg import eigh
from test_locate import chain, measured, problem

from mouse_cli.diagnosis.altered import Model
from mouse_cli.diagnosis.candidates import registry
from mouse_cli.diagnosis.fit import fit
from mouse_cli.diagnosis.next_measurement import measurements, proposals, separated
from mouse_cli.diagnosis.reduced import reduced

HELD = 4e4  # N/m, of the spring to the ground that the model lacks


@pytest.fixture(scope="module")
def rivals():
    """A spring to the ground at degree of freedom 3, and a mass there, each fitted to two modes that the spring has made."""
    K, M = chain(), np.eye(4)
    deck = problem(K, M, measured(K + HELD * np.outer(np.eye(4)[2], np.eye(4)[2]), M, [0, 3], 2, noise=0.05), sd=0.3)
    base, found = reduced(deck, deck.prior.mean), []
    for name in ("ground-spring", "mass"):
        recipe = registry()[name].recipes(base, registry()[name])[2]
        found.append(
            fit(Model(base, (recipe,)), recipe.coordinates(np.array([3e4 if name == "ground-spring" else 0.2])))
        )
    return found


def predicted(one, spring: bool, numbers, K_added=0.0, M_added=0.0):
    """ln f of modes `numbers` and J C J', by differences: x = [(factor - 1) / sd, ln size]."""

    def log_hz(x):
        at = np.outer(np.eye(4)[2], np.eye(4)[2]) * np.exp(x[1])
        K, M = (1 + 0.3 * x[0]) * chain() + spring * at + K_added, np.eye(4) + (not spring) * at + M_added
        return 0.5 * np.log(eigh(K, M, eigvals_only=True)[numbers])

    x, step = one.point.x, 1e-5
    J = np.array([(log_hz(x + step * e) - log_hz(x - step * e)) / (2 * step) for e in np.eye(2)]).T
    return log_hz(x), J @ one.covariance @ J.T


def separation(rivals, sd, *how):
    (h, one), (g, other) = (predicted(each, spring, *how) for each, spring in zip(rivals, (True, False), strict=True))
    return 0.5 * (h - g) @ np.linalg.solve(sd**2 * np.eye(len(h)) + one + other, h - g)


def test_every_kind_of_measurement(rivals):
    """Modes, masses and springs at degrees of freedom 1 to 4 in turn: their separations are those of dense models."""
    every = list(measurements(rivals[0]))
    assert {each.kind for each in every} == {"modes", "mass", "support", "sensor"}
    for each in every:
        ours = separated(*rivals, each)
        if each.kind == "sensor":
            continue
        if each.kind == "modes":
            count = 1 if "frequency" in each.text else int(each.text.split()[-1]) - 2
            if count > 2:
                assert np.isnan(ours)  # the chain has no fifth mode
                continue
            theirs = separation(rivals, each.sd, np.arange(2, 2 + count))
        else:
            at = int(each.text.split("degree of freedom ")[1].split()[0]) - 1
            size = np.outer(np.eye(4)[at], np.eye(4)[at])
            added = 0.05 * 4 * size if each.kind == "mass" else float(each.text.split()[-2]) * size
            how = (0.0, added) if each.kind == "mass" else (added, 0.0)
            theirs = separation(rivals, each.sd, np.arange(2), *how)
        assert ours == pytest.approx(theirs, rel=0.1), (
            each.text
        )  # J is a difference over 0.01 sd, N/m are printed to 3 digits


def test_the_best_of_each_kind_is_proposed(rivals):
    found = proposals(*rivals, ("ground-spring", "mass"))
    every = [(each.kind, separated(*rivals, each)) for each in measurements(rivals[0])]
    best = {kind: np.nanmax([value for other, value in every if other == kind]) for kind, _ in every}
    assert [p.separation for p in found] == pytest.approx(sorted(best.values(), reverse=True))
    assert all(np.isfinite(p.separation) for p in found)
