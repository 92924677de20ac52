"""A batch killed by SIGKILL at random moments, again and again, against one that was never broken off.

    python benchmarks/batch_kills.py [--kills 200] [--decks 1000] [--jobs 2]

Counts: kills, answers that were written again though they were there, answers that differ from those of the unbroken batch.
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

from batch import decks

os.environ["OPENBLAS_NUM_THREADS"] = "1"


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


def main() -> None:
    """Prints the counts."""
    asked = argparse.ArgumentParser()
    asked.add_argument("--kills", type=int, default=200)
    asked.add_argument("--decks", type=int, default=1000)
    asked.add_argument("--jobs", type=int, default=2)
    given = asked.parse_args()
    lot = random.Random(0)
    with tempfile.TemporaryDirectory() as place:
        top = Path(place)
        decks(top / "decks", given.decks)
        command = [sys.executable, "-m", "mouse_cli", "batch", str(top / "decks"), "-q", "-j", str(given.jobs), "-o"]
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
        f"{kills} kills of a batch of {given.decks} decks, {early} at its start; {len(before)} answers there at the last"
    )
    print(
        f"written again: {again}; other than unbroken: {differ} of {len(other)}; exit {last} and {whole}; left: {rest}"
    )


if __name__ == "__main__":
    main()
