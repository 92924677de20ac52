"""Jobs done by processes of this machine, so that none of them, whatever it does, stops the others."""

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection

from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.work import died, perform

_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
_AHEAD = 4  # jobs that wait for each process: enough that none is idle, few enough that memory stays flat

Numbered = tuple[int, Job]


def outcomes(
    jobs: list[Job], folder: str, processes: int, work: Callable[[Job, str], Outcome] = perform
) -> Iterator[tuple[int, Outcome]]:
    """(number of the job, its outcome) as each is done, in any order; answers go to files below `folder`.

    Where a process dies, all that were in hand are tried again, each alone: that which kills its process once more is
    at fault. `work` is what is done with each, a function that can be pickled.
    """
    waiting: deque[Numbered] = deque(enumerate(jobs))
    suspects: deque[Numbered] = deque()
    while waiting or suspects:
        with _pool(min(processes, len(waiting) + len(suspects))) as pool:
            flying: dict[Future[Outcome], Numbered] = {}
            try:
                yield from _drained(pool, flying, waiting, suspects, folder, processes * _AHEAD, work)
            except BrokenProcessPool:
                left = list(flying.values())
                if len(left) == 1:
                    yield left[0][0], died(left[0][1], folder)
                else:
                    suspects.extendleft(reversed(left))
            except BaseException:  # Ctrl-C, or the reader of the outcomes has had enough: what waits must not begin
                pool.shutdown(wait=False, cancel_futures=True)
                raise


def _drained(
    pool: ProcessPoolExecutor,
    flying: dict[Future, Numbered],
    waiting: deque[Numbered],
    suspects: deque[Numbered],
    folder: str,
    ahead: int,
    work: Callable[[Job, str], Outcome],
) -> Iterator[tuple[int, Outcome]]:
    """Outcomes until nothing is left. Raises BrokenProcessPool with those in hand left in `flying`."""
    while waiting or suspects or flying:
        alone = bool(suspects) and not flying
        source, room = (suspects, 1) if alone else (waiting, 0 if suspects else ahead - len(flying))
        for _ in range(min(room, len(source))):
            number, job = source.popleft()
            try:
                flying[pool.submit(work, job, folder)] = number, job
            except BrokenProcessPool:
                source.appendleft((number, job))
                raise
        if alone:
            wait(flying)
        done, _ = wait(flying, return_when=FIRST_COMPLETED)
        for future in done:
            found = future.result()
            yield flying.pop(future)[0], found


def _pool(processes: int) -> ProcessPoolExecutor:
    fresh = multiprocessing.get_context("spawn")  # the same on every system, and no thread of this process is copied
    return ProcessPoolExecutor(processes, mp_context=fresh, initializer=_begin)


def _begin() -> None:
    """Make a process ready: one thread for matrices, modules loaded once, and no life after the batch's own."""
    for name in _THREADS:
        os.environ.setdefault(name, "1")
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    import mouse_cli.formats.assemble
    import mouse_cli.report.result_document
    import mouse_cli.updating.loop  # noqa: F401


def _end_with_parent() -> None:
    """A batch that was killed cannot end its processes, and they would wait for jobs for ever."""
    connection.wait([multiprocessing.parent_process().sentinel])
    os.kill(os.getpid(), signal.SIGTERM)
