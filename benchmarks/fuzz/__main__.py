"""Command line: damaged inputs through every command, counted, resumable; the first input of every fault is kept.

python -m benchmarks.fuzz --inputs 1000 --out fuzz           1000 inputs for each command, 100 to 200 of those that take long
python -m benchmarks.fuzz --commands run,check --seed 7
python -m benchmarks.fuzz --again run:123 --out fuzz         one input anew, in a folder of its own
"""

import argparse
import gc
import importlib
import json
import os
import pkgutil
import random
import re
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import asdict
from itertools import takewhile
from pathlib import Path

from benchmarks.fuzz.commands import COMMANDS, arguments
from benchmarks.fuzz.mutate import damaged
from benchmarks.fuzz.play import Limits, Outcome, chained, play
from benchmarks.fuzz.seeds import Seed, seeds

_CHAIN = 50  # inputs of one child


def main(given: list[str] | None = None) -> int:
    """Print the counts; 0: no faults, 1: some."""
    options = _options(given)
    with tempfile.TemporaryDirectory() as scratch:
        sound = seeds(Path(scratch))
    _warm()
    if options.again:
        command, _, index = options.again.partition(":")
        return _again(command, int(index), options, sound)
    total = sum(_share(options, command) for command in options.commands)
    print(f"seed {options.seed}, {total} inputs of {len(options.commands)} commands", flush=True)
    options.out.mkdir(parents=True, exist_ok=True)
    children = [_worker(k, options, sound) for k in range(options.jobs)]
    broken = sum(os.waitpid(child, 0)[1] != 0 for child in children)
    return _summary(options) or int(broken > 0)


def _options(given: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.fuzz", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--commands", type=lambda text: text.split(","), default=list(COMMANDS), help=", ".join(COMMANDS)
    )
    parser.add_argument(
        "--inputs", type=int, default=100, help="for each command (100), fewer for those that take long"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--out", type=Path, default=Path("fuzz"), help="log and faults (fuzz); what is there is not done again"
    )
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--cpu", type=float, default=10.0, help="seconds that an input may take (10)")
    parser.add_argument("--memory", type=float, default=1000.0, help="MB that an input may take (1000)")
    parser.add_argument("--again", metavar="COMMAND:INDEX", help="play one input anew and print what it says")
    options = parser.parse_args(given)
    if unknown := set(options.commands) - set(COMMANDS):
        parser.error(f"no such command: {', '.join(sorted(unknown))}")
    return options


def _warm() -> None:
    """What the children would else load, each of them; kept out of the reach of collections, which would copy its pages."""
    import matplotlib.figure
    import scipy.optimize
    import scipy.sparse.linalg
    import scipy.stats

    import mouse_cli

    for module in pkgutil.walk_packages(mouse_cli.__path__, "mouse_cli."):
        if not module.name.endswith("__main__"):
            with suppress(ImportError):  # of an optional library
                importlib.import_module(module.name)
    assert scipy.stats and scipy.optimize and scipy.sparse.linalg and matplotlib.figure
    gc.freeze()


def _worker(number: int, options: argparse.Namespace, sound: list[Seed]) -> int:
    sys.stdout.flush()
    if pid := os.fork():
        return pid
    code = 1
    try:
        _work(number, options, sound)
        code = 0
    finally:
        sys.stderr.flush()
        os._exit(code)


def _work(number: int, options: argparse.Namespace, sound: list[Seed]) -> None:
    done = {(row["command"], row["index"]) for row in _rows(options)}
    limits = Limits(options.cpu, options.memory)
    left = [
        (command, index)
        for index in range(number, options.inputs, options.jobs)
        for command in options.commands
        if (command, index) not in done and index < _share(options, command)
    ]
    left.sort(key=lambda job: job[1] / _share(options, job[0]))
    with open(options.out / f"log-{options.seed}-{number}.jsonl", "a", buffering=1) as log:
        make = lambda job, folder: made(*job, options.seed, sound, folder)
        while left:
            cheap = list(takewhile(lambda job: COMMANDS[job[0]].cost == 1, left[:_CHAIN]))
            for outcome in chained(cheap, make, limits) if cheap else ():
                log.write(_row(*left.pop(0), outcome))
            if left:
                command, index = left.pop(0)
                log.write(_row(command, index, _alone(command, index, options, sound, limits)))


