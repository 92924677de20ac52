"""Batches, campaigns and samples killed by SIGKILL at random moments, again and again, against some never broken off.

    python benchmarks/batch_kills.py [batch|sweep|bootstrap|sample] [--kills 200] [--decks 1000] [--jobs 2]

Counts: kills, answers that were written again though they were there, answers that differ from those of the unbroken one; of
samples: chains and answers that differ, of as many walks as it takes.
"""

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from batch import decks

os.environ["OPENBLAS_NUM_THREADS"] = "1"
ROOT = Path(__file__).resolve().parents[1]


def answers(folder: Path) -> dict[str, dict]:
    """What the answers say, but for the seconds that they took."""
    found = {path.name: json.loads(path.read_text()) for path in folder.glob("*.json")}
    for one in found.values():
        del one["seconds"]
    return found


def written(folder: Path) -> dict[str, tuple[int, int]]:
    """Which file each answer is, and when it was written."""
    if not folder.exists():
        return {}
    there = [entry for entry in os.scandir(folder) if entry.name.endswith(".json")]
    return {entry.name: (entry.inode(), entry.stat().st_mtime_ns) for entry in there}


def killed(command: list[str], folder: Path, more: int, delay: float) -> bool:
    """Whether a batch was killed, `delay` seconds after it had written `more` answers, before it came to its end."""
    aim = len(written(folder)) + more
    going = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while len(written(folder)) < aim and going.poll() is None:
        time.sleep(0.003)
    time.sleep(delay)
    over = going.poll() is not None
    going.kill()
    going.wait()
    return not over


def work(kind: str, top: Path, size: int, jobs: int) -> list[str]:
    """The command line of `size` jobs, but for the folder of their answers."""
    if kind == "batch":
        decks(top / "decks", size)
        asked = [str(top / "decks")]
    else:
        one = ROOT / "decks" / ("sound_chain.yaml" if kind == "sweep" else "four_storey_frame.yaml")
        asked = [
            str(one),
            *(("--replicates", str(size)) if kind == "bootstrap" else ("--vary", "confidence=90,95,99")),
        ]
        asked += ["--vary", f"k1.sd=1e3:1e5:{size // 3}"] if kind == "sweep" else []
    return [sys.executable, "-m", "mouse_cli", kind, *asked, "-q", "-j", str(jobs), "-o"]


def many(kind: str, given: argparse.Namespace, top: Path, lot: random.Random) -> None:
    """Prints the counts of a batch or a campaign."""
    command = work(kind, top, given.decks, given.jobs)
    whole = subprocess.run([*command, str(top / "whole")], stdout=subprocess.DEVNULL, check=False).returncode
    broken, before = top / "broken", {}
    kills = again = early = 0
    while kills < given.kills:
        left = given.decks - len(before)
        share = left / (given.kills - kills)
        start = lot.random() < 0.25  # a quarter while the processes are still starting, or before
        more, delay = (0, lot.uniform(0, 0.6)) if start else (lot.randint(0, round(share)), lot.uniform(0, 0.02))
        done = killed([*command, str(broken)], broken, more, delay)
        now = written(broken)
        again += sum(now.get(name) != mark for name, mark in before.items())
        kills, before, early = kills + done, now, early + start * done
        if not done:
            break
    last = subprocess.run([*command, str(broken)], stdout=subprocess.DEVNULL, check=False).returncode
    again += sum(written(broken).get(name) != mark for name, mark in before.items())
    one, other = answers(broken), answers(top / "whole")
    differ = len(one.keys() ^ other.keys()) + sum(one[name] != other[name] for name in one.keys() & other.keys())
    rest = [path.name for path in broken.iterdir() if path.suffix != ".json"]
    print(
        f"{kills} kills of a {kind} of {len(other)} jobs, {early} at its start; {len(before)} answers there at the last"
    )
    print(
        f"written again: {again}; other than unbroken: {differ} of {len(other)}; exit {last} and {whole}; left: {rest}"
    )


def samples(given: argparse.Namespace, top: Path, lot: random.Random) -> None:
    """Prints the counts of walks that go on from what is kept of them."""
    command = [sys.executable, "-m", "mouse_cli", "sample", str(ROOT / "decks" / "twin_springs.yaml"), "--json", "-q"]
    begun = time.monotonic()
    whole = walked(command, top / "whole")
    lasts = time.monotonic() - begun
    kills = walks = differ = resumed = 0
    while kills < given.kills:
        chain = top / f"broken{walks}"
        while kills < given.kills:
            going = subprocess.Popen(
                [*command, "--chain", str(chain)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
            )
            time.sleep(lot.uniform(0.3, 1.0) * lasts)
            over = going.poll() is not None
            going.kill()
            going.wait()
            kills += not over
            resumed += Path(f"{chain}.npz.part").exists()
            if over:
                break
        differ += walked(command, chain) != whole
        walks += 1
    print(f"{kills} kills of {walks} walks, {resumed} with a chain to go on from; other than unbroken: {differ}")


def walked(command: list[str], chain: Path) -> tuple[str, bytes]:
    """The answer of a walk that comes to its end, but for the name of its chain, and the chain."""
    said = subprocess.run([*command, "--chain", str(chain)], capture_output=True, text=True, check=False).stdout
    held = Path(f"{chain}.npz")
    with np.load(held) as arrays:
        return said.replace(str(held), ""), b"".join(arrays[name].tobytes() for name in sorted(arrays.files))


def main() -> None:
    """Prints the counts."""
    asked = argparse.ArgumentParser()
    asked.add_argument("kind", nargs="?", choices=("batch", "sweep", "bootstrap", "sample"), default="batch")
    asked.add_argument("--kills", type=int, default=200)
    asked.add_argument("--decks", type=int, default=1000, help="or points, or replicates")
    asked.add_argument("--jobs", type=int, default=2)
    given = asked.parse_args()
    lot = random.Random(0)
    with tempfile.TemporaryDirectory() as place:
        if given.kind == "sample":
            samples(given, Path(place), lot)
        else:
            many(given.kind, given, Path(place), lot)


if __name__ == "__main__":
    main()
