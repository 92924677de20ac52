"""A storey that yields, in recordings: scipy integrates its hysteresis from elastic to plastic and back."""

import json

import numpy as np
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from mouse_cli.cli.main import cli

M, C, K = 100.0, 60.0, 4.0e4  # kg, N s/m, N/m: 3.2 Hz
YIELDING, FORCE = 0.6 * K, 120.0  # N/m, N
RATE, SECONDS = 100, 16.0
DECK = f"""mouse: 1
model:
  stiffness: {{diagonal: [{K}]}}
  mass: {{diagonal: [{M}]}}
  damping: {{diagonal: [{C}]}}
parameters: [{{name: k, nominal: {K}, sd: 5 %, stiffness: [[1, 1, 1]]}}]
test:
  recordings:
    - {{file: run.csv, sample_rate: {RATE}, inputs: {{1: shaker}}, outputs: {{1: acc}}}}
"""


def storey(folder, level: float) -> str:
    """A deck whose record is of a random force of so much rms, N; a part of the spring yields at FORCE."""
    rng, t = np.random.default_rng(5), np.arange(int(SECONDS * RATE)) / RATE
    hz = np.fft.rfftfreq(len(t), 1 / RATE)
    f = np.fft.irfft(np.where((hz > 0.5) & (hz < 12), np.exp(2j * np.pi * rng.uniform(size=len(hz))), 0), len(t))
    f *= level / f.std() * np.minimum(t, 1)
    force = CubicSpline(t, f)

    def rhs(s, y):
        x, v, q = y  # q: force of the part that yields
        plastic = abs(q) >= FORCE and q * v > 0
        a = (force(s) - (K - YIELDING) * x - np.clip(q, -FORCE, FORCE) - C * v) / M
        return np.array([v, a, 0.0 if plastic else YIELDING * v])

    done = solve_ivp(rhs, (0, t[-1]), np.full(3, 1e-12), t_eval=t, rtol=1e-5, atol=1e-8, max_step=0.5 / RATE)
    a = np.array([rhs(s, y)[1] for s, y in zip(t, done.y.T, strict=True)])
    a += 0.01 * a.std() * rng.standard_normal(len(a))
    np.savetxt(folder / "run.csv", np.column_stack([f, a]), "%.7g", ",", header="shaker (N),acc (m/s2)", comments="")
    (folder / "deck.yaml").write_text(DECK)
    return str(folder / "deck.yaml")


def test_a_spring_that_yields_is_named_with_its_force(tmp_path):
    """As stiff as modelled until it yields: friction beside the spring took 12 prior sd off a storey, and no fit was accepted."""
    done = CliRunner().invoke(cli, ["diagnose", storey(tmp_path, 150.0), "--json", "-q"])
    found = json.loads(done.stdout)
    assert (found["verdict"]["kind"], found["verdict"]["physics"], found["verdict"]["site"]["ids"]) == ("named", "yielding", [1])
    for size, true in zip(found["candidates"][0]["parameters"], (YIELDING, FORCE), strict=True):
        assert abs(size["value"] - true) < 4 * size["sd"] + 0.03 * true


def test_one_that_is_not_shaken_enough_lacks_nothing(tmp_path):
    done = CliRunner().invoke(cli, ["diagnose", storey(tmp_path, 5.0), "--json", "-q"])
    assert json.loads(done.stdout)["verdict"]["kind"] == "nothing-missing"
