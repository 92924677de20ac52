"""CalculiX (ccx): its runs, what it writes, and a cache of both."""

import hashlib
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli._span import Span
from mouse_cli.importing.dofs import Rows, rows
from mouse_cli.importing.model import Clamp
from mouse_cli.model.arrays import Matrix

_EDITION = "2"  # raised when what is kept of a run changes
_SAID = 12  # last lines of the solver that a message shows
_ERRORS = re.compile(r"\*ERROR[^\n]*(?:\n(?! *\*(?:ERROR|WARNING|INFO))[^\n]*\S[^\n]*){0,4}")
_UNKNOWN = re.compile(r"reading (\*[^:\n]+): parameter not recognized:\s*(\S[^\n]*)")
PROGRAM = "ccx"


@dataclass(frozen=True)
class Exported:
    """K and M (n, n) of one job, sparse, and what their rows are; unknown: (keyword, option) that the solver passed over."""

    K: Matrix
    M: Matrix
    rows: Rows
    unknown: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Solver:
    """Runs jobs for the input file `path`, or finds what an earlier run left in `cache`; say: told of each run.

    A context: what it has begun ends with it. ahead: folders of jobs by their text, where they run or have run.
    """

    path: str
    cache: Path | None
    say: Callable[[str], None]
    ahead: dict[str, Future] = field(default_factory=dict, init=False, repr=False)
    running: set[subprocess.Popen] = field(default_factory=set, init=False, repr=False)
    beside: ThreadPoolExecutor = field(default_factory=lambda: ThreadPoolExecutor(cores()), init=False, repr=False)

    def __enter__(self) -> "Solver":
        return self

    def __exit__(self, *reason: object) -> None:
        self.beside.shutdown(wait=False, cancel_futures=True)
        for each in list(self.running):
            each.kill()
        self.beside.shutdown()
        for each in self.ahead.values():
            if not each.cancelled() and each.exception() is None:
                each.result().cleanup()

    def begin(self, jobs: Iterable[tuple[str, str]]) -> None:
        """Run jobs, texts and titles, beside one another and beside what else is done, but for those in the cache."""
        for text, title in jobs:
            target = self._target(text)
            if text not in self.ahead and (target is None or not target.exists()):
                self.say(title)
                self.ahead[text] = self.beside.submit(self._run, text, title)

    def matrices(self, text: str, title: str, own: dict[int, Clamp | None], *known: object) -> Exported:
        """K and M of a job; own: nodes of the input file, and how shells stand at those whose rotations are held; known: the rest
        of what `rows` takes.
        """
        held = self._kept(text, title, _matrix_arrays)
        from scipy.sparse import csr_array

        n = int(held["n"])
        found = rows(held["dofs"], own, *known)
        both = (csr_array((held[f"{x}_data"], held[f"{x}_indices"], held[f"{x}_indptr"]), shape=(n, n)) for x in "KM")
        return Exported(*(found.brought(matrix) for matrix in both), found, tuple(map(tuple, held["unknown"].tolist())))

    def eigenvalues(self, text: str, title: str) -> np.ndarray:
        """Eigenvalues (m,), rad2/s2, of a job that asks for frequencies."""
        return self._kept(text, title, lambda job: {"eigenvalues": _eigenvalues(job)})["eigenvalues"]

    def _kept(self, text: str, title: str, read: Callable[[Path], dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
        target = self._target(text)
        if target is not None and target.exists():
            with np.load(target, allow_pickle=False) as held:
                return dict(held)
        self.begin([(text, title)])
        with self.ahead.pop(text).result() as folder:
            found = read(Path(folder) / "job")
        if target is not None:
            target.parent.mkdir(parents=True, exist_ok=True)
            scratch = target.with_suffix(f".{os.getpid()}.npz")
            np.savez(scratch, **found)
            scratch.replace(target)
        return found

    def _target(self, text: str) -> Path | None:
        """Where the cache has, or would have, what is kept of a job."""
        key = hashlib.sha256(f"{_EDITION}\n{text}".encode()).hexdigest()[:32]
        return None if self.cache is None else self.cache / f"{key}.npz"

    def _run(self, text: str, title: str) -> tempfile.TemporaryDirectory:
        """The folder of a job that has been run."""
        folder = tempfile.TemporaryDirectory()
        job = Path(folder.name) / "job"
        job.with_suffix(".inp").write_text(text)
        one = os.environ | {"OMP_NUM_THREADS": "1"}  # sums in one order: groups are differences of two runs
        with subprocess.Popen(
            [PROGRAM, job.name], cwd=job.parent, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            text=True, env=one, errors="replace",
        ) as process:  # fmt: skip
            self.running.add(process)
            said = process.communicate()[0]
            self.running.discard(process)
        wrote = job.with_suffix(".sti").exists() or "E I G E N V A L U E" in _text(job.with_suffix(".dat"))
        if "*ERROR" in said or not wrote:
            folder.cleanup()
            errors = _ERRORS.findall(said)
            why = errors[0] if errors else "\n".join(said.splitlines()[-_SAID:])
            message = f"CalculiX stopped at {title}: {' '.join(why.split())[:400]}"
            help = f"run the job itself in {PROGRAM} and mend what it objects to"
            raise DeckError.of("MD274", message, self._place(why), help=help)
        job.with_suffix(".said").write_text(said)
        return folder

    def _place(self, why: str) -> Span:
        """The first line of the input file with the keyword that a message of the solver names, else the first of all."""
        named = re.search(r"reading (\*[A-Z ]+[A-Z])", why)
        word = "".join(named[1].split()) if named else None
        lines = enumerate(_text(Path(self.path)).upper().splitlines(), 1)
        return Span(self.path, next((i for i, line in lines if "".join(line.partition(",")[0].split()) == word), 1))


def available() -> bool:
    """Whether the solver is on the path."""
    return shutil.which(PROGRAM) is not None


def cache_folder() -> Path:
    """Where the matrices of earlier runs are kept."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "mouse" / "import"


def cores() -> int:
    """How many runs go on at once."""
    own = getattr(os, "sched_getaffinity", None)
    return max(2, len(own(0)) if own else os.cpu_count() or 1)


def _text(path: Path) -> str:
    return path.read_text(errors="replace") if path.exists() else ""


def _matrix_arrays(job: Path) -> dict[str, np.ndarray]:
    """K and M with both triangles, in compressed rows, and (n, 2) node and direction of each row."""
    lines = job.with_suffix(".dof").read_text().split()
    dofs = np.array([line.split(".") for line in lines], int)
    unknown = sorted(set(_UNKNOWN.findall(_text(job.with_suffix(".said")))))
    found: dict[str, np.ndarray] = {"n": np.array(len(dofs)), "dofs": dofs, "unknown": np.array(unknown, str)}
    for name, suffix in (("K", ".sti"), ("M", ".mas")):
        matrix = _symmetric(job.with_suffix(suffix), len(dofs))
        found |= {f"{name}_data": matrix.data, f"{name}_indices": matrix.indices, f"{name}_indptr": matrix.indptr}
    return found


def _symmetric(path: Path, n: int):
    from scipy.sparse import coo_array, triu

    table = np.loadtxt(path, dtype=[("row", np.int32), ("col", np.int32), ("value", float)], ndmin=1)
    upper = coo_array((table["value"], (table["row"] - 1, table["col"] - 1)), shape=(n, n)).tocsr()
    del table
    matrix = (upper + triu(upper, 1).T).tocsr()
    matrix.eliminate_zeros()
    return matrix


def _eigenvalues(job: Path) -> np.ndarray:
    table = job.with_suffix(".dat").read_text().split("P A R T I C I P")[0]
    rows = re.findall(r"^ +\d+ +(\S+E\S+) +\S+E\S+ +\S+E\S+ +\S+E\S+ *$", table, re.M)
    return np.array([float(value) for value in rows])
