"""A mass on a slender branch, of several, of a model of matrices of 570 degrees of freedom: it has modes that no force makes."""

import json
from itertools import pairwise

import numpy as np
from click.testing import CliRunner
from scipy.io import mmwrite
from scipy.linalg import eigh
from scipy.sparse import coo_array

from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.localise.heavier import heavier
from mouse_cli.formats import read_deck

E, DENSITY = 7e10, 2700.0
STEM, WHIP = (0.04, 160), (0.008, 6)  # side of the square section in m, and elements of 0.05 m
LENGTH, ROOTS, LADEN = 0.05, (15, 45, 75, 105, 135), 182  # nodes from 0: whips stand on the stem, one with the mass on LADEN


def frame() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes (k, 2), K and M (3 k, 3 k) of plane beams by TX, TY, RZ, the foot of the stem free."""
    at = [(LENGTH * i, 0.0) for i in range(STEM[1] + 1)]
    bars = [(i, i + 1, STEM[0]) for i in range(STEM[1])]
    for root in ROOTS:
        tail = [root, *range(len(at), len(at) + WHIP[1])]
        at += [(LENGTH * root, LENGTH * (i + 1)) for i in range(WHIP[1])]
        bars += [(i, j, WHIP[0]) for i, j in pairwise(tail)]
    at = np.array(at)
    K, M = np.zeros((2, 3 * len(at), 3 * len(at)))
    for i, j, side in bars:
        rows = np.r_[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
        c, s = (at[j] - at[i]) / LENGTH
        R = np.kron(np.eye(2), np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
        for whole, own in zip((K, M), bar(side), strict=True):
            whole[np.ix_(rows, rows)] += R.T @ own @ R
    return at, K, M


def bar(side: float) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and consistent mass (6, 6) of an Euler-Bernoulli beam."""
    A, EI, l = side**2, E * side**4 / 12, LENGTH
    K, M = np.zeros((2, 6, 6))
    K[np.ix_([0, 3], [0, 3])] = E * A / l * np.array([[1, -1], [-1, 1]])
    M[np.ix_([0, 3], [0, 3])] = DENSITY * A * l / 6 * np.array([[2, 1], [1, 2]])
    own = np.ix_([1, 2, 4, 5], [1, 2, 4, 5])
    K[own] = EI / l**3 * np.array(
        [
            [12, 6 * l, -12, 6 * l],
            [6 * l, 4 * l**2, -6 * l, 2 * l**2],
            [-12, -6 * l, 12, -6 * l],
            [6 * l, 2 * l**2, -6 * l, 4 * l**2],
        ]
    )
    M[own] = DENSITY * A * l / 420 * np.array(
        [
            [156, 22 * l, 54, -13 * l],
            [22 * l, 4 * l**2, 13 * l, -3 * l**2],
            [54, 13 * l, 156, -22 * l],
            [-13 * l, -3 * l**2, -22 * l, 4 * l**2],
        ]
    )
    return K, M


def deck(folder, mass: float) -> str:
    """The model without the mass, and the first modes of the frame with it, clamped at its foot."""
    at, K, M = frame()
    heavy = M.copy()
    heavy[3 * LADEN, 3 * LADEN] += mass
    heavy[3 * LADEN + 1, 3 * LADEN + 1] += mass
    kept = np.arange(3, len(K))
    values, X = eigh(1.02 * K[np.ix_(kept, kept)], heavy[np.ix_(kept, kept)], subset_by_index=[0, 6])
    rng, whole = np.random.default_rng(4), np.zeros((len(K), 7))
    whole[kept] = X
    sensors = [(i, "TY") for i in range(16, STEM[1] + 1, 16)] + [(20, "TX"), (160, "TX")]
    seen = whole[[3 * i + ("TX", "TY").index(d) for i, d in sensors]]
    seen = seen / np.abs(seen).max(axis=0) + 0.01 * rng.standard_normal(seen.shape)
    hz = np.sqrt(values) / (2 * np.pi) * (1 + 1e-3 * rng.standard_normal(7))
    for name, matrix in (("K", K), ("M", M)):
        mmwrite(folder / f"{name}.mtx", coo_array(np.tril(matrix)), symmetry="symmetric")
    labels = [f"{i + 1},{d}" for i in range(len(at)) for d in ("TX", "TY", "RZ")]
    (folder / "dofs.csv").write_text("node,direction\n" + "\n".join(labels) + "\n")
    rows = [f"{i + 1},{x:.6f},{y:.6f},0" for i, (x, y) in enumerate(at.tolist())]
    (folder / "nodes.csv").write_text("node,x,y,z\n" + "\n".join(rows) + "\n")
    shapes = "\n".join(f"      - [{', '.join(f'{v:.5f}' for v in row)}]" for row in seen)
    (folder / "deck.yaml").write_text(
        "mouse: 1\ntitle: stem and whip\nmodel:\n  stiffness: {file: K.mtx}\n  mass: {file: M.mtx}\n  dofs: {file: dofs.csv}\n"
        "  nodes: {file: nodes.csv}\n  supports:\n    FOOT: {dofs: [1TX, 1TY, 1RZ]}\n"
        "parameters:\n  - {name: E, nominal: 1, sd: 5 %, transform: log, stiffness: {file: K.mtx}}\n"
        f"test:\n  modes:\n    frequency: {[round(float(v), 6) for v in hz]}\n    frequency_sd: 0.1 %\n"
        f"    dofs: [{', '.join(f'{i + 1}{d}' for i, d in sensors)}]\n    shapes:\n{shapes}\n    shape_sd: 1 %\n"
    )
    return str(folder / "deck.yaml")


def test_nodes_all_over_the_structure_are_looked_at(tmp_path):
    """Where the survey took none of the branch: a mass on a leg of an imported tower was an oscillator elsewhere and two parts of
    another material, P > 0.999.
    """
    problem = read_deck(deck(tmp_path, 2.0))
    model = reduced(problem, problem.prior.mean)
    stem = np.arange(9, 3 * STEM[1], 12)
    labels = {problem.structure.labels[i] for i in heavier(model, stem)}
    assert {f"{LADEN + 1}TX", f"{LADEN + 1}TY"} <= labels


def test_a_mass_on_a_slender_part_is_named_at_its_node(tmp_path):
    path, mass = deck(tmp_path, 0.4), 0.4
    words = ["diagnose", path, "--json", "-q", "--candidates", "mass,ground-spring,oscillator", "--causes", "1"]
    found = json.loads(CliRunner().invoke(cli, words, catch_exceptions=False).stdout)
    assert (found["verdict"]["physics"], found["verdict"]["site"]["ids"]) == ("mass", [LADEN + 1])
    size = found["candidates"][0]["parameters"][0]
    assert abs(size["value"] - mass) < 3 * size["sd"]
