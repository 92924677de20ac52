"""Command line of the benchmark."""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from benchmarks.saturn import decks, tables
from benchmarks.saturn.of_1972 import update
from benchmarks.saturn.rivals import rivals
from benchmarks.saturn.stack import MEASURED
from benchmarks.saturn.vehicle import family, frequencies, with_shear

LEADING = ("shear", "rotary-inertia", "timoshenko", "oscillator")
OTHERS = ("foundation", "compression", "ground-spring", "mass", "joint", "stiffness-loss", "taper")


def main() -> None:
    """Print the tables, or write the decks."""
    options = _options()
    drawn = family(options.vehicles, options.seed, options.own_radii)
    if options.decks:
        _write(drawn, Path(options.decks))
        return
    print(tables.vehicles(drawn, np.array([frequencies(vehicle) for vehicle in drawn])), flush=True)
    print("\n" + tables.of_1972([{k: update(v, k) for k in (2, 3, 5)} for v in drawn]), flush=True)
    shear, both = (np.array([with_shear(vehicle, rotary) for vehicle in drawn]) for rotary in (False, True))
    print("\n" + tables.thin_tube(shear, both), flush=True)
    rows, early = [], []
    for number, vehicle in enumerate(drawn, 1):
        rows.append(rivals(vehicle, 5, LEADING if options.leading else LEADING + OTHERS))
        early.append(rivals(vehicle, 3, LEADING))
        print(f"vehicle {number} of {len(drawn)}", file=sys.stderr, flush=True)
    print("\n" + tables.evidence(rows, early))
    print("\n" + tables.settling(rows))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.saturn", description="Saturn V: five frequencies and their causes"
    )
    parser.add_argument("--vehicles", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--own-radii", action="store_true", help="sections with the radius of their stage, not of the first"
    )
    parser.add_argument("--leading", action="store_true", help="the four leading candidates alone")
    parser.add_argument("--decks", metavar="DIRECTORY", help="write the decks of each vehicle there, and stop")
    return parser.parse_args()


def _write(drawn, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for number, vehicle in enumerate(drawn, 1):
        for name, text in (("upper_half", decks.upper_half), ("stages", decks.segments)):
            (folder / f"saturn_{number:02}_{name}.yaml").write_text(text(vehicle, MEASURED))


if __name__ == "__main__":
    main()
