"""What acts beside a support that turns, against beams of Hermite elements assembled here: it moves the bars too."""

import numpy as np
import pytest
from hermite_beams import COARSE, EI, LENGTH, MASS, Truth, deck
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.diagnosis.sites.points import directions
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

K_FOOT, K_HINGE = 4 * EI / LENGTH, 6 * EI / LENGTH  # N m/rad


def beam(hinge: int | None) -> np.ndarray:
    """Hz (5,) of a cantilever on a turning foot, with a hinge at that node."""
    return np.sqrt(solved(hinge)[0]) / (2 * np.pi)


def solved(hinge: int | None) -> tuple[np.ndarray, np.ndarray]:
    """Its eigenvalues (5,) and deflections (COARSE, 5) of the nodes that are free."""
    l, n = LENGTH / COARSE, COARSE
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = MASS * l / 420 * unit * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * n + 3, 2 * n + 3))
    for e in range(n):
        own = np.array([2 * e, 2 * e + 1, 2 * e + 2, 2 * e + 3])
        if e == hinge:
            own[1] = 2 * n + 2  # the turn beyond the hinge
        K[np.ix_(own, own)] += k
        M[np.ix_(own, own)] += m
    K[1, 1] += K_FOOT
    if hinge is None:
        free = np.arange(1, 2 * n + 2)
    else:
        free, b = np.arange(1, 2 * n + 3), np.zeros(2 * n + 3)
        b[2 * hinge + 1], b[2 * n + 2] = -1.0, 1.0
        K += K_HINGE * np.outer(b, b)
    lam, X = eigh(K[np.ix_(free, free)], M[np.ix_(free, free)], subset_by_index=[0, 4])
    return lam, X[1 : 2 * n + 1 : 2]


@pytest.fixture(scope="module")
def study():
    problem = assemble(yaml_deck.read(deck(Truth(), modes=6, held=1), "beam.yaml"))
    return Study(reduced(problem, problem.prior.mean))


def predicted(study: Study, name: str, values: tuple[float, ...], number: int = 0) -> np.ndarray:
    """Hz (5,) of the model with a turning foot and `name`."""
    foot, other = study.recipes("support-rotation")[0], study.recipes(name)[number]
    model = study.kind(study.model, (foot, other))
    x = [np.zeros(study.k), foot.coordinates(np.array([K_FOOT])), other.coordinates(np.array(values))]
    return np.sqrt(model.point(np.concatenate(x)).eigenvalues[:5]) / (2 * np.pi)


@pytest.mark.parametrize("node", [1, 12, 25])
def test_a_hinge(study, node):
    """Its own bar is the one on the foot, or another: its strain is that of the coordinates and of the foot's motion."""
    found = predicted(study, "joint", (K_HINGE, node * LENGTH / COARSE))
    assert found == pytest.approx(beam(node), rel=2e-5)
    assert np.abs(beam(node) / beam(None) - 1).max() > 0.003


def test_shapes_that_were_not_measured(study):
    """What further sensors would read: the foot turns, and the beam with it."""
    foot = study.recipes("support-rotation")[0]
    model = study.kind(study.model, (foot,))
    X = model.point(np.concatenate([np.zeros(study.k), foot.coordinates(np.array([K_FOOT]))])).X
    line = next(point for point in directions(study.model) if point.unknown)
    rows = [line.motion(np.array([(i + 1) * LENGTH / COARSE]))[0] for i in range(COARSE)]
    found, shapes = np.array(rows) @ model.moved(X)[:, :3], solved(None)[1][:, :3]
    found *= np.sign(np.sum(found * shapes, axis=0))
    np.testing.assert_allclose(found, shapes, atol=2e-4 * np.abs(shapes).max())
