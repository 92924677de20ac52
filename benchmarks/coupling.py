"""Coupling two parts known by functions at 200 interface degrees of freedom over 1000 lines, against numpy's batched solve of
that size.

Both sides count processor seconds in turn, in one run. The interface of the coupling is H_A + H_B (lines, 200, 200), and its
right-hand sides are the functions of 10 places elsewhere; numpy solves the sum with as many, and nothing else: it adds no
functions, scales nothing, and says nothing of condition numbers.

    python benchmarks/coupling.py [--interface 200] [--lines 1000] [--rounds 3]
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from mouse_cli.coupling import couple
from mouse_cli.model.coupling import Coupling, Lines, Point, Substructure
from mouse_cli.model.frf_test import FrfTest

_INNER = 10  # places of each part that are not joined


def part(name: str, hz: np.ndarray, size: int, rng: np.random.Generator) -> Substructure:
    """Functions (lines, size, size) of a part with random modes, reciprocal, losses of 2 per cent."""
    modes = size + 20
    X = rng.standard_normal((size, modes)) / np.sqrt(modes)
    omega = 2 * np.pi * np.linspace(2, 1.5 * hz[-1], modes)
    H = np.empty((len(hz), size, size), complex)
    for k, w in enumerate(2 * np.pi * hz):
        H[k] = (X / (omega**2 * (1 + 0.02j) - w**2)) @ X.T
    names = tuple(str(i) for i in range(size))
    frf = FrfTest(hz, H, "receptance", np.arange(size), np.arange(size), np.full(H.shape, np.nan), names, names)
    return Substructure(
        name, None, frf, places=names, responses=np.arange(size), forces=np.arange(size), signs=np.ones(size)
    )


def main() -> None:
    """Print the medians and their ratio."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in (("interface", 200), ("lines", 1000), ("rounds", 3)):
        arguments.add_argument(f"--{name}", type=int, default=default)
    given = arguments.parse_args()
    c, rng, hz = given.interface, np.random.default_rng(1), np.linspace(5, 200, given.lines)
    parts = tuple(part(name, hz, c + _INNER, rng) for name in "AB")
    pairs = tuple((Point(0, i), Point(1, i)) for i in range(c))
    asked = tuple(Point(k, c + i) for k in (0, 1) for i in range(_INNER // 2))
    deck = Coupling("benchmark", "", parts, pairs, (), asked, asked, Lines(), "receptance", 0.0, None)
    own, numpy = [], []
    for _ in range(given.rounds):
        began = time.process_time()
        found = couple(deck)
        own.append(time.process_time() - began)
        G = parts[0].frf.H[:, :c, :c] + parts[1].frf.H[:, :c, :c]
        right = np.concatenate(
            [parts[0].frf.H[:, :c, c : c + _INNER // 2], -parts[1].frf.H[:, :c, c : c + _INNER // 2]], axis=2
        )
        began = time.process_time()
        solved = np.linalg.solve(G, right)
        numpy.append(time.process_time() - began)
    left = np.swapaxes(right, 1, 2)
    before = np.zeros((len(hz), _INNER, _INNER), complex)
    for k in (0, 1):
        at = slice(k * _INNER // 2, (k + 1) * _INNER // 2)
        before[:, at, at] = parts[k].frf.H[:, c : c + _INNER // 2, c : c + _INNER // 2]
    error = np.abs(found.functions.H - (before - left @ solved)).max() / np.abs(before).max()
    ratio = np.median(own) / np.median(numpy)
    print(
        f"{c} interface degrees of freedom, {given.lines} lines: coupling {np.median(own):.2f} s, numpy {np.median(numpy):.2f} s"
    )
    print(
        f"ratio {ratio:.2f}; difference of the answers {error:.1e}; condition numbers up to {found.interface.condition.max():.3g}"
    )


if __name__ == "__main__":
    main()
