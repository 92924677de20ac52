"""Command line: puts each fault into a copy of the package and says whether its tests notice."""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from benchmarks.mutants import faults
from benchmarks.mutants.core import CORE
from benchmarks.mutants.faults import Mutant

MUTANTS = (*faults.MUTANTS, *CORE)
ROOT = Path(__file__).resolve().parents[2]
_COPIED = ("mouse_cli", "tests/reference")
_PASSED, _FAILED = 0, 1  # exit codes of pytest; others: the tests did not run


def main(arguments: list[str] | None = None) -> int:
    """Print a line a mutant; 0: all are killed, 1: some are alive."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.mutants", description=__doc__)
    parser.add_argument("names", nargs="*", help="mutants; none: all")
    parser.add_argument("--list", action="store_true", help="print their names, and stop")
    parser.add_argument("--unchecked", action="store_true", help="do not run the tests without a fault first")
    options = parser.parse_args(arguments)
    if unknown := set(options.names) - {one.name for one in MUTANTS}:
        parser.error(f"no such mutant: {', '.join(sorted(unknown))}")
    chosen = [one for one in MUTANTS if not options.names or one.name in options.names]
    if options.list:
        print("\n".join(f"{one.name}: {one.file}" for one in chosen))
        return 0
    with tempfile.TemporaryDirectory() as folder:
        return _judged(chosen, Path(folder), options.unchecked)


def _judged(chosen: list[Mutant], copy: Path, unchecked: bool) -> int:
    for part in _COPIED:
        shutil.copytree(ROOT / part, copy / part, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", copy)
    if not unchecked and _exit_code(copy, sorted({test for one in chosen for test in one.tests})) != _PASSED:
        raise SystemExit("the tests fail without a fault")
    alive = 0
    for number, one in enumerate(chosen, 1):
        lives = not killed(one, copy)
        alive += lives
        print(f"{number:3} {'ALIVE ' if lives else 'killed'} {one.name} ({one.file})", flush=True)
    print(f"{len(chosen) - alive} of {len(chosen)} killed")
    return int(alive > 0)


def killed(one: Mutant, copy: Path) -> bool:
    """Whether a test of a mutant fails in the copy, which is left as it was."""
    path = copy / "mouse_cli" / one.file
    text = path.read_text()
    if text.count(one.old) != 1:
        raise SystemExit(f"{one.name}: its text stands {text.count(one.old)} times in {one.file}")
    path.write_text(text.replace(one.old, one.new))
    try:
        code = _exit_code(copy, one.tests)
    finally:
        path.write_text(text)
    if code not in (_PASSED, _FAILED):
        raise SystemExit(f"{one.name}: its tests did not run (pytest ends with {code})")
    return code == _FAILED


def _exit_code(copy: Path, tests: Iterable[str]) -> int:
    """Of pytest, in the copy alone; no compiled files, which two changes within a second might share."""
    env = os.environ | {"PYTHONPATH": str(copy), "PYTHONDONTWRITEBYTECODE": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-m", "", "-p", "no:cacheprovider", *tests]
    return subprocess.run(command, cwd=copy, env=env, capture_output=True, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
