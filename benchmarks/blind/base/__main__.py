"""The command: truths by OpenSees, decks, diagnoses, a table."""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from benchmarks.blind.base.decks import answer, write
from benchmarks.blind.base.storeys import KINDS, Storeys, buildings
from benchmarks.blind_records.__main__ import OUTCOMES, outcome

_RUNS = 2


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
        for case, (known, found) in zip(cases, pool.map(_judged, paths), strict=True):
            results.append((case, *outcome(known, found), found["seconds"]))
            print(f"  {case.name:28} {results[-1][1]:10} {results[-1][2]}  {found['seconds']:.0f} s", flush=True)
    print(tabled(results))


def _made(case: Storeys, folder: Path) -> tuple[Path, Path, Path]:
    """Deck, answer and finding of a case; a truth once made is kept."""
    from benchmarks.blind.base.opensees import motions

    kept = folder / "truths" / f"{case.name}.npz"
    if not kept.exists():
        runs = [motions(case, run) for run in range(_RUNS)]
        np.savez(kept, table=[one for one, _ in runs], floors=[one for _, one in runs])
    held = np.load(kept)
    path = write(folder / "decks", case, list(zip(held["table"], held["floors"], strict=True)))
    known = folder / "answers" / f"{path.stem}.json"
    known.write_text(json.dumps(answer(case)))
    return path, known, folder / "found" / f"{path.stem}.json"


def _judged(paths: tuple[Path, Path, Path]) -> tuple[dict, dict]:
    deck, known, told = paths
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "mouse_cli", "diagnose", str(deck), "--json", "-q"]
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = json.loads(done.stdout) if done.returncode in (0, 1) else {"refused": done.stderr}
    found["seconds"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    told.write_text(json.dumps(found))
    return json.loads(known.read_text()), found


def tabled(results: list[tuple]) -> str:
    """Outcomes by kind; processor seconds."""
    lines = [f"{'truth':20}" + "".join(f"{name:>11}" for name in OUTCOMES)]
    for kind in (*KINDS, "none"):
        count = Counter(one[1] for one in results if one[0].kind == kind)
        if count:
            lines.append(f"{kind:20}" + "".join(f"{count[name]:>11}" for name in OUTCOMES))
    faults = [one for one in results if one[0].kind != "none"]
    count = Counter(one[1] for one in faults)
    lines.append(f"{'all mechanisms':20}" + "".join(f"{count[name]:>11}" for name in OUTCOMES) + f"   of {len(faults)}")
    seconds = [one[3] for one in results]
    lines.append(f"processor seconds for a diagnosis: median {np.median(seconds):.1f}, largest {max(seconds):.1f}")
    return "\n".join(lines)


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
