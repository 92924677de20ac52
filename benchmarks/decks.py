"""1000 small decks in one process: time per deck, beside the eigensolutions that it contains."""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import argparse
import statistics
import time
from pathlib import Path

from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.formats import read_deck
from mouse_cli.updating import run

DECKS = Path(__file__).parents[1] / "decks"


def seconds(action) -> float:
    """Processor time of one call."""
    start = time.process_time()
    action()
    return time.process_time() - start


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--count", type=int, default=1000)
count = parser.parse_args().count
for name in ("table_5_2.dat", "table_5_2.yaml", "table_5_3.dat"):
    path = DECKS / name
    problem = read_deck(path)
    cycles = len(run(problem).cycles)
    K, M = problem.structure.K, problem.structure.M
    reading, running, solving = [], [], []
    for _ in range(count):
        reading.append(seconds(lambda: read_deck(path)))
        running.append(seconds(lambda: run(problem)))
        solving.append(seconds(lambda: [eigensolution(K, M) for _ in range(cycles + 1)]))
    read, ran, solved = (1e6 * statistics.median(times) for times in (reading, running, solving))
    print(
        f"{name:15} reading {read:5.0f} us, running {ran:5.0f} us, of which {cycles + 1} eigensolutions {solved:4.0f} us; "
        f"running / eigensolutions {ran / solved:.1f}; {1e6 / (read + ran):.0f} decks/s"
    )
