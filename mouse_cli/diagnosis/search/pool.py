"""Processes that share a search, each with the model by itself; answers are taken in the order in which one alone would find them.

What is worth a descent depends on what was found before: parts of a search are begun ahead by what is known then, and anew if that
turns out to be otherwise. So the answer is that of one process, bit for bit, however many there are.
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from multiprocessing import connection
from typing import Any

from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.handed import known_to_all, packed, parts, unpacked
from mouse_cli.diagnosis.search.study import Study

_AHEAD = 3  # parts for each process, in hand or waiting
_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
_own: Study | None = None  # the study of this process, where it is one of a pool

# Of a study, what is given and the misfit above which nothing matters; a function of a module
Task = Callable[..., Any]


class Pool:
    """`jobs` processes for a study; entered, it is None where there is but one, which does all by itself.

    again: makes the model of the study once more, wherever it is handed to; None: that cannot be.
    """

    def __init__(self, study: Study, jobs: int, again: Callable[[], Any] | None = None):
        self.study, self.shared = study, {}
        self._workers: list[ProcessPoolExecutor] = []
        self._loads = [0] * jobs
        if jobs < 2 or again is None:
            return
        self.shared = known_to_all(study)
        # the same on every system; a copy of this process might wait for its threads
        fresh = multiprocessing.get_context("spawn")
        given = (again, study.kind, _coordinates(study.model), tuple(study.known))
        begin = partial(ProcessPoolExecutor, 1, mp_context=fresh, initializer=_begin, initargs=given)
        self._workers = [begin() for _ in range(jobs)]

    def __enter__(self) -> "Pool | None":
        return self if self._workers else None

    def __exit__(self, *_: object) -> None:
        for worker in self._workers:
            worker.shutdown(wait=False, cancel_futures=True)

    def broadcast(self, task: Task, *given: Any) -> None:
        """Every process does `task`."""
        for worker in self._workers:
            worker.submit(_perform, task, given)

    def judged_by(self, study: Study, data: Any) -> "Pool":
        """The same processes from here on, each with its study judged by errors `data`, as `study` is."""
        self.broadcast(judge, packed(data, self.shared))
        self.study, self.shared = study, known_to_all(study)
        return self

    def in_turn(
        self,
        task: Task,
        given: list[tuple],
        accept: Callable[[int, Any], None],
        reach: Callable[[int], float],
    ) -> None:
        """accept(i, task(study, *given[i], reach(i))) for each i in order; accepting may lower the reach of later ones."""
        flying: dict[int, tuple[float, Future, int]] = {}
        for i in range(len(given)):
            for j in range(i, min(len(given), i + _AHEAD * len(self._workers))):
                wanted = reach(j)
                if j in flying and flying[j][0] != wanted:
                    flying.pop(j)[1].cancel()
                if j not in flying:
                    flying[j] = wanted, self._handed(task, (*given[j], wanted))
            accept(i, self._answer(flying.pop(i)[1]))

    def _handed(self, task: Task, given: tuple) -> Future:
        """A part of the search in the hands of the process that has least to do."""
        k = self._loads.index(min(self._loads))
        self._loads[k] += 1
        future = self._workers[k].submit(_perform, task, given)
        future.add_done_callback(lambda _: self._done(k))
        future.again = lambda: task(self.study, *given)
        return future

    def _done(self, k: int) -> None:
        self._loads[k] -= 1

    def _answer(self, future: Future) -> Any:
        """What a process found; found here where it died."""
        try:
            found = future.result()
        except BrokenProcessPool:
            return future.again()
        return future.again() if found is None else unpacked(found, self.shared)


def _begin(again: Callable[[], Any], kind: type, coordinates: tuple[bytes, ...], known: tuple[str, ...]) -> None:
    """Make the study of this process, which is none where its model is not that of the others to the last bit."""
    global _own
    for name in _THREADS:
        os.environ.setdefault(name, "1")
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    model = again()
    if _coordinates(model) == coordinates:
        _own = Study(model, {key: registry()[key] for key in known}, kind)


def _coordinates(model: Any) -> tuple[bytes, ...]:
    """By what models are the same to the last bit."""
    return tuple(part.V.tobytes() for part in parts(model))


def judge(study: Study, data: bytes) -> None:
    """From here on this process judges by errors `data`."""
    global _own
    _own = study.judged_by(unpacked(data, known_to_all(study)))


def _perform(task: Task, given: tuple) -> bytes | None:
    return None if _own is None else packed(task(_own, *given), known_to_all(_own))


def _end_with_parent() -> None:
    """What was killed cannot end its processes, and they would wait for ever."""
    connection.wait([multiprocessing.parent_process().sentinel])
    os.kill(os.getpid(), signal.SIGTERM)
