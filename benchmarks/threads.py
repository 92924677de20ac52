"""One thread for linear algebra against all that there are: whole `run()` calls of two decks, each in its own process."""

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
start = time.perf_counter()
for _ in range(20):
    run(problem)
print((time.perf_counter() - start) / 20)
"""


def seconds(deck: Path, threads: int) -> float:
    """Mean time of a run in a process that may use so many threads."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads)}
    done = subprocess.run(
        [sys.executable, "-c", CODE, deck], capture_output=True, text=True, env=environment, check=True
    )
    return float(done.stdout)


cores = os.cpu_count() or 1
for name in ("table_5_3.yaml", "beam_58.yaml"):
    pairs = [(seconds(DECKS / name, 1), seconds(DECKS / name, cores)) for _ in range(7)]
    one, many = (1e3 * statistics.median(times) for times in zip(*pairs, strict=True))
    ratio = statistics.median(b / a for a, b in pairs)
    print(f"{name:16} 1 thread {one:6.2f} ms   {cores} threads {many:6.2f} ms   ratio {ratio:.2f}")
