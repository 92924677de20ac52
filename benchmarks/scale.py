"""One updating cycle of a large model against the eigensolution of a good user, side by side in one run.

A cycle: assembly, numeric factorisation, eigensolution, sensitivities of 30 modes at all sensors to all parameters, Bayesian
estimate. A good user's eigensolution: numeric factorisation by the fastest solver installed, symbolic analysis done before,
and ARPACK around it, 30 modes. `--without-fast` takes the optional solver away from mouse and compares with
`scipy.sparse.linalg.eigsh(K, 30, M, sigma=...)` as a user calls it. Wall clock, one thread unless asked otherwise; medians of
paired repetitions. On a quiet machine: others slow either side. Each case ends with what is asked of it, what was measured,
and whether that is met. The frame of --without-fast is the building turned by 20 degrees against the axes; in the aligned one
most stored entries are zero, which costs eigsh dear.
"""

import argparse
import statistics
import sys

import _threads

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("cases", nargs="*", help="names as printed by --list; none: all of them")
parser.add_argument("--list", action="store_true", help="print the cases")
parser.add_argument("--rounds", type=int, default=3, help="paired repetitions (default 3)")
parser.add_argument("--threads", type=int, default=1, help="threads for linear algebra (default 1)")
parser.add_argument("--without-fast", action="store_true", help="numpy and scipy alone, against eigsh as it comes")

MODES = 30
CASES = {  # model, degrees of freedom, sensors, parameters, largest ratio
    "solid-1e5": ("solid", 100_000, 20, 100, 0.8),
    "plate-1e5": ("plate", 100_000, 20, 100, 0.8),
    "frame-1.4e5": ("frame", 140_000, 20, 100, 1.0),
    "solid-1e5-many": ("solid", 100_000, 100, 2000, 1.0),
    "plate-1e5-many": ("plate", 100_000, 100, 2000, 1.1),
    "frame-1.4e5-many": ("frame", 140_000, 100, 2000, 1.4),
    "frame-1e4": ("frame", 11_000, 20, 100, 2.0),
    "frame-1e4-many": ("frame", 11_000, 100, 2000, None),  # nothing is asked
}
WITHOUT = {  # the aim: how many times less time than eigsh as it comes a whole cycle takes
    "solid-3e4": ("solid", 30_000, 20, 100, 8.0),
    "frame-1e4": ("frame", 11_000, 20, 100, 50.0),
    "aligned-frame-1e4": ("aligned-frame", 11_000, 20, 100, 50.0),
}


def verdict(aim: float | None, measured: float, most: bool) -> str:
    """Asked, measured, met."""
    if aim is None:
        return f"asked: nothing; measured {measured:.2f}"
    met = measured <= aim if most else measured >= aim
    return f"asked: at {'most' if most else 'least'} {aim:g}; measured {measured:.2f}: {'met' if met else 'MISSED'}"


def compared(kind: str, n: int, sensors: int, parameters: int, aim: float | None, rounds: int) -> None:
    """Print the parts of a cycle, those of the yardstick, and the medians of their ratios."""
    from _one_cycle import Cycles, seconds
    from fast_factor import Symbolic, arpack, factorise, shift
    from scale_models import problem

    run = Cycles(problem(kind, n, parameters, MODES, sensors))
    symbolic = Symbolic(run.state.K, run.state.M, _threads.THREADS)
    sigma = shift(run.state.K, run.state.M, symbolic)
    measured = []
    for _ in range(rounds):
        parts = run.once()
        K, M = run.state.K, run.state.M
        parts["factorisation"], factor = seconds(lambda K=K, M=M: factorise(K, M, sigma, symbolic))
        parts["ARPACK"], _ = seconds(lambda K=K, M=M, factor=factor: arpack(K, M, sigma, factor, MODES))
        del factor
        measured.append(parts)
    typical = {name: statistics.median(parts[name] for parts in measured) for name in measured[0]}
    ratio = statistics.median(parts["cycle"] / (parts["factorisation"] + parts["ARPACK"]) for parts in measured)
    own = statistics.median(parts["cycle"] / parts["eigensolution"] for parts in measured)
    print_cycle(kind, run.problem, typical)
    print(f"  yardstick: numeric factorisation {typical['factorisation']:.3f} + ARPACK {typical['ARPACK']:.3f} s")
    print(f"  against the eigensolution of mouse itself {own:.2f}")
    print(f"  ratio, {verdict(aim, ratio, True)}", flush=True)


def compared_with_eigsh(kind: str, n: int, sensors: int, parameters: int, aim: float, rounds: int) -> None:
    """Print the parts of a cycle without the optional solver, and the call that a user would write, once."""
    from _one_cycle import Cycles, seconds
    from scale_models import problem
    from scipy.sparse.linalg import eigsh

    case = problem(kind, n, parameters, MODES, sensors)
    sys.modules["rslab"] = None  # from here on it cannot be imported
    run = Cycles(case)
    measured = [run.once() for _ in range(rounds)]
    sigma = -0.3 * run.state.solution.eigenvalues[0]
    typical = {name: statistics.median(parts[name] for parts in measured) for name in measured[0]}
    print_cycle(kind, run.problem, typical)
    for name, shift in (("below zero", sigma), ("0", 0.0)):
        try:
            elapsed, _ = seconds(lambda shift=shift: eigsh(run.state.K, MODES, run.state.M, sigma=shift))
        except RuntimeError as reason:
            print(f"  eigsh(K, {MODES}, M, sigma={name}) fails: {reason}")
            continue
        times = elapsed / typical["cycle"]
        print(f"  eigsh(K, {MODES}, M, sigma={name}) {elapsed:.2f} s, once")
        print(f"  times faster, {verdict(aim, times, False)}", flush=True)


def print_cycle(kind: str, case, typical: dict[str, float]) -> None:
    """The case and the parts of its cycle."""
    test, p = case.test, len(case.parameters)
    print(f"{kind}: {case.structure.n} degrees of freedom, {test.s} sensors, {p} parameters, {MODES} modes")
    names = ("assembly", "eigensolution", "sensitivities", "Bayes")
    print(f"  cycle {typical['cycle']:.3f} s: " + ", ".join(f"{name} {typical[name]:.3f}" for name in names))


def main() -> None:
    """Run the cases named on the command line."""
    options = parser.parse_args()
    cases = WITHOUT if options.without_fast else CASES
    unknown = [name for name in options.cases if name not in cases]
    if unknown:
        parser.error(f"no case {unknown[0]}; there are {', '.join(cases)}")
    if options.list:
        print("\n".join(cases))
        return
    measure = compared_with_eigsh if options.without_fast else compared
    print(f"{options.threads} thread(s), wall clock, medians of {options.rounds}")
    for name in options.cases or cases:
        kind, n, sensors, parameters, aim = cases[name]
        measure(kind, n, sensors, parameters, aim, options.rounds)


if __name__ == "__main__":
    main()
