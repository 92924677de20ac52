"""The command: truths by OpenSees, decks, diagnoses, a table."""

import argparse
import json
import tempfile
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind.diagnose import diagnosed
from benchmarks.blind_records.chain import LAWS, SPLITS, Chain, chains, generator
from benchmarks.blind_records.decks import UNITS, Setup, answer, write
from benchmarks.blind_records.verify import verify

ANY = "any"
RIGHT, WRONG, ABSTAINED, MISSED = OUTCOMES = ("right", "wrong", "abstained", "missed")


def main() -> None:
    """Parse the options and print the table."""
    given = _options().parse_args()
    if given.verify:
        print(verify())
        return
    folder = given.output or Path(tempfile.mkdtemp(prefix="blind-records-"))
    for name in ("truths", "decks", "answers", "found"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    cases = [one for one in chains(given.split, given.seed, given.count, given.controls) if given.only in one.name]
    with ProcessPoolExecutor(given.jobs) as pool:
        setup = Setup(given.half, given.noise, given.undamped)
        paths = list(pool.map(partial(_made, folder=folder, setup=setup, quantity=given.quantity), cases))
        print(
            f"{len(cases)} decks in {folder}, {given.split} split, seed {given.seed}, {given.quantity}, {setup}",
            flush=True,
        )
        results = []
        for case, (known, found) in zip(cases, pool.map(judged, paths), strict=True):
            results.append((case, *outcome(known, found), found["seconds"]))
            print(f"  {case.name:36} {results[-1][1]:10} {results[-1][2]}  {found['seconds']:.0f} s", flush=True)
    print(table(results, LAWS, lambda case: case.law, "all laws"))


def _made(case: Chain, folder: Path, setup: Setup, quantity: str) -> tuple[Path, Path, Path]:
    """Truth, deck and answer of a case; a truth once made is kept."""
    from benchmarks.blind_records.opensees import motions

    if quantity == ANY:
        quantity = str(generator(case.name, "quantity").choice(list(UNITS)))
    kept = folder / "truths" / f"{case.name}-{quantity}.npy"
    if not kept.exists():
        np.save(kept, motions(case, quantity))
    path = write(folder / "decks", case, np.load(kept), setup, quantity)
    known = folder / "answers" / f"{path.stem}.json"
    known.write_text(json.dumps(answer(case)))
    return path, known, folder / "found" / f"{path.stem}.json"


def judged(paths: tuple[Path, Path, Path]) -> tuple[dict, dict]:
    """Of deck, answer and finding: the answer, and what `mouse diagnose --json` says of the deck, which is kept."""
    deck, known, finding = paths
    found = diagnosed(deck)
    finding.write_text(json.dumps(found))
    return json.loads(known.read_text()), found


def outcome(known: dict, found: dict) -> tuple[str, str]:
    """right, wrong, abstained or missed; and what was said."""
    if "refused" in found:
        return MISSED, found["refused"].strip().splitlines()[-1]
    verdict = found["verdict"]
    kind, physics = verdict["kind"], verdict["physics"]
    ids = [int(i) for i in (verdict["site"] or {"ids": []})["ids"]]
    said = f"{kind} {physics or ''} {ids or ''}".strip()
    if known["physics"] is None:
        return (RIGHT if kind == "nothing-missing" else WRONG if kind == "named" else ABSTAINED), said
    if kind == "named":
        return (RIGHT if (physics, ids) == (known["physics"], known["ids"]) else WRONG), said
    return (MISSED if kind == "nothing-missing" else ABSTAINED), said


def table(results: list[tuple], kinds: Iterable[str], of: Callable[[Any], str], every: str) -> str:
    """Outcomes by kind of a case, `of` it, controls as `none`, and of all that are no controls; processor seconds."""
    row = lambda title, some: (
        f"{title:20}" + "".join(f"{[one[1] for one in some].count(name):>11}" for name in OUTCOMES)
    )
    lines = [f"{'truth':20}" + "".join(f"{name:>11}" for name in OUTCOMES)]
    for kind in (*kinds, "none"):
        own = [one for one in results if of(one[0]) == kind]
        lines += [row(kind, own)] if own else []
    faults = [one for one in results if of(one[0]) != "none"]
    seconds = [one[3] for one in results]
    lines.append(row(every, faults) + f"   of {len(faults)}")
    lines.append(f"processor seconds for a diagnosis: median {np.median(seconds):.1f}, largest {max(seconds):.1f}")
    return "\n".join(lines)


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind_records", description="The blind benchmark of records."
    )
    add = parser.add_argument
    add("--verify", action="store_true", help="print how OpenSees does on closed forms, and stop")
    add("--seed", type=int, default=1, help="structures, laws and noise")
    add("--split", choices=SPLITS, default="development", help="structures used while developing, or others")
    add("--count", type=int, default=6, help="structures of each law")
    add("--controls", type=int, default=30, help="structures without a law")
    add("--half", action="store_true", help="half of the sensors")
    add("--noise", type=float, default=0.01, help="of each sensor, by its rms")
    add("--undamped", action="store_true", help="decks without damping")
    add(
        "--quantity",
        choices=(*UNITS, ANY),
        default="acceleration",
        help=f"what sensors read; {ANY}: drawn for each deck",
    )
    add("--only", default="", help="cases whose names hold this")
    add("--jobs", type=int, default=1, help="processes")
    add("--output", type=Path, help="folder of truths, decks and answers; else a temporary one")
    return parser


if __name__ == "__main__":
    main()
