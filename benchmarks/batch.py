"""Batches of small decks: what a job costs beside the engine's own work on the same decks, and whether memory grows.

    python benchmarks/batch.py [DECKS] [--jobs N]

The engine's own: reading, running and the JSON document of every deck in one process that has all modules loaded. Of the batch:
processor seconds of all its processes, start-up included and left out; other work on the machine matters less to these.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

import argparse
import json
import random
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CHAIN = (Path(__file__).parents[1] / "decks" / "table_5_2.yaml").read_text()
_ENGINE = """
import json, resource, sys, time
from glob import glob
from mouse_cli.formats import read_deck
from mouse_cli.report import document
from mouse_cli.updating import run
paths = sorted(glob(sys.argv[1] + "/*"))
json.dumps(document(run(read_deck(paths[0]))))
begun, wall = time.process_time(), time.perf_counter()
for path in paths:
    json.dumps(document(run(read_deck(path))))
print(time.process_time() - begun, time.perf_counter() - wall)
"""


def decks(folder: Path, count: int) -> None:
    """Four-mass chains of Table 5-2, each begun from other stiffnesses."""
    lot = random.Random(0)
    folder.mkdir()
    for i in range(count):
        text = CHAIN.replace("250000.0", f"{2.5e5 * lot.uniform(0.97, 1.03):.6e}", 1)
        (folder / f"chain{i:05}.yaml").write_text(text + f"# {i}\n")


def engine(folder: Path) -> tuple[float, float]:
    """Processor and wall seconds of the engine."""
    done = subprocess.run([sys.executable, "-c", _ENGINE, str(folder)], capture_output=True, text=True, check=True)
    cpu, wall = map(float, done.stdout.split())
    return cpu, wall


def batch(folder: Path, out: Path, jobs: int) -> tuple[float, float, float]:
    """Processor and wall seconds of a batch, all its processes together, and the largest memory of one of them in MB."""
    command = [sys.executable, "-m", "mouse_cli", "batch", str(folder), "-o", str(out), "-j", str(jobs), "-q"]
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.perf_counter() - begun, after.ru_maxrss / 1024


def main() -> None:
    """Prints the figures."""
    asked = argparse.ArgumentParser()
    asked.add_argument("decks", nargs="?", type=int, default=1000)
    asked.add_argument("--jobs", type=int, default=1)
    given = asked.parse_args()
    with tempfile.TemporaryDirectory() as place:
        top = Path(place)
        few = max(1, given.decks // 10)
        decks(top / "one", 1)
        decks(top / "few", few)
        decks(top / "many", given.decks)
        start, _, small = batch(top / "one", top / "one_out", given.jobs)
        _, _, middle = batch(top / "few", top / "few_out", given.jobs)
        cpu, wall, large = batch(top / "many", top / "many_out", given.jobs)
        own, own_wall = engine(top / "many")
        resumed, resumed_wall, _ = batch(top / "many", top / "many_out", given.jobs)
        written = [json.loads(path.read_text())["exit_code"] for path in (top / "many_out").glob("*.json")]
    per = 1e3 / given.decks
    print(f"{given.decks} decks, --jobs {given.jobs}, {written.count(0)} trusted; load {os.getloadavg()[0]:.1f}")
    print(f"engine alone      {own * per:6.2f} ms of processor a deck, {own_wall * per:6.2f} ms of wall")
    print(
        f"batch             {cpu * per:6.2f} ms of processor a deck, {wall * per:6.2f} ms of wall; start-up {start:.2f} s"
    )
    bare, all_in = (100 * (spent - own) / own for spent in (cpu - start, cpu))
    print(f"overhead          {bare:5.0f} % without start-up, {all_in:.0f} % with it (aim: 30 %)")
    print(
        f"gone on with      {resumed * per:6.2f} ms of processor a deck, {resumed_wall * per:6.2f} ms of wall; nothing to run"
    )
    print(f"largest process   {small:.0f} MB for 1 deck, {middle:.0f} MB for {few}, {large:.0f} MB for {given.decks}")


if __name__ == "__main__":
    main()
