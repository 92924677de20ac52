"""Other values that fit as well: structures whose parts can be exchanged, and such as have one answer; truths by numpy."""

from pathlib import Path

import numpy as np
import pytest

from mouse_cli import read_deck, run
from mouse_cli.cli.main import _run
from mouse_cli.updating.posterior import laplace
from mouse_cli.updating.prior_model import begin

DECKS = Path(__file__).resolve().parents[2] / "decks"
MIRRORED = (5, 3)  # storeys of a chain held at both ends, and of measured modes


def chain_deck(path: Path, k: np.ndarray, noise: np.ndarray, shapes: bool) -> Path:
    """Masses of 1 kg on springs k (n + 1,) between two walls, each a parameter, 1000 +- 150 N/m; the lowest modes, 0.5 % noise."""
    n, m = len(k) - 1, MIRRORED[1]
    K = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
    values, vectors = np.linalg.eigh(K)
    hz = np.sqrt(values[:m]) / (2 * np.pi) * (1 + 0.005 * noise[:m])
    prior = 1000.0 * (np.diag(np.full(n, 2.0)) - np.eye(n, k=1) - np.eye(n, k=-1))
    entries = [f"[{i + 1}, {j + 1}, {prior[i, j]}]" for i in range(n) for j in range(i, n) if prior[i, j]]
    ends = lambda s: [(i, i, 1) for i in (s, s + 1) if 1 <= i <= n] + ([(s, s + 1, -1)] if 1 <= s < n else [])
    lines = [
        "mouse: 1",
        f"model: {{stiffness: {{order: {n}, entries: [{', '.join(entries)}]}}, mass: {{diagonal: {[1.0] * n}}}}}",
        "parameters:",
        *(
            f"  - {{name: k{s}, nominal: 1000.0, unit: N/m, sd: 150.0, stiffness: {[list(e) for e in ends(s)]}}}"
            for s in range(n + 1)
        ),
        f"test: {{modes: {{frequency: {hz.tolist()}, frequency_sd: 0.5 %",
    ]
    if shapes:
        X = vectors[:, :m] / np.abs(vectors[:, :m]).max(axis=0)
        lines[-1] += f", dofs: {list(range(1, n + 1))}, shapes: {X.tolist()}, shape_sd: 0.02"
    path.write_text("\n".join(lines) + "}}\nrun: {recursion: anchored}\n")
    return path


def sets(result) -> list[tuple[np.ndarray, np.ndarray]]:
    """Values and sd of all modes of the posterior."""
    others = result.alternatives.others if result.alternatives else ()
    return [(result.revised.theta, result.sd_theta), *((each.theta, each.sd) for each in others)]


def minima(hz: np.ndarray, seed: int) -> list[np.ndarray]:
    """Where J of the chain's frequencies is lowest, by scipy from 20 draws of the prior, within 3 of the least."""
    from scipy.optimize import least_squares

    def left(k: np.ndarray) -> np.ndarray:
        K = np.diag(k[:-1] + k[1:]) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
        values = np.linalg.eigvalsh(K)[: len(hz)]
        measured = (2 * np.pi * hz) ** 2
        return np.concatenate([(values - measured) / (2 * 0.005 * measured), (k - 1000.0) / 150.0])

    rng = np.random.default_rng(seed)
    ends = [least_squares(left, 1000.0 + 150.0 * rng.standard_normal(4), x_scale=150.0) for _ in range(20)]
    least = min(end.cost for end in ends)
    return [end.x for end in ends if 2 * (end.cost - least) < 3.0]


def test_a_chain_seen_in_a_mirror(tmp_path):
    """Frequencies of springs between two walls stay in reversed order; where that leaves two answers, scipy finds the same two."""
    rng, inside, alone, doubtful = np.random.default_rng(5), [], [], 0
    for i in range(20):
        k, noise = 1000.0 + 150.0 * rng.standard_normal(4), rng.standard_normal(3)
        deck = read_deck(chain_deck(tmp_path / f"{i}.yaml", k, noise, False))
        result = run(deck)
        assert result.status.key == "converged"
        found = sets(result)
        for x in minima(deck.test.frequency_hz, i):
            assert min(np.abs((theta - x) / sd).max() for theta, sd in found) < 1.5  # of one mode that is not normal
        within = [np.abs(theta - k) < 1.96 * sd for theta, sd in found]
        inside += np.any(within, axis=0).tolist()
        alone += within[0].tolist()
        doubtful += result.exit_code == 1
    assert np.mean(inside) >= 0.9 and doubtful >= 4 and np.mean(alone) <= np.mean(inside)


def test_shapes_leave_one_answer(tmp_path):
    rng = np.random.default_rng(6)
    for i in range(8):
        k = 1000.0 + 150.0 * rng.standard_normal(4)
        result = run(read_deck(chain_deck(tmp_path / f"{i}.yaml", k, rng.standard_normal(3), True)))
        assert result.alternatives is None or not result.alternatives.doubtful
        assert result.exit_code == 0


def test_a_run_that_would_end_on_a_saddle_goes_on():
    """Begun at equal values it stays equal, J 38 instead of 1; both orders of 800 and 1200 N/m have half of the posterior."""
    result = run(read_deck(DECKS / "twin_springs.yaml"))
    assert sorted(result.revised.theta) == pytest.approx([795.0, 1199.0], abs=1.0)
    (other,) = result.alternatives.others
    assert other.theta == pytest.approx(result.revised.theta[::-1], rel=1e-6)
    assert other.share == pytest.approx(0.5, abs=1e-3) and result.exit_code == 1


def test_the_measurement_that_decides_is_named(capsys):
    """Shapes of mode 1 of [[a + 500, -500], [-500, b + 500]], a = 795, b = 1199, by hand: the softer side moves most."""
    assert _run(["run", str(DECKS / "twin_springs.yaml"), "--numbers", "modern"]) == 1
    said = " ".join(capsys.readouterr().out.split())
    a, b = 794.912, 1199.49
    half = np.hypot((b - a) / 2, 500.0)
    smaller = ((a - b) / 2 + half) / 500.0
    assert "OTHER VALUES THAT FIT AS WELL" in said and "others hold 50 per cent of the posterior" in said
    assert (
        f"measure the shape of mode 1 at degree of freedom 1: the answer predicts 1.000 there, the other {smaller:.3f}"
        in said
    )


def test_the_density_at_its_mode(tmp_path):
    """One mass on a spring, one sd above its prior, in closed form: J = r^2 + 1, and log evidence -J/2 - ln(1 + B^2)/2."""
    k, sd, hz = 1000.0, 50.0, 5.2
    model = "model: {stiffness: {order: 1, entries: [[1, 1, 1000.0]]}, mass: {diagonal: [1]}}"
    text = f"mouse: 1\n{model}\nparameters: [{{name: k, nominal: {k}, sd: {sd}, stiffness: [[1, 1, 1]]}}]\n"
    (tmp_path / "deck.yaml").write_text(text + f"test: {{modes: {{frequency: [{hz}], frequency_sd: 0.1}}}}\n")
    setting, _ = begin(read_deck(tmp_path / "deck.yaml"))
    normal = laplace(setting, setting.state(np.array([k + sd])))
    of_test = 8 * np.pi**2 * hz * 0.1
    cost = (((2 * np.pi * hz) ** 2 - (k + sd)) / of_test) ** 2 + 1
    assert normal.cost == pytest.approx(cost, rel=1e-9)
    assert normal.log_evidence == pytest.approx(-cost / 2 - np.log1p((sd / of_test) ** 2) / 2, rel=1e-9)
