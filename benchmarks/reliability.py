"""What mouse claims against what happens: coverage of its intervals, false and missed alarms, answers from far starts.

Counts, not times; the simulated tests are those of tests/property, more of them.
"""

import argparse
import os
import sys
from collections import Counter
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "property"))

import numpy as np
import test_convergence as far
import test_statistics as simulated
from chains import simulate
from scipy.stats import kstest

from mouse_cli.updating import run

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--share", type=float, default=1.0, help="of the counts of all trials, to see that it runs")
share_of = parser.parse_args().share
simulated.TRIALS = round(share_of * simulated.TRIALS)
tests, springs, factors = (
    round(2000 * share_of),
    round(100 * share_of),
    far.FACTORS[: round(share_of * len(far.FACTORS)) or 1],
)

wide = list(simulated.trials(1, 0.10, 0.01, 0.05))
print(f"coverage of the anchored posterior, {simulated.TRIALS} simulated tests, each of four properties")
for confidence, z in simulated.QUANTILE.items():
    inside = np.mean([np.abs(r.revised.theta - truth) <= z * r.sd_theta for truth, r in wide], axis=0)
    print(f"  {confidence} %: " + " ".join(f"{share:.3f}" for share in inside))

narrow = [r for _, r in simulated.trials(2, 0.01, 0.005, 0.01)]
print("uniformity of the model-form probabilities when nothing is missing (Kolmogorov-Smirnov p)")
for name in ("innovation", "residual", "prior_shift"):
    print(f"  {name}: {kstest([getattr(r, name).p for r in narrow], 'uniform').pvalue:.2f}")

rng = np.random.default_rng(22)
alarms = Counter()
for _ in range(tests):
    truth = far.NOMINAL * (1 + 0.05 * rng.standard_normal(4))
    test = simulate(far.CHAIN.stiffness(truth), np.eye(4), rng, 0.01, 0.02)
    alarms[run(far.CHAIN.problem(test, 0.05 * far.NOMINAL)).exit_code] += 1
print(f"false alarms: {tests - alarms[0]} of {tests} ({0.002 * tests:g} expected: two tests at 1 in 1000)")
for position in (1, 2, 3):
    found = sum(far.alarm(position, np.random.default_rng(seed)).exit_code == 1 for seed in range(springs))
    print(f"spring of 400 N/m to the ground at mass {position + 1}: noticed in {found} of {springs}")

print(
    f"springs off by factors 2 to 10: within 2 % of the truth (of {len(factors)}); farther off, yet exit 0; of these, beyond 6 sd"
)
for recursion in ("replaced", "anchored"):
    for step in (far.FIRST, far.SECOND):
        for transform in ("identity", "log"):
            runs = [far.attempt(f, recursion, step, transform) for f in factors]
            right = [far.reached(r, f) for r, f in zip(runs, factors, strict=True)]
            off = [
                np.abs((r.revised.theta - far.NOMINAL * f) / r.sd_theta).max()
                for r, f, ok in zip(runs, factors, right, strict=True)
                if r.exit_code == 0 and not ok
            ]
            beyond = sum(distance > 6 for distance in off)
            print(f"  {recursion:8} {step:12} {transform:8} {sum(right):2}   {len(off)}   {beyond}")
