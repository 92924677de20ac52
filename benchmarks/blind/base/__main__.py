"""The command: truths by OpenSees, decks, diagnoses, a table."""

import argparse
import json
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from benchmarks.blind.base.decks import answer, write
from benchmarks.blind.base.storeys import KINDS, RUNS, Storeys, buildings
from benchmarks.blind_records.__main__ import judged, outcome, table


def main() -> None:
    """Parse the options and print the table."""
    given = _options().parse_args()
    folder = given.output or Path(tempfile.mkdtemp(prefix="blind-base-"))
    for name in ("truths", "decks", "answers", "found"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    cases = [one for one in buildings(given.seed, given.count, given.controls) if given.only in one.name]
    print(f"{len(cases)} decks in {folder}, seed {given.seed}", flush=True)
    results = []
    with ProcessPoolExecutor(given.jobs) as pool:
        paths = list(pool.map(_made, cases, [folder] * len(cases)))
        for case, (known, found) in zip(cases, pool.map(judged, paths), strict=True):
            results.append((case, *outcome(known, found), found["seconds"]))
            print(f"  {case.name:28} {results[-1][1]:10} {results[-1][2]}  {found['seconds']:.0f} s", flush=True)
    print(table(results, KINDS, lambda case: case.kind, "all mechanisms"))


def _made(case: Storeys, folder: Path) -> tuple[Path, Path, Path]:
    """Deck, answer and finding of a case; a truth once made is kept."""
    from benchmarks.blind.base.opensees import motions

    kept = folder / "truths" / f"{case.name}.npz"
    if not kept.exists():
        runs = [motions(case, run) for run in range(RUNS)]
        np.savez(kept, table=[one for one, _ in runs], floors=[one for _, one in runs])
    held = np.load(kept)
    path = write(folder / "decks", case, list(zip(held["table"], held["floors"], strict=True)))
    known = folder / "answers" / f"{path.stem}.json"
    known.write_text(json.dumps(answer(case)))
    return path, known, folder / "found" / f"{path.stem}.json"


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind.base", description="The blind benchmark of base excitation."
    )
    add = parser.add_argument
    add("--seed", type=int, default=1, help="structures, mechanisms and noise")
    add("--count", type=int, default=5, help="structures of each kind")
    add("--controls", type=int, default=10, help="structures without a mechanism")
    add("--only", default="", help="cases whose names hold this")
    add("--jobs", type=int, default=1, help="processes")
    add("--output", type=Path, help="folder of truths, decks and answers; else a temporary one")
    return parser


if __name__ == "__main__":
    main()
