"""Faults drawn by a seed over the numeric core, each shown to the quick tests that go through its function; resumable.

    python -m benchmarks.mutants.sampled --each 60 --out mutants [--packages dynamics,records] [--seed 1] [--jobs 1]

Prints a line for each that lives, and how many of each package were killed. What is declared equivalent in `equivalent.py`, with
its reason, counts neither way. A fault that makes a test run longer than its limit counts as killed.
"""

import argparse
import importlib.machinery
import importlib.util
import json
import os
import random
import resource
import sys
from collections import Counter
from pathlib import Path

from benchmarks.mutants import tested
from benchmarks.mutants.equivalent import EQUIVALENT
from benchmarks.mutants.operators import Fault, applied, faults

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = {
    "dynamics": ("dynamics",),
    "updating": ("updating",),
    "estimators": ("estimators",),
    "formats": ("formats/edit", "formats/cards"),
    "diagnosis": ("diagnosis",),
    "coupling": ("coupling",),
    "records": ("records",),
}
_TESTS, _CPU = 30, 60  # of a fault at most: tests, CPU seconds


def main(given: list[str] | None = None) -> int:
    """0: 95 in 100 are killed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--packages", type=lambda text: text.split(","), default=list(PACKAGES))
    parser.add_argument("--each", type=int, default=60, help="faults of each package (60)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("mutants"), help="log; what is there is not done again")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args(given)
    options.out.mkdir(parents=True, exist_ok=True)
    _warm()
    tests = tested.read(ROOT, options.out / "tests.json")
    chosen = [fault for package in options.packages for fault in drawn(package, options.each, options.seed, tests)]
    chosen.sort(key=lambda fault: random.Random(fault.key).random())  # all packages side by side
    children = [_worker(number, chosen, tests, options) for number in range(options.jobs)]
    for child in children:
        os.waitpid(child, 0)
    return _summary(chosen, options)


def drawn(package: str, count: int, seed: int, tests: dict[str, list[str]]) -> list[Fault]:
    """Faults of a package, of each module at most its share and four; in functions that quick tests go through."""
    files = [
        str(path.relative_to(ROOT / "mouse_cli"))
        for folder in PACKAGES[package]
        for path in sorted((ROOT / "mouse_cli" / folder).rglob("*.py"))
    ]
    lot = random.Random(f"{seed}/{package}")
    lot.shuffle(files)
    found: list[Fault] = []
    while len(found) < count and files:
        for file in list(files):
            left = [
                one
                for one in faults(ROOT / "mouse_cli", file)
                if one not in found and f"{one.file}:{one.inside}" in tests and one.key not in EQUIVALENT
            ]
            if not left:
                files.remove(file)
            elif len(found) < count:
                found.append(lot.choice(left))
    return found


def _warm() -> None:
    """What all children need, but nothing of the package."""
    import numpy.testing
    import scipy.linalg
    import scipy.optimize
    import scipy.signal
    import scipy.sparse.linalg
    import scipy.stats
    import yaml

    assert (
        numpy.testing
        and scipy.linalg
        and scipy.optimize
        and scipy.signal
        and scipy.sparse.linalg
        and scipy.stats
        and yaml
    )


def _worker(number: int, chosen: list[Fault], tests: dict[str, list[str]], options: argparse.Namespace) -> int:
    sys.stdout.flush()
    if pid := os.fork():
        return pid
    done = _logged(options)
    with open(options.out / f"log-{number}.jsonl", "a", buffering=1) as log:
        for fault in chosen[number :: options.jobs]:
            if fault.key not in done:
                log.write(json.dumps({"key": fault.key, "ended": shown(fault, tests)}) + "\n")
    os._exit(0)


def shown(fault: Fault, tests: dict[str, list[str]]) -> str:
    """killed, alive or slow (killed by its limit): how the tests of its function end with the fault in a process of their own."""
    if (pid := os.fork()) == 0:
        nothing = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1, 2):
            os.dup2(nothing, number)
        resource.setrlimit(resource.RLIMIT_CPU, (_CPU, _CPU))
        resource.setrlimit(resource.RLIMIT_AS, (4 * 2**30,) * 2)
        os.chdir(ROOT)
        sys.meta_path.insert(0, _Finder(fault))
        import pytest

        chosen = tests[f"{fault.file}:{fault.inside}"][:_TESTS]
        os._exit(int(pytest.main(["-q", "-x", "-p", "no:cacheprovider", "-p", "no:randomly", *chosen])))
    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    return "alive" if code == 0 else "slow" if code < 0 else "killed"


class _Finder:
    """Gives the module with the fault in its place; all others as they are."""

    def __init__(self, fault: Fault):
        self.fault = fault
        name = "mouse_cli." + fault.file.removesuffix(".py").replace("/", ".")
        self.name = name.removesuffix(".__init__")

    def find_spec(self, name: str, path: object = None, target: object = None) -> importlib.machinery.ModuleSpec | None:
        """Of that module alone."""
        if name != self.name:
            return None
        file = str(ROOT / "mouse_cli" / self.fault.file)
        return importlib.util.spec_from_file_location(name, file, loader=_Loader(name, file, self.fault))


class _Loader(importlib.machinery.SourceFileLoader):
    def __init__(self, name: str, file: str, fault: Fault):
        super().__init__(name, file)
        self.fault = fault

    def get_code(self, name: str) -> object:
        """Of the source with the fault, which no compiled file has."""
        return compile(applied(ROOT / "mouse_cli", self.fault), self.path, "exec")


def _logged(options: argparse.Namespace) -> dict[str, str]:
    rows = [json.loads(line) for path in options.out.glob("log-*.jsonl") for line in path.read_text().splitlines()]
    return {row["key"]: row["ended"] for row in rows}


def _summary(chosen: list[Fault], options: argparse.Namespace) -> int:
    done, counts = _logged(options), {package: Counter() for package in PACKAGES}
    for fault in chosen:
        package = next(name for name, folders in PACKAGES.items() if fault.file.startswith(folders))
        counts[package][done.get(fault.key, "not run")] += 1
        if done.get(fault.key) == "alive":
            print(f"alive {fault.file}:{fault.line} {fault.operator}: {fault.old} -> {fault.new} ({fault.inside})")
    for package, count in counts.items():
        print(f"{package:<12}{sum(count.values()):>5} faults, {dict(count)}")
    alive, ran = (
        sum(count["alive"] for count in counts.values()),
        sum(count.total() - count["not run"] for count in counts.values()),
    )
    share = (ran - alive) / max(ran, 1)
    print(f"{ran - alive} of {ran} killed ({share:.1%}), {len(EQUIVALENT)} declared equivalent; seed {options.seed}")
    return int(ran - alive < 0.95 * ran)


if __name__ == "__main__":
    sys.exit(main())
