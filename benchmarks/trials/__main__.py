"""The command: seal, answer, open."""

import argparse
import sys
from pathlib import Path

import benchmarks._threads  # noqa: F401  (before numpy)
from benchmarks.trials.answer import answer, answers
from benchmarks.trials.kinds import kinds
from benchmarks.trials.page import page
from benchmarks.trials.scoring import Scored, scored
from benchmarks.trials.seal import BrokenSeal, opened, read, seal


def main(words: list[str] | None = None) -> int:
    """Exit code: 0, or 1 where a seal is broken."""
    given = _options().parse_args(words)
    try:
        given.act(given)
    except BrokenSeal as broken:
        print(f"error: {broken}", file=sys.stderr)
        return 1
    return 0


def _seal(given: argparse.Namespace) -> None:
    found = seal(given.out, given.seed, given.cases, given.kinds, given.secret)
    print(f"{found.cases} decks in {given.out / 'decks'}, sealed: {found.truths}")


def _answer(given: argparse.Namespace) -> None:
    count = answer(given.folder, given.jobs)
    print(f"{count} decks diagnosed; answers in {given.folder / 'answers'}")


def _open(given: argparse.Namespace) -> None:
    results = [one for folder in given.folders for one in _scored(folder, given.seed)]
    if not results:
        raise BrokenSeal("there are no answers yet: run `answer` first")
    text = page(results, [read(folder) for folder in given.folders])
    if given.page:
        given.page.write_text(text)
    print(text if not given.page else f"{len(results)} answers scored in {given.page}")


def _scored(folder: Path, seed: int | None) -> list[Scored]:
    """All answers of a folder beside their truths."""
    truths, said = opened(folder, seed), answers(folder)
    return [scored(name, truths[name], said[name]) for name in sorted(truths) if name in said]


def _list(given: argparse.Namespace) -> None:
    print("\n".join(kind.name for kind in kinds()))


def _options() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.trials", description="Sealed trials of mouse diagnose.")
    actions = parser.add_subparsers(required=True)
    make = actions.add_parser("seal", help="make decks, and seal their truths")
    make.add_argument("--seed", type=int, required=True)
    make.add_argument("--cases", type=int, default=400)
    make.add_argument("--out", type=Path, required=True, help="folder of the decks and of seal.txt")
    make.add_argument("--kinds", nargs="+", default=[], help="names of kinds, * for any: single/beam/*; see `list`")
    make.add_argument("--secret", action="store_true", help="do not write the seed down; `open` then needs --seed")
    make.set_defaults(act=_seal)
    say = actions.add_parser("answer", help="diagnose the decks that have no answer yet")
    say.add_argument("folder", type=Path)
    say.add_argument("--jobs", type=int, default=1, help="processes")
    say.set_defaults(act=_answer)
    score = actions.add_parser("open", help="make the truths again, check them against the seal, score the answers")
    score.add_argument("folders", type=Path, nargs="+", help="several are scored on one page")
    score.add_argument("--page", type=Path, help="file of the page; else it is printed")
    score.add_argument("--seed", type=int, help="where it was withheld")
    score.set_defaults(act=_open)
    actions.add_parser("list", help="print the kinds").set_defaults(act=_list)
    return parser


if __name__ == "__main__":
    sys.exit(main())
