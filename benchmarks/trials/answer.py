"""Answers: `mouse diagnose --json` on each deck, kept as they come, so that a run that was cut short goes on."""

import json
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from benchmarks.blind.diagnose import diagnosed
from benchmarks.trials.seal import DECKS, read

ANSWERS = "answers"


def answer(folder: Path, jobs: int = 1, report: Callable[[str], None] = print) -> int:
    """Diagnoses the decks that have no answer yet; how many."""
    read(folder)
    (folder / ANSWERS).mkdir(exist_ok=True)
    waiting = [p for p in sorted((folder / DECKS).glob("*.yaml")) if not _path(folder, p).exists()]
    with ProcessPoolExecutor(jobs) as pool:
        running = {pool.submit(diagnosed, deck): deck for deck in waiting}
        for number, done in enumerate(as_completed(running), 1):
            deck, document = running[done], done.result()
            scratch = _path(folder, deck).with_suffix(".part")
            scratch.write_text(json.dumps(document))
            scratch.replace(_path(folder, deck))
            said = "refused" if "refused" in document else document["verdict"]["kind"]
            report(f"{number}/{len(waiting)} {deck.stem}: {said}, {document['seconds']:.1f} s")
    return len(waiting)


def answers(folder: Path) -> dict[str, dict]:
    """Documents by the names of the decks; `seconds` is processor time, `refused` the message where there is none."""
    return {path.stem: json.loads(path.read_text()) for path in sorted((folder / ANSWERS).glob("*.json"))}


def _path(folder: Path, deck: Path) -> Path:
    return folder / ANSWERS / f"{deck.stem}.json"
