"""A minute of 16 channels at 5 kHz: read and turned into functions by mouse, against reading alone by numpy, in turn in one run.

The yardsticks are `numpy.load` of all arrays of an archive and `numpy.loadtxt` of a table. mouse reads a deck that names the
channels, converts units, looks for faults in every channel, and estimates 15 functions by H1 at 2048 lines with variances.
CPU seconds; the medians of some rounds.
"""

import argparse
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import _threads  # noqa: F401 - sets the number of threads before numpy is there
import numpy as np

from mouse_cli.formats import read_deck
from mouse_cli.model.spectra import SpectraOptions
from mouse_cli.records.measurements import measure

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--rounds", type=int, default=5)
parser.add_argument("--threads", type=int, default=1)

RATE, SECONDS, CHANNELS, LINES = 5000, 60, 16, 2048


def files(folder: Path) -> dict[str, Path]:
    """The same recording as archive and as table, and a deck for each."""
    rng = np.random.default_rng(1)
    samples = rng.standard_normal((RATE * SECONDS, CHANNELS)).astype(np.float32).astype(float)
    names = [f"c{j}" for j in range(CHANNELS)]
    np.savez(folder / "run.npz", **{name: samples[:, j] for j, name in enumerate(names)}, fs=float(RATE))
    np.savetxt(folder / "run.csv", samples, delimiter=",", fmt="%.7g", header=",".join(names), comments="")
    sensors = ", ".join(f"{j}: {{channel: c{j}, unit: g}}" for j in range(1, CHANNELS))
    decks = {}
    for kind in ("npz", "csv"):
        decks[kind] = folder / f"{kind}.yaml"
        decks[kind].write_text(
            f"mouse: 1\nmodel: {{stiffness: {{diagonal: {[1] * CHANNELS}}}, mass: {{identity: {CHANNELS}}}}}\nparameters: []\n"
            f"test: {{recordings: [{{file: run.{kind}, sample_rate: {RATE}, inputs: {{1: {{channel: c0, unit: N}}}}, "
            f"outputs: {{{sensors}}}}}]}}\n"
        )
    return decks


def seconds(action: Callable[[], object]) -> float:
    """CPU seconds of one call."""
    start = time.process_time()
    action()
    return time.process_time() - start


def archive(path: Path) -> None:
    """What numpy does of an archive."""
    with np.load(path) as found:
        for name in found.files:
            found[name]


def main() -> None:
    rounds = parser.parse_args().rounds
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        decks = files(folder)
        yardsticks = {
            "npz": lambda: archive(folder / "run.npz"),
            "csv": lambda: np.loadtxt(folder / "run.csv", delimiter=",", skiprows=1),
        }
        print(f"{CHANNELS} channels, {SECONDS} s at {RATE} Hz, {LINES} lines; medians of {rounds} rounds, CPU seconds")
        for kind, deck in decks.items():
            parts: dict[str, list[float]] = {"numpy": [], "read": [], "functions": []}
            for _ in range(rounds):
                parts["numpy"].append(seconds(yardsticks[kind]))
                parts["read"].append(seconds(lambda: read_deck(deck)))
                problem = read_deck(deck)
                options = SpectraOptions(lines=LINES)
                parts["functions"].append(seconds(lambda: measure(problem.recordings, options, CHANNELS)))
            median = {part: statistics.median(values) for part, values in parts.items()}
            ratios = [median["read"] / median["numpy"], (median["read"] + median["functions"]) / median["numpy"]]
            print(
                f"  {kind}: numpy reads {median['numpy']:.3f}; mouse {median['read']:.3f}, functions "
                f"{median['functions']:.3f}; ratio of reading {ratios[0]:.2f}, of all {ratios[1]:.2f}"
            )


if __name__ == "__main__":
    main()
