"""Two dask workers against one on the same decks: wall seconds of whole batches, start-up of scheduler and workers taken off.

    python benchmarks/batch_workers.py [DECKS] [--repeats 3]

The physical limit is the ratio of two processes of `mouse batch --jobs`, measured in the same run: cores share caches and memory.
Without dask.distributed that is all there is to measure.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import argparse
import subprocess
import sys
import tempfile
import time
from importlib.util import find_spec
from pathlib import Path
from statistics import median

from batch import decks

OPTIONS = ("--cluster", "--jobs") if find_spec("distributed") else ("--jobs",)


def wall(folder: Path, out: Path, option: str, workers: int) -> float:
    """Seconds of one batch into the empty folder `out`."""
    command = [sys.executable, "-m", "mouse_cli", "batch", str(folder), "-q", "-o", str(out), option, str(workers)]
    begun = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - begun


def main() -> None:
    """Prints the ratios."""
    asked = argparse.ArgumentParser()
    asked.add_argument("decks", nargs="?", type=int, default=3000)
    asked.add_argument("--repeats", type=int, default=3)
    given = asked.parse_args()
    spent: dict[tuple[str, int, str], list[float]] = {}
    with tempfile.TemporaryDirectory() as place:
        top = Path(place)
        decks(top / "one", 1)
        decks(top / "many", given.decks)
        for i in range(given.repeats):
            for option in OPTIONS:
                for workers in (1, 2):
                    for size in ("one", "many"):
                        out = top / f"out{option}{workers}{size}{i}"
                        spent.setdefault((option, workers, size), []).append(wall(top / size, out, option, workers))
    print(f"{given.decks} decks, median of {given.repeats}; load {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores")
    for option in OPTIONS:
        start, whole = ([median(spent[option, n, size]) for n in (1, 2)] for size in ("one", "many"))
        bare = (whole[0] - start[0]) / (whole[1] - start[1])
        print(
            f"{option:<9} one {whole[0]:6.1f} s, two {whole[1]:6.1f} s; start-up {start[0]:.1f} and {start[1]:.1f} s; "
            f"two are {whole[0] / whole[1]:.2f} times one, {bare:.2f} without start-up"
        )


if __name__ == "__main__":
    main()
