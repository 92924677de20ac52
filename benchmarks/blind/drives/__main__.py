"""The command: truths, decks, diagnoses, a table."""

import argparse
import json
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

from benchmarks.blind.drives.decks import answer, write
from benchmarks.blind.drives.draws import Case, cases
from benchmarks.blind_records.__main__ import judged

OUTCOMES = ("right", "inexact", "wrong", "abstained", "missed")
WITHIN = 0.05  # of the true force, for a right answer


def main() -> None:
    """Parse the options and print the table."""
    given = _options().parse_args()
    folder = given.output or Path(tempfile.mkdtemp(prefix="blind-drives-"))
    for name in ("decks", "answers", "found"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    own = [one for one in cases(given.seed, given.faults, given.sound) if given.only in one.name]
    print(f"{len(own)} decks in {folder}, seed {given.seed}", flush=True)
    results = []
    for case in own:
        deck = write(folder / "decks", case)
        known = folder / "answers" / f"{deck.stem}.json"
        known.write_text(json.dumps(answer(case)))
        found = judged((deck, known, folder / "found" / f"{deck.stem}.json"))
        results.append((case, *outcome(*found), found[1]["seconds"]))
        print(line(*results[-1]), flush=True)
    print(table(results))


def outcome(known: dict, found: dict) -> tuple[str, str]:
    """right, inexact (the force), wrong, abstained or missed; and what was said."""
    if "refused" in found:
        return "missed", found["refused"].strip().splitlines()[-1]
    verdict = found["verdict"]
    kind, group = verdict["kind"], verdict["group"]
    ids = [str(i) for i in (verdict["site"] or {"ids": []})["ids"]]
    said = " ".join([kind, group or "", *ids]).strip()
    if known["physics"] is None:
        return ("right" if kind == "nothing-missing" else "wrong" if kind == "named" else "abstained"), said
    if kind != "named":
        return ("missed" if kind == "nothing-missing" else "abstained"), said
    if (group, ids) != (known["physics"], known["ids"]):
        return "wrong", said
    error = _error(known, found)
    return ("right" if abs(error) <= WITHIN else "inexact"), f"{said} {100 * error:+.1f} %"


def _error(known: dict, found: dict) -> float:
    """Of the named slip force, relative."""
    force = next(size["value"] for size in found["candidates"][0]["parameters"] if size["name"] == "slip force")
    return force / known["force"] - 1


def line(case: Case, result: str, said: str, seconds: float) -> str:
    """One case in words."""
    how = f"{case.drive.n} mass, {case.quantity}, {'closed' if case.drive.gains else 'open'}, {case.course}"
    how += ", play" if case.drive.shaft[2] else ""
    return f"  {case.name:18} {how:46} {result:10} {said}  {seconds:.0f} s"


def table(results: list[tuple]) -> str:
    """Outcomes with and without friction; oscillators; processor seconds."""
    lines = [f"{'truth':20}" + "".join(f"{name:>11}" for name in OUTCOMES)]
    for title, sound in (("friction", False), ("none", True)):
        count = Counter(one[1] for one in results if one[0].sound == sound)
        lines.append(f"{title:20}" + "".join(f"{count[name]:>11}" for name in OUTCOMES) + f"   of {count.total()}")
    lines.append(f"an oscillator first: {sum('oscillator' in one[2] for one in results)}")
    seconds = [one[3] for one in results]
    return "\n".join([*lines, f"processor seconds: median {np.median(seconds):.1f}, largest {max(seconds):.1f}"])


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.blind.drives", description="The blind benchmark of drives."
    )
    add = parser.add_argument
    add("--seed", type=int, default=1, help="drives, forces and noise")
    add("--faults", type=int, default=20, help="drives with friction")
    add("--sound", type=int, default=10, help="drives without")
    add("--only", default="", help="cases whose names hold this")
    add("--output", type=Path, help="folder of decks and answers; else a temporary one")
    return parser


if __name__ == "__main__":
    main()
