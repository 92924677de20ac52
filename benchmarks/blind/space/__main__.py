"""The command: truths by OpenSees, decks, diagnoses, tables."""

import argparse
import os
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from fnmatch import fnmatch
from pathlib import Path

from benchmarks.blind.__main__ import HOME, again, report
from benchmarks.blind.calculix import cached
from benchmarks.blind.case import SPLITS, Case
from benchmarks.blind.decks import answer, deliver
from benchmarks.blind.diagnose import diagnosed
from benchmarks.blind.space.families import families
from benchmarks.blind.space.verify import verify
from benchmarks.blind.test_data import measured


def main() -> None:
    """Parse the options and print the tables."""
    given = _options().parse_args()
    if given.verify or given.tables:
        print(verify() if given.verify else again(given.tables))
        return
    chosen = {name: make for name, make in families().items() if not given.family or name in given.family}
    cases = [case for make in chosen.values() for case in make(given.split, given.seed, given.count)]
    cases = [case for case in cases if not given.cases or any(fnmatch(case.name, p) for p in given.cases)]
    folder = given.output or Path(tempfile.mkdtemp(prefix="blind-space-"))
    with ProcessPoolExecutor(given.jobs) as pool:
        start = time.perf_counter()
        made = list(
            pool.map(written, cases, [folder] * len(cases), [given.seed] * len(cases), [given.cache] * len(cases))
        )
        print(f"{len(cases)} structures, {given.split} split, seed {given.seed}: {time.perf_counter() - start:.0f} s")
        found = iter(()) if given.decks_only else pool.map(diagnosed, [path for path, _ in made])
        report(folder, " ".join(chosen), made, found)


def written(case: Case, folder: Path, seed: int, cache: Path) -> tuple[Path, dict]:
    """The deck of a case in `folder`/decks, and its answer, which is in `folder`/answers."""
    truth, words = cached(cache, case.inputs, case.make), (case.name, seed)
    test = measured(case, truth, case.config, words)
    return deliver(folder, case, test, case.config, answer(case, truth, words))


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind.space", description="Blind cases of space frames and storey buildings."
    )
    add = parser.add_argument
    add("--verify", action="store_true", help="print how OpenSees does on closed forms, and stop")
    add("--seed", type=int, default=1, help="structures and noise")
    add("--split", choices=SPLITS, default="development", help="structures used while developing, or others")
    add("--family", nargs="+", choices=families(), default=[], help="families of cases; none: all")
    add("--cases", nargs="+", default=[], help="names of cases, * for any: space-member-*")
    add("--count", type=int, default=20, help="structures of each family")
    add("--jobs", type=int, default=os.cpu_count(), help="processes")
    add("--cache", type=Path, default=HOME, help="folder of truths already made")
    add("--output", type=Path, help="folder of decks and answers; else a temporary one")
    add("--tables", type=Path, metavar="FOLDER", help="print the tables of the answers in FOLDER, and stop")
    add("--decks-only", action="store_true", help="make truths and decks, diagnose nothing")
    return parser


if __name__ == "__main__":
    main()