def _alone(command: str, index: int, options: argparse.Namespace, sound: list[Seed], limits: Limits) -> Outcome:
    with tempfile.TemporaryDirectory(prefix="fuzz") as folder:
        words = made(command, index, options.seed, sound, Path(folder))
        outcome = play(words, Path(folder), limits)
        if outcome.fault:
            _kept(options.out, command, index, words, outcome, Path(folder))
        return outcome


def _row(command: str, index: int, outcome: Outcome) -> str:
    return json.dumps({"command": command, "index": index, **asdict(outcome)}) + "\n"


def _share(options: argparse.Namespace, command: str) -> int:
    """How many inputs a command is given."""
    return max(1, options.inputs // COMMANDS[command].cost)


def made(command: str, index: int, seed: int, sound: list[Seed], folder: Path) -> list[str]:
    """Input number `index` of a command, written to `folder/in`, and the words of its command line."""
    rng = random.Random(f"{seed}/{command}/{index}")
    (folder / "in").mkdir()
    kinds = COMMANDS[command].kinds
    if not kinds:
        return arguments(rng, command, "")
    kind = rng.choice(kinds)
    chosen = rng.choice([one for one in sound if one.kind == kind])
    struck = chosen.main if rng.random() < 0.7 else rng.choice(list(chosen.files))
    others = list(rng.choice([one for one in sound if one.kind == kind]).files.values())
    for name, raw in chosen.files.items():
        path = folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(damaged(rng, name, raw, others) if name == struck else raw)
    return arguments(rng, command, chosen.main)


def _kept(out: Path, command: str, index: int, words: list[str], outcome: Outcome, folder: Path) -> None:
    """The first input of each fault, with what was said of it."""
    place = re.sub(r"[^A-Za-z0-9_.]+", "-", re.sub(r":? .*(?<=at )|: .*", "", outcome.place))[:60]
    kept = out / "faults" / f"{outcome.fault}-{command}-{place}"
    if not kept.exists():
        shutil.copytree(folder, kept, ignore_dangling_symlinks=True)
        (kept / "what.txt").write_text(f"{command}:{index}\nmouse {' '.join(words)}\n{outcome}\n", errors="replace")


def _again(command: str, index: int, options: argparse.Namespace, sound: list[Seed]) -> int:
    folder = options.out / f"again-{command}-{index}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    words = made(command, index, options.seed, sound, folder)
    outcome = play(words, folder.resolve(), Limits(options.cpu, options.memory))
    print(f"in {folder}: mouse {' '.join(words)}\n{(folder / 'stderr').read_text(errors='replace')}{outcome}")
    return int(bool(outcome.fault))


def _rows(options: argparse.Namespace) -> Iterator[dict]:
    for path in options.out.glob(f"log-{options.seed}-*.jsonl"):
        for line in path.read_text().splitlines():
            if line.endswith("}"):
                yield json.loads(line)


def _summary(options: argparse.Namespace) -> int:
    rows = [
        row
        for row in _rows(options)
        if row["command"] in options.commands and row["index"] < _share(options, row["command"])
    ]
    print(f"{'command':<10}{'inputs':>8}{'faults':>8}{'most s':>8}{'most MB':>9}  exit codes")
    for command in options.commands:
        own = [row for row in rows if row["command"] == command]
        codes = ", ".join(f"{code}: {count}" for code, count in sorted(Counter(row["exit"] for row in own).items()))
        top = [max((row[key] for row in own), default=0) for key in ("cpu", "memory")]
        print(
            f"{command:<10}{len(own):>8}{sum(bool(row['fault']) for row in own):>8}{top[0]:>8.1f}{top[1]:>9.0f}  {codes}"
        )
    found = Counter((row["fault"], row["command"], row["place"]) for row in rows if row["fault"])
    for (fault, command, place), count in found.most_common():
        first = next(
            row["index"] for row in rows if (row["fault"], row["command"], row["place"]) == (fault, command, place)
        )
        print(f"{count:5} {fault} {command}:{first} {place}")
    print(f"{len(rows)} inputs, {sum(found.values())} faults, {time.process_time():.0f} s in the parent")
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main())
