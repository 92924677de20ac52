"""Processor time of linear algebra on one thread against all that there are: whole runs of two decks, each in its own process."""

import argparse
import os
import statistics
import subprocess
import sys
from pathlib import Path

DECKS = Path(__file__).parents[1] / "decks"
CODE = """
import sys, time
from mouse_cli.formats import read_deck
from mouse_cli.updating import run
problem = read_deck(sys.argv[1])
run(problem)
start = time.process_time()
for _ in range(int(sys.argv[2])):
    run(problem)
print((time.process_time() - start) / int(sys.argv[2]))
"""


def seconds(deck: Path, threads: int, runs: int) -> float:
    """Mean processor time of a run in a process that may use so many threads."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads)}
    done = subprocess.run(
        [sys.executable, "-c", CODE, deck, str(runs)], capture_output=True, text=True, env=environment, check=True
    )
    return float(done.stdout)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--rounds", type=int, default=7)
parser.add_argument("--runs", type=int, default=20)
given = parser.parse_args()
cores = os.cpu_count() or 1
for name in ("table_5_3.yaml", "beam_58.yaml"):
    pairs = [
        (seconds(DECKS / name, 1, given.runs), seconds(DECKS / name, cores, given.runs)) for _ in range(given.rounds)
    ]
    one, many = (1e3 * statistics.median(times) for times in zip(*pairs, strict=True))
    ratio = statistics.median(b / a for a, b in pairs)
    print(f"{name:16} 1 thread {one:6.2f} ms   {cores} threads {many:6.2f} ms   ratio {ratio:.2f}")
