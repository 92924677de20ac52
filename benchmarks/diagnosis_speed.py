"""Processor time of `mouse diagnose` on decks of sealed trials, one of each class, beside another copy of mouse if one is given.

The decks are the first that `benchmarks.trials` draws of these kinds from a seed: beams of some sixty degrees of freedom, frames of
fewer. With --against both copies diagnose each deck in turn, and answers that differ in more than rounding are said.
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from _paired import seconds

ROOT = Path(__file__).parents[1]
AIMS = {  # CPU seconds
    "control/beam/none": 1.0,
    "single/beam/axial": 1.5,
    "single/beam/mass": 3.0,
    "several/beam/two cracks": 6.0,
    "outside/beam/slipping layers": 6.0,
}
LIKE = 1e-3  # relative difference of numbers, beyond which answers are not the same
_COMMAND = "from mouse_cli.cli.main import main; main()"
_MAKE = "import sys; from pathlib import Path; from benchmarks.trials.seal import seal; " + (
    "seal(Path(sys.argv[1]), int(sys.argv[2]), 1, [sys.argv[3]])"
)


def made(kind: str, seed: int, folder: Path) -> Path:
    """A deck of that kind."""
    subprocess.run([sys.executable, "-c", _MAKE, folder, str(seed), kind], env=_environment(ROOT), cwd=ROOT, check=True)
    return next((folder / "decks").glob("*.yaml"))


def diagnosed(copy: Path, deck: Path, answer: Path) -> float:
    """Processor time of a diagnosis by a copy of mouse, its answer written."""
    command = [sys.executable, "-c", _COMMAND, "diagnose", str(deck), "-q", "--report", str(answer)]
    call = {"env": _environment(copy), "cwd": copy, "stdout": subprocess.DEVNULL, "check": False}
    return seconds(lambda: subprocess.run(command, **call))


def _environment(copy: Path) -> dict[str, str]:
    one = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return kept | one | {"PYTHONPATH": str(copy)}


def unlike(one, other) -> bool:
    """Whether two answers differ in more than rounding: in a word, or in a number by more than LIKE; signs of shapes are free."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() != other.keys() or any(unlike(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) != len(other) or any(map(unlike, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return not math.isclose(abs(one), abs(other), rel_tol=LIKE, abs_tol=LIKE)
    return one != other


def main() -> None:
    """Print a row for each kind."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", default=list(AIMS), help="as `python -m benchmarks.trials list` has them")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--against", type=Path, help="folder of another copy, e.g. a git worktree of the last release")
    given = parser.parse_args()
    copies = {"this": ROOT} | ({"other": given.against.resolve()} if given.against else {})
    for i, kind in enumerate(given.kinds):
        with tempfile.TemporaryDirectory() as folder:
            deck = made(kind, given.seed + i, Path(folder) / "trial")
            answers = {name: Path(folder) / f"{name}.json" for name in copies}
            rounds = [{n: diagnosed(copy, deck, answers[n]) for n, copy in copies.items()} for _ in range(given.rounds)]
            print(
                _row(kind, rounds, {name: json.loads(path.read_text()) for name, path in answers.items()}), flush=True
            )


def _row(kind: str, rounds: list[dict[str, float]], answers: dict[str, dict]) -> str:
    aim = f", aim {AIMS[kind]:g}" if kind in AIMS else ""
    text = f"{kind:34s} {statistics.median(each['this'] for each in rounds):6.1f} CPU s{aim}"
    if "other" not in answers:
        return text
    text += f"; other {statistics.median(each['other'] for each in rounds):6.1f}"
    text += f", ratio {statistics.median(each['this'] / each['other'] for each in rounds):.2f}"
    parts = [(answers["this"].get(key), answers["other"].get(key)) for key in ("verdict", "candidates", "groups")]
    return text + ("; answers differ" if any(unlike(*each) for each in parts) else "; same answer")


if __name__ == "__main__":
    main()
