"""Structures of which several sets of values fit as well: how often the stated sets hold the truth, and what is left unsaid.

    python benchmarks/ambiguity.py [TESTS] [--seed 1] [--kinds twins,chain]

Each kind has like parts that can be exchanged, or is seen in a mirror, and is tested twice: by frequencies alone, which leave that
open, and with shapes, which decide it. Truths are drawn from the prior and solved by scipy; all modes of the posterior are sought
by scipy.optimize.least_squares from exchanged truths and from draws of the prior; two are two where the density between them falls
to half. Counted: truths within the union of the 95 % intervals of the modes stated, exits 0 beside a second mode that holds more
than 5 %, warnings, and time of the search as a share of that of the command, where one answer is right.
"""

import argparse
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import permutations
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import least_squares
from scipy.stats import binom, norm

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from benchmarks._paired import seconds
from mouse_cli import read_deck, run
from mouse_cli.model.result import Result
from mouse_cli.updating import alternatives

HZ, SHAPE, SHARE = 0.005, 0.02, 0.05  # accuracies; a second mode that may not be left unsaid
_VALLEY = 2 * np.log(2.0)  # J by which it rises between two modes: the density there is half of the lower
_DRAWS = 20


@dataclass(frozen=True)
class Kind:
    """K = K0 + sum theta_s dK[s], M likewise (n, n); modes: measured; nominal: of each property; spread: its sd over that."""

    K0: np.ndarray
    M0: np.ndarray
    modes: int
    nominal: float
    spread: float
    dK: list[np.ndarray] = field(default_factory=list)
    dM: list[np.ndarray] = field(default_factory=list)

    def solve(self, theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (m,) in Hz and shapes (n, m) whose largest component is 1."""
        K = self.K0 + sum(value * part for value, part in zip(theta, self.dK, strict=False))
        M = self.M0 + sum(value * part for value, part in zip(theta, self.dM, strict=False))
        values, X = eigh(K, M, subset_by_index=(0, self.modes - 1))
        return np.sqrt(np.maximum(values, 0)) / (2 * np.pi), X / np.abs(X).max(axis=0)

    @property
    def count(self) -> int:
        """Number of properties."""
        return max(len(self.dK), len(self.dM))


def spring(n: int, i: int, j: int | None = None) -> np.ndarray:
    """A unit spring between i and j, or the ground (n, n)."""
    b = np.zeros(n)
    b[i] = 1.0
    if j is not None:
        b[j] = -1.0
    return np.outer(b, b)


def beam(elements: int, length: float) -> tuple[list[np.ndarray], np.ndarray]:
    """Stiffness of each Hermite element for EI = 1 and the mass for rho A = 1 of a beam on two supports (2 elements, ...)."""
    h, n = length / elements, 2 * elements + 2
    k = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                  [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3  # fmt: skip
    m = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                  [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420  # fmt: skip
    kept = [i for i in range(n) if i not in (0, n - 2)]
    parts, mass = [], np.zeros((n, n))
    for e in range(elements):
        at = np.ix_(range(2 * e, 2 * e + 4), range(2 * e, 2 * e + 4))
        part = np.zeros((n, n))
        part[at] = k
        mass[at] += m
        parts.append(part[np.ix_(kept, kept)])
    return parts, mass[np.ix_(kept, kept)]


def kinds() -> dict[str, Kind]:
    """All of them: exchanged supports, a chain and a beam in a mirror, columns of a portal, like oscillators, masses."""
    parts, mass = beam(6, 6.0)
    n, whole = len(mass), sum(parts)
    storeys = [spring(5, 0), *(spring(5, i, i + 1) for i in range(4)), spring(5, 4)]
    at = [2 * 2 - 1, 2 * 4 - 1]  # deflections at a third and two thirds of the span
    lateral = [sum(spring(4, i) for i in (0,)), sum(spring(4, i) for i in (1,))]
    return {
        "twins": Kind(500 * spring(2, 0, 1), np.eye(2), 2, 1000.0, 0.15, [spring(2, 0), spring(2, 1)]),
        "chain": Kind(np.zeros((5, 5)), np.eye(5), 4, 1000.0, 0.15, storeys),
        "beam": Kind(np.zeros((n, n)), mass, 4, 1000.0, 0.3, [sum(parts[i : i + 2]) for i in (0, 2, 4)]),
        "portal": Kind(
            800 * spring(4, 0, 1) + 3000 * (spring(4, 0, 2) + spring(4, 1, 3)), np.eye(4), 3, 1000.0, 0.3, lateral
        ),
        "oscillators": Kind(
            3000 * spring(4, 0), np.diag([3.0, 1, 1, 1]), 4, 1000.0, 0.15, [spring(4, 0, i) for i in (1, 2, 3)]
        ),
        "masses": Kind(1000 * whole, mass, 4, 2.0, 0.3, dM=[spring(n, i) for i in at]),
    }


def deck(path: Path, kind: Kind, hz: np.ndarray, shapes: np.ndarray | None) -> Path:
    """The deck of a kind at its nominal values, with measured frequencies (m,) and shapes (n, m)."""
    nominal = np.full(kind.count, kind.nominal)
    K = kind.K0 + sum(kind.nominal * part for part in kind.dK)
    M = kind.M0 + sum(kind.nominal * part for part in kind.dM)
    entries = lambda A: [[int(i) + 1, int(j) + 1, float(A[i, j])] for i, j in zip(*np.triu(A).nonzero(), strict=True)]
    matrix = lambda A: f"{{order: {len(A)}, entries: {entries(A)}}}"
    name, parts = ("stiffness", kind.dK) if kind.dK else ("mass", kind.dM)
    lines = ["mouse: 1", f"model: {{stiffness: {matrix(K)}, mass: {matrix(M)}}}", "parameters:"]
    lines += [
        f"  - {{name: p{s + 1}, nominal: {nominal[s]}, unit: N/m, sd: {kind.spread * nominal[s]}, {name}: {entries(part)}}}"
        for s, part in enumerate(parts)
    ]
    test = f"frequency: {hz.tolist()}, frequency_sd: {(HZ * hz).tolist()}"
    if shapes is not None:
        test += f", dofs: {list(range(1, len(K) + 1))}, shapes: {shapes.tolist()}, shape_sd: {SHAPE}"
    path.write_text("\n".join([*lines, f"test: {{modes: {{{test}}}}}", "run: {recursion: anchored}", ""]))
    return path


def modes(kind: Kind, hz: np.ndarray, truth: np.ndarray, rng: np.random.Generator) -> list[tuple[np.ndarray, float]]:
    """Modes of the posterior of frequencies alone, by scipy: values and Laplace's share, the largest first."""
    sd = kind.spread * kind.nominal
    accuracy = 8 * np.pi**2 * hz * HZ * hz  # of eigenvalues

    def left(theta: np.ndarray) -> np.ndarray:
        eigenvalues = (2 * np.pi * kind.solve(theta)[0]) ** 2
        return np.concatenate([(eigenvalues - (2 * np.pi * hz) ** 2) / accuracy, (theta - kind.nominal) / sd])

    cost = lambda theta: float(np.sum(left(theta) ** 2))
    starts = [np.array(each) for each in permutations(truth)][:24]
    starts += [truth[::-1], *(kind.nominal + sd * rng.standard_normal((_DRAWS, kind.count)))]
    ends = [least_squares(left, np.maximum(start, 0.3 * kind.nominal), x_scale=sd) for start in starts]
    found: list[tuple[np.ndarray, float]] = []
    for end in sorted(ends, key=lambda end: end.cost):
        sign, volume = np.linalg.slogdet(end.jac.T @ end.jac)
        path = lambda other, x=end.x: max(cost(x + part * (other - x)) for part in np.linspace(0, 1, 9))
        if sign > 0 and all(path(other) > 2 * end.cost + _VALLEY for other, _ in found):
            found.append((end.x, -end.cost - 0.5 * volume))
    weight = np.exp(np.array([each[1] for each in found]) - max(each[1] for each in found))
    order = np.argsort(-weight)
    return [(found[i][0], float(weight[i] / weight.sum())) for i in order]


def held(result: Result, truth: np.ndarray) -> np.ndarray:
    """Whether each property is in the union of its intervals (p,)."""
    z = norm.ppf(0.975)
    others = result.alternatives.others if result.alternatives else ()
    sets = [(result.revised.theta, result.sd_theta), *((each.theta, each.sd) for each in others)]
    return np.any([np.abs(theta - truth) <= z * sd for theta, sd in sets], axis=0)


def timed(path: Path, search: bool) -> tuple[Result, float]:
    """The answer and its CPU seconds, with the search for other modes or without."""
    sought = alternatives.posterior_modes
    if not search:
        alternatives.posterior_modes = lambda *given: []
    try:
        start = time.process_time()
        return run(read_deck(path)), time.process_time() - start
    finally:
        alternatives.posterior_modes = sought


def of_command(path: Path) -> float:
    """CPU seconds of `mouse run`, from its start to its end."""
    command = [sys.executable, "-m", "mouse_cli", "run", str(path), "-q"]
    return seconds(lambda: subprocess.run(command, stdout=subprocess.DEVNULL, check=False))


def open_tests(
    kind: Kind, tests: int, rng: np.random.Generator, path: Path
) -> Iterator[tuple[np.ndarray, bool, float]]:
    """Of frequencies alone: properties held, exit 0, and the share of the second mode of the posterior."""
    for _ in range(tests):
        truth = kind.nominal * np.maximum(1 + kind.spread * rng.standard_normal(kind.count), 0.3)
        hz = kind.solve(truth)[0] * (1 + HZ * rng.standard_normal(kind.modes))
        result = run(read_deck(deck(path, kind, hz, None)))
        found = modes(kind, hz, truth, rng)
        yield held(result, truth), result.exit_code == 0, found[1][1] if len(found) > 1 else 0.0


def decided_tests(kind: Kind, tests: int, rng: np.random.Generator, path: Path) -> Iterator[tuple[bool, float, float]]:
    """With shapes: whether other values are warned of, CPU seconds with the search and without."""
    for _ in range(tests):
        truth = kind.nominal * np.maximum(1 + kind.spread * rng.standard_normal(kind.count), 0.3)
        hz, shapes = kind.solve(truth)
        hz = hz * (1 + HZ * rng.standard_normal(kind.modes))
        deck(path, kind, hz, shapes + SHAPE * rng.standard_normal(shapes.shape))
        timed(path, True)
        result, long = timed(path, True)
        short = timed(path, False)[1]
        yield result.alternatives is not None and result.alternatives.doubtful, long, short


def main() -> None:
    """Prints a line for each kind, and the sums."""
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("tests", type=int, nargs="?", default=40)
    asked.add_argument("--seed", type=int, default=1)
    asked.add_argument("--kinds", type=lambda text: text.split(","), default=list(kinds()))
    given = asked.parse_args()
    rng, everything = np.random.default_rng(given.seed), []
    print(f"{'kind':<12}{'held':>7}{'exit 1':>8}{'second > 5 %':>14}{'unsaid':>8} | {'warned':>7}{'slower':>8}")
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        for name in given.kinds:
            kind = kinds()[name]
            rows = list(open_tests(kind, given.tests, rng, path))
            inside = np.concatenate([row[0] for row in rows])
            second = np.array([row[2] > SHARE for row in rows])
            unsaid = int(sum(row[1] and over for row, over in zip(rows, second, strict=True)))
            decided = list(decided_tests(kind, given.tests, rng, path))
            extra = np.mean([row[1] - row[2] for row in decided])
            slower = extra / (of_command(path) - extra)
            warned = sum(row[0] for row in decided)
            everything.append((inside.sum(), inside.size, unsaid, warned))
            print(f"{name:<12}{inside.mean():>7.1%}{sum(not row[1] for row in rows):>8}{second.sum():>14}{unsaid:>8} | "
                  f"{warned:>7}{slower:>8.1%}", flush=True)  # fmt: skip
    inside, size, unsaid, warned = np.sum(everything, axis=0)
    low, high = binom.ppf([0.025, 0.975], size, 0.95) / size
    print(f"in all: {inside / size:.1%} of {size} true values held (honest sets: {low:.1%} to {high:.1%} if independent), "
          f"{unsaid} unsaid, {warned} warned needlessly")  # fmt: skip


if __name__ == "__main__":
    main()
