"""Feet of imported matrices that are alike: on rubber, free to slide, or loose in twos; tests of a truss solved here by `eigh`."""

from itertools import combinations

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh
from scipy.sparse import csr_matrix, save_npz

from mouse_cli import diagnose, read_deck
from mouse_cli.model.diagnosis import NAMED, Choices
from mouse_cli.terms.assembly import assembly

CORNERS = [(0, 0), (3, 0), (3, 2), (0, 2)]
FEET = {f"FOOT_{i}": (2 * i - 1, 2 * i) for i in range(1, 5)}  # two nodes each, at z = 0
N = 20
SENSORS = [f"{n}T{d}" for n in (9, 10, 11, 12, 14, 17, 19) for d in "XYZ"]


def places() -> np.ndarray:
    """Nodes (20, 3): eight of the feet, four above them, others anywhere higher."""
    feet = [(x + dx, y, 0.0) for x, y in CORNERS for dx in (-0.2, 0.2)]
    table = [(x, y, 0.4) for x, y in CORNERS]
    return np.array(feet + table + (np.random.default_rng(3).uniform(0, 1, (8, 3)) * (3, 2, 0.6) + (0, 0, 0.6)).tolist())


def truss(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """K and M (60, 60): bars of 1e7 N/m between all nodes that are near, 1 kg a node."""
    K = np.zeros((3 * N, 3 * N))
    for i, j in combinations(range(N), 2):
        along = x[i] - x[j]
        if np.linalg.norm(along) < 2.2:
            b = np.zeros(3 * N)
            b[3 * i : 3 * i + 3], b[3 * j : 3 * j + 3] = along, -along
            K += 1e7 / (along @ along) * np.outer(b, b)
    return K, 2 * np.eye(3 * N)


def deck(folder, springs: dict[str, tuple[float, float, float]]):
    """The truss with its feet held; its test is of one with feet on `springs` (along x, y and z), the other feet held."""
    x = places()
    K, M = truss(x)
    for name, matrix in {"K": K, "M": M}.items():
        save_npz(folder / f"{name}.npz", csr_matrix(matrix))
    (folder / "dofs.csv").write_text("".join(f"{n},T{d}\n" for n in range(1, N + 1) for d in "XYZ"))
    (folder / "nodes.csv").write_text("".join(f"{n},{','.join(map(repr, at))}\n" for n, at in enumerate(x.tolist(), 1)))
    for name, nodes in FEET.items():
        own = [3 * (n - 1) + d for n in nodes for d in range(3)]
        K[own, own] += np.tile(springs.get(name, (1e14,) * 3), len(nodes)) / len(nodes)
    rng = np.random.default_rng(1)
    rates, X = eigh(K, M)
    hz = np.sqrt(rates[:9]) / (2 * np.pi) * (1 + 0.001 * rng.standard_normal(9))
    X = X[[3 * (int(s[:-2]) - 1) + "XYZ".index(s[-1]) for s in SENSORS], :9]
    X = X / np.abs(X).max(axis=0) + 0.005 * rng.standard_normal(X.shape)
    feet = "".join(f"    {name}: {{nodes: {list(own)}, directions: [TX, TY, TZ]}}\n" for name, own in FEET.items())
    order = np.argsort(hz)
    (folder / "truss.yaml").write_text(
        "mouse: 1\nunits: SI\nmodel:\n  stiffness: {file: K.npz}\n  mass: {file: M.npz}\n  dofs: {file: dofs.csv}\n"
        f"  nodes: {{file: nodes.csv}}\n  supports:\n{feet}"
        "parameters:\n  - {name: E, nominal: 1, sd: 5 %, stiffness: {file: K.npz}}\n"
        f"test:\n  modes:\n    frequency: {hz[order].tolist()}\n    frequency_sd: 0.1 %\n    dofs: [{', '.join(SENSORS)}]\n"
        f"    shapes: {X[:, order].tolist()}\n    shape_sd: 0.5 %\n"
    )
    return read_deck(folder / "truss.yaml")


RUBBER, SLIDING, LOOSE = (1e5, 1e5, 5e5), (1e5, 1e5, 1e14), (0.0, 0.0, 0.0)
TRUTHS = {
    "all supports, along TZ and across it, alike": (dict.fromkeys(FEET, RUBBER), (5e5, 1e5)),
    "all supports, across TZ, alike": (dict.fromkeys(FEET, SLIDING), (1e5,)),
    "the supports FOOT_1 and FOOT_3, all directions, alike": (dict.fromkeys(("FOOT_1", "FOOT_3"), LOOSE), None),
}


@pytest.mark.parametrize("words", proofs(TRUTHS, "all supports, along TZ and across it, alike"))
def test_feet_that_are_alike_are_one_mechanism(tmp_path, words):
    """They were several, and the search of them had no end."""
    springs, sizes = TRUTHS[words]
    problem = deck(tmp_path, springs)
    found = diagnose(problem, choices=Choices(candidates=("support-translation", "mass", "ground-spring")))
    best = next(one for one in found.explanations if one.causes)
    (cause,) = best.causes
    assert found.kind == NAMED and cause.physics == "support-translation" and cause.site.text == words
    if sizes:
        assert [size.value for size in cause.sizes] == pytest.approx(sizes, rel=0.05)
    extended = found.extended
    rates = eigh(*assembly(extended).matrices(extended.prior.mean), eigvals_only=True)[:9]
    np.testing.assert_allclose(np.sqrt(rates) / (2 * np.pi), problem.test.frequency_hz, rtol=0.03)
