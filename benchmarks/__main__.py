"""All benchmarks: `python -m benchmarks` lists them, `python -m benchmarks --run` runs them and prints one table.

Each runs in a process of its own, timed by its processor time. --small: at the smallest size there is, to see that it runs; its
figures then mean nothing.
"""

import argparse
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from benchmarks._paired import seconds

SMALL = {  # words of each at its smallest size
    "ambiguity": ("1", "--kinds", "twins"),
    "batch": ("20",),
    "batch_kills": ("--kills", "1", "--decks", "20"),
    "batch_workers": ("2", "--repeats", "1"),
    "coupling": ("--interface", "20", "--lines", "20", "--rounds", "1"),
    "cycle": (),
    "decks": ("--count", "3"),
    "diagnosis_scale": ("frame", "--size", "700", "--parameters", "2", "--modes", "4", "--sensors", "6"),
    "diagnosis_speed": ("control/chain/none", "--rounds", "1"),
    "fields": ("--count", "2000"),
    "finite_differences": ("--dofs", "300", "--parameters", "2", "--timed", "1"),
    "frf_speed": ("frame", "-n", "2000", "--lines", "20", "--parameters", "3"),
    "growth": ("frame", "--largest", "2000"),
    "identification": ("--rounds", "1"),
    "million": ("plate", "--dofs", "3000"),
    "peers": ("P1", "--draws", "1"),
    "posterior_coverage": ("1",),
    "recordings": ("--rounds", "1"),
    "reliability": ("--share", "0.01"),
    "scale": ("frame-1e4", "--rounds", "1"),
    "sensitivity_accuracy": ("frame", "--dofs", "300", "--modes", "4", "--sensors", "5"),
    "startup": ("--rounds", "1"),
    "threads": ("--rounds", "1", "--runs", "1"),
}


@dataclass(frozen=True)
class Outcome:
    """CPU seconds of a benchmark, its exit code, and all that it printed."""

    seconds: float
    code: int
    told: str


def purpose(name: str) -> str:
    """The first line of its docstring."""
    return _path(name).read_text().split('"""')[1].splitlines()[0]


def ran(name: str, words: tuple[str, ...] = ()) -> Outcome:
    """One benchmark in a process of its own."""
    found: list[subprocess.CompletedProcess] = []
    command = [sys.executable, str(_path(name)), *words]
    call = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "check": False}
    spent = seconds(lambda: found.append(subprocess.run(command, **call)))
    return Outcome(spent, found[0].returncode, found[0].stdout)


def main(words: list[str] | None = None) -> int:
    """Exit code: 0, or 1 where a benchmark ended with an error."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="these alone")
    parser.add_argument("--run", action="store_true", help="run them; without it they are listed")
    parser.add_argument("--small", action="store_true", help="at their smallest size")
    given = parser.parse_args(words)
    if unknown := set(given.names) - set(SMALL):
        parser.error(f"there is no benchmark called {', '.join(sorted(unknown))}")
    names = given.names or list(SMALL)
    if not given.run:
        print("\n".join(f"{name:22s} {purpose(name)}" for name in names))
        return 0
    outcomes = {}
    for name in names:
        outcomes[name] = one = ran(name, SMALL[name] if given.small else ())
        print(f"== {name}\n{one.told}", flush=True)
    print("\n".join(f"{name:22s} {one.seconds:8.1f} CPU s  exit {one.code}" for name, one in outcomes.items()))
    return int(any(one.code for one in outcomes.values()))


def _path(name: str) -> Path:
    return Path(__file__).with_name(f"{name}.py")


if __name__ == "__main__":
    sys.exit(main())
