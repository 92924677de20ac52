"""The command: truths, decks, diagnoses, tables."""

import argparse
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from fnmatch import fnmatch
from itertools import chain
from pathlib import Path

from benchmarks.blind import beams, chains, cracks, frames, plate
from benchmarks.blind.calculix import cached
from benchmarks.blind.case import SPLITS, Case
from benchmarks.blind.decks import answer, deliver
from benchmarks.blind.diagnose import diagnosed
from benchmarks.blind.scoring import scored, tables
from benchmarks.blind.test_data import CONFIGS, MISSTATED, measured
from benchmarks.blind.verify import verify

FAMILIES = {
    "beam": beams.cases,
    "chain": chains.cases,
    "frame": frames.cases,
    "plate": plate.cases,
    "crack": cracks.cases,
}
HOME = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "mouse-blind-truths"


def main() -> None:
    """Parse the options and print the tables."""
    given = _options().parse_args()
    if given.verify or given.tables:
        print(verify() if given.verify else again(given.tables))
        return
    cases = selected(given.split, given.seed, given.count, given.cases)
    with ProcessPoolExecutor(given.jobs) as pool:
        start = time.perf_counter()
        truths = list(pool.map(_truth, cases, [given.cache] * len(cases)))
        print(f"{len(cases)} structures, {given.split} split, seed {given.seed}: {time.perf_counter() - start:.0f} s")
        folder = given.output or Path(tempfile.mkdtemp(prefix="blind-"))
        for config in given.config:
            for misstated in given.misstated or [""]:
                made = decks(folder, cases, truths, config, misstated, given.seed)
                found = iter(()) if given.decks_only else pool.map(diagnosed, [path for path, _ in made])
                report(folder, f"{config} {misstated}".strip(), made, found)


def selected(split: str, seed: int, count: int, patterns: list[str]) -> list[Case]:
    """The cases of all families whose names match one of `patterns`, such as `beam-crack-*`; all without any."""
    every: Iterator[Case] = chain.from_iterable(make(split, seed, count) for make in FAMILIES.values())
    return [case for case in every if not patterns or any(fnmatch(case.name, p) for p in patterns)]


def decks(
    folder: Path, cases: list[Case], truths: list[dict], config: str, misstated: str, seed: int
) -> list[tuple[Path, dict]]:
    """Decks written to `folder`/decks, answers to `folder`/answers, and both by deck."""
    made = []
    for case, truth in zip(cases, truths, strict=True):
        for draw in range(case.draws):
            words = (config, misstated, seed, draw)
            test = measured(case, truth, CONFIGS[config], words, misstated)
            made.append(deliver(folder, case, test, CONFIGS[config], answer(case, truth, words)))
    return made


def report(folder: Path, title: str, made: list[tuple[Path, dict]], found: Iterator[dict]) -> None:
    """The tables of one configuration. What the tool said goes beside the answers as it comes, a line each to standard error."""
    print(f"\n== {title}: {len(made)} decks in {folder / 'decks'}", flush=True)
    (folder / "found").mkdir(exist_ok=True)
    results = []
    for (path, known), document in zip(made, found, strict=False):
        (folder / "found" / f"{path.stem}.json").write_text(json.dumps(document))
        results.append(scored(known, document))
        why = document.get("refused", results[-1].said).splitlines() or [""]
        print(f"{path.stem} {known['name']}: {results[-1].outcome}, {why[-1]}", file=sys.stderr, flush=True)
    if results:
        print(tables(results), flush=True)


def again(folder: Path) -> str:
    """The tables of what an earlier run, even one cut short, left in `folder`; all its configurations together."""
    read = lambda path: json.loads(path.read_text())
    return tables(
        [scored(read(folder / "answers" / path.name), read(path)) for path in sorted((folder / "found").iterdir())]
    )


def _truth(case: Case, cache: Path) -> dict:
    return cached(cache, case.inputs, case.make)


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind", description="The blind benchmark of mouse diagnose."
    )
    add: Callable = parser.add_argument
    add("--verify", action="store_true", help="print how the truth solver does on closed forms, and stop")
    add("--seed", type=int, default=1, help="structures and noise")
    add("--split", choices=SPLITS, default="development", help="structures used while developing, or others")
    add("--config", nargs="+", choices=CONFIGS, default=["A"], help="sensors and noise")
    add("--misstated", nargs="+", choices=MISSTATED, default=[], help="errors of the test that the deck does not state")
    add("--cases", nargs="+", default=[], help="names of cases, * for any: beam-crack-*, chain-*")
    add("--count", type=int, default=16, help="structures of each cause")
    add("--jobs", type=int, default=os.cpu_count(), help="processes")
    add("--cache", type=Path, default=HOME, help="folder of truths already made")
    add("--output", type=Path, help="folder of decks and answers; else a temporary one")
    add(
        "--tables",
        type=Path,
        metavar="FOLDER",
        help="print the tables of the answers in FOLDER, an earlier --output, and stop",
    )
    add("--decks-only", action="store_true", help="make truths and decks, diagnose nothing")
    return parser


if __name__ == "__main__":
    main()
