"""How often 90 % intervals of samples, and of the normal density of a run, hold what made the data.

    python benchmarks/posterior_coverage.py [TESTS] [--seed 1]

Each test: properties drawn from the prior of the deck, three masses on a chain of springs solved by scipy.linalg.eigh (not by
mouse), eigenvalues with normal errors whose sd does not depend on the truth. Over such tests an interval of the true posterior that
should hold a property 90 times in 100 does so. Springs and a mass are known to a third: posteriors are skew and correlated.
"""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from scipy.linalg import eigh
from scipy.stats import binom, norm

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mouse_cli.campaigns.sampling.sample import sample
from mouse_cli.formats import read_deck
from mouse_cli.model.sampled import Sampling

MEAN, SD, LEAST = np.array([1000.0, 800.0, 1.0]), np.array([350.0, 280.0, 0.35]), np.array([100.0, 80.0, 0.1])
ACCURACY, LEVEL = 0.02, 0.9
DECK = """\
mouse: 1
title: CHAIN OF THREE MASSES
model:
  stiffness: {{order: 3, entries: [[1, 1, 1800.0], [1, 2, -800.0], [2, 2, 1700.0], [2, 3, -900.0], [3, 3, 900.0]]}}
  mass: {{diagonal: [1.0, 1.0, 1.0]}}
parameters:
  - {{name: k1, nominal: 1000.0, sd: 350.0, lower: 100.0, stiffness: [[1, 1, 1]]}}
  - {{name: k2, nominal: 800.0, sd: 280.0, lower: 80.0, stiffness: [[1, 1, 1], [1, 2, -1], [2, 2, 1]]}}
  - {{name: m3, nominal: 1.0, sd: 0.35, lower: 0.1, mass: [[3, 3, 1]]}}
test: {{modes: {{number: [1, 2], frequency: [{hz[0]}, {hz[1]}], frequency_sd: [{sd[0]}, {sd[1]}]}}}}
"""


def drawn(rng: np.random.Generator) -> np.ndarray:
    """Properties from the prior within its limits."""
    while True:
        found = MEAN + SD * rng.standard_normal(3)
        if (found > LEAST).all():
            return found


def eigenvalues(k1: float, k2: float, m3: float) -> np.ndarray:
    """The two lowest (rad/s)^2."""
    K = np.array([[k1 + k2, -k2, 0], [-k2, k2 + 900.0, -900.0], [0, -900.0, 900.0]])
    return eigh(K, np.diag([1.0, 1.0, m3]), eigvals_only=True)[:2]


def measured(truth: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Two frequencies, and the sd of each that makes the eigenvalue's that of the errors: sd_lambda = 8 pi^2 f sd_f."""
    sd_value = 2 * ACCURACY * eigenvalues(*MEAN)
    while True:
        value = eigenvalues(*truth) + sd_value * rng.standard_normal(2)
        if (value > 0).all():
            hz = np.sqrt(value) / (2 * np.pi)
            return hz, sd_value / (8 * np.pi**2 * hz)


def main() -> None:
    """Print how often each kind of interval holds the truth, with the interval within which chance leaves an honest one."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tests", type=int, nargs="?", default=200)
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    rng, half = np.random.default_rng(given.seed), norm.ppf((1 + LEVEL) / 2)
    sampled, normal, doubted, short = np.zeros(3), np.zeros(3), 0, 0
    wrong = np.zeros(2)  # normal intervals that miss, where the run was doubted and where not
    with TemporaryDirectory() as folder:
        path = Path(folder) / "chain.yaml"
        for i in range(given.tests):
            truth = drawn(rng)
            hz, sd = measured(truth, rng)
            path.write_text(DECK.format(hz=hz.tolist(), sd=sd.tolist()))
            found = sample(read_deck(path), Sampling(seed=i))
            theta = found.chain.theta.reshape(-1, 3)
            low, high = np.quantile(theta, [(1 - LEVEL) / 2, (1 + LEVEL) / 2], axis=0)
            sampled += (low < truth) & (truth < high)
            mean = np.array([each.normal_mean for each in found.parameters])
            inside = np.abs(truth - mean) < half * np.array([each.normal_sd for each in found.parameters])
            normal += inside
            doubted += found.doubtful
            wrong[int(found.doubtful)] += np.sum(~inside)
            short += not found.long_enough
            print(f"\r{i + 1} of {given.tests}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    low, high = binom.ppf([0.025, 0.975], given.tests, LEVEL) / given.tests
    print(f"{given.tests} tests; an honest interval of {LEVEL:.0%} holds the truth in {low:.1%} to {high:.1%} of them")
    for name, a, b in zip(("k1", "k2", "m3"), sampled / given.tests, normal / given.tests, strict=True):
        print(f"{name}: samples {a:.1%}, normal density of the run {b:.1%}")
    print(f"normal density called doubtful in {doubted}, chains too short in {short}")
    for told, count, missed in (("doubted", doubted, wrong[1]), ("not doubted", given.tests - doubted, wrong[0])):
        if count:
            print(f"where it is {told}, its intervals hold {1 - missed / (3 * count):.1%}")


if __name__ == "__main__":
    main()
