"""The command: truths, decks, diagnoses, tables."""

import argparse
import json
import os
import sys
import tempfile
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor
from fnmatch import fnmatch
from pathlib import Path

import numpy as np

from benchmarks.blind.case import SPLITS
from benchmarks.blind.diagnose import diagnosed
from benchmarks.blind_frf import portals
from benchmarks.blind_frf.cases import cases
from benchmarks.blind_frf.decks import write
from benchmarks.blind_frf.verify import verify

NEAR = 0.05  # of the span
OUTCOMES = ("right", "wrong", "abstained", "missed", "refused")


def main() -> None:
    """Parse the options and print the tables."""
    given = _options().parse_args()
    if given.verify:
        print("\n".join(f"{error:9.1e}  {what}" for what, error in verify().items()))
        return
    folder = given.output or Path(tempfile.mkdtemp(prefix="blind-frf-"))
    chosen = [
        case
        for case in cases(given.split, given.seed, given.count)
        if not given.cases or any(fnmatch(case.name, pattern) for pattern in given.cases)
    ]
    folder.mkdir(parents=True, exist_ok=True)
    made = [write(folder, case, (given.seed, draw)) for case in chosen for draw in range(case.draws)]
    if given.portals:
        made = [portals.write(folder, given.seed, number) for number in range(given.count)]
    print(f"{len(made)} decks in {folder}, {given.split} split, seed {given.seed}", flush=True)
    with ProcessPoolExecutor(given.jobs) as pool:
        results = []
        for (path, known), found in zip(made, pool.map(diagnosed, [path for path, _ in made]), strict=True):
            path.with_suffix(".json").write_text(json.dumps({"answer": known, "found": found}))
            results.append(scored(known, found))
            print(f"{path.stem} {known['name']}: {results[-1]}", file=sys.stderr, flush=True)
    print(tables(results))


def scored(known: dict, found: dict) -> dict:
    """outcome, what was said, error of the place by span, whether the law of damping is right (None: nothing asked), seconds."""
    if "refused" in found:
        return known | {
            "outcome": "refused",
            "said": "refused",
            "error": np.nan,
            "law right": None,
            "s": found["seconds"],
        }
    verdict, law = found["verdict"], None
    place = verdict["site"] and verdict["site"]["position"]
    error = _apart(place, known["place"]) / known["span"] if place and known["place"] is not None else np.nan
    kind, group = verdict["kind"], verdict["group"] or ""
    if kind == "named":
        right = group == known["group"] and not error > NEAR
        outcome = "right" if right else "wrong"
        law = verdict["damping"] == [known["law"]] if right and known["law"] and known["group"] != "damping" else None
    elif kind == "nothing-missing":
        outcome = "missed" if known["group"] else "right"
    else:
        outcome = "abstained"
    said = group if kind == "named" else kind
    return known | {"outcome": outcome, "said": said, "error": error, "law right": law, "s": found["seconds"]}


def _apart(place: list[float], true: float | list[float]) -> float:
    """Distance of a place from the true one, of which x or x and y are known."""
    at = np.atleast_1d(true)
    return float(np.linalg.norm(np.array(place)[: len(at)] - at))


def tables(results: list[dict]) -> str:
    """Confusion by truth, laws of damping, places, times."""
    rows: dict[str, list[dict]] = defaultdict(list)
    for one in results:
        rows[one["truth"]].append(one)
    lines = [f"{'truth':28}" + "".join(f"{o:>11}" for o in OUTCOMES) + f"{'law right':>12}   said"]
    for truth, members in rows.items():
        count = Counter(one["outcome"] for one in members)
        laws = [one["law right"] for one in members if one["law right"] is not None]
        said = ", ".join(f"{name} {n}" for name, n in Counter(one["said"] for one in members).most_common())
        share = f"{sum(laws)}/{len(laws)}" if laws else ""
        lines.append(f"{truth:28}" + "".join(f"{count[o]:>11}" for o in OUTCOMES) + f"{share:>12}   {said}")
    errors = [one["error"] for one in results if one["outcome"] == "right" and np.isfinite(one["error"])]
    if errors:
        lines.append(
            f"place, % of the span: median {100 * np.median(errors):.3f}, largest {100 * max(errors):.3f} ({len(errors)})"
        )
    seconds = [one["s"] for one in results]
    lines.append(f"processor seconds for a diagnosis: median {np.median(seconds):.1f}, largest {max(seconds):.1f}")
    return "\n".join(lines)


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.blind_frf", description="Concealed causes in FRFs.")
    parser.add_argument("--verify", action="store_true", help="print how the truth solver does, and stop")
    parser.add_argument("--seed", type=int, default=1, help="structures and noise")
    parser.add_argument(
        "--split", choices=SPLITS, default="development", help="structures used while developing, or others"
    )
    parser.add_argument("--cases", nargs="+", default=[], help="names of cases, * for any: crack*")
    parser.add_argument("--count", type=int, default=6, help="structures of each truth")
    parser.add_argument("--portals", action="store_true", help="frames with a flexible support instead of beams")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes")
    parser.add_argument("--output", type=Path, help="folder of decks and answers; else a temporary one")
    return parser


if __name__ == "__main__":
    main()
