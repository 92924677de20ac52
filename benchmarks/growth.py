"""How the cost of an updating cycle grows with the model, beside the factorisation's own growth.

Cost ~ n^exponent, fitted to the sizes from 10,000 degrees of freedom: a cycle must grow no faster than the numeric
factorisation and the solutions that an eigensolution takes anyway. CPU seconds on one thread. The solid takes longest: name
it, or a smaller --largest.
"""

import argparse
import statistics

import _threads  # noqa: F401 - sets the number of threads before numpy is there
import numpy as np

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("kinds", nargs="*", help="solid, plate, frame; none: plate and frame")
parser.add_argument("--largest", type=float, default=3e5, help="degrees of freedom (default 3e5)")
parser.add_argument("--modes", type=int, default=10)

SIZES = (1e3, 3e3, 1e4, 3e4, 1e5, 3e5)
SENSORS, PARAMETERS, FITTED_FROM, BRIEF = 20, 100, 9e3, 2e4
PARTS = ("factorisation", "assembly", "eigensolution", "sensitivities", "Bayes", "cycle")


def costs(kind: str, n: float, modes: int) -> tuple[int, dict[str, float]]:
    """Degrees of freedom, and the seconds of each of PARTS, at one size."""
    from _one_cycle import Cycles, seconds
    from fast_factor import Symbolic, factorise, shift
    from scale_models import problem

    run = Cycles(problem(kind, n, PARAMETERS, modes, SENSORS))
    symbolic = Symbolic(run.state.K, run.state.M)
    sigma = shift(run.state.K, run.state.M, symbolic)
    rounds = []
    for _ in range(5 if n < BRIEF else 1):
        parts = run.once()
        parts["factorisation"], _ = seconds(lambda: factorise(run.state.K, run.state.M, sigma, symbolic))
        rounds.append(parts)
    return run.problem.structure.n, {name: statistics.median(parts[name] for parts in rounds) for name in PARTS}


def main() -> None:
    """Print a table for each model, and the exponents fitted."""
    options = parser.parse_args()
    print(
        f"{options.modes} modes, {SENSORS} sensors, {PARAMETERS} parameters; the factorisation is part of the eigensolution"
    )
    for kind in options.kinds or ("plate", "frame"):
        print(f"{kind:>8} " + " ".join(f"{name:>14}" for name in PARTS) + " cycle/factorisation")
        table = []
        for n in (n for n in SIZES if n <= options.largest):
            size, parts = costs(kind, n, options.modes)
            table.append((size, parts))
            row = " ".join(f"{parts[name]:14.4f}" for name in PARTS)
            print(f"{size:8d} {row} {parts['cycle'] / parts['factorisation']:19.1f}", flush=True)
        fitted = [(size, parts) for size, parts in table if size >= FITTED_FROM]
        if len(fitted) > 1:
            logs = np.log([size for size, _ in fitted])
            slope = {name: np.polyfit(logs, np.log([max(p[name], 1e-9) for _, p in fitted]), 1)[0] for name in PARTS}
            print("exponent " + " ".join(f"{slope[name]:14.2f}" for name in PARTS), flush=True)


if __name__ == "__main__":
    main()
