"""Jobs done by processes of this machine, so that none of them, whatever it does, stops the others."""

import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection

from mouse_cli._errors import MouseError
from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.portions import Numbered, Task, Work, next_size
from mouse_cli.batch.work import died, perform

_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
_AHEAD = 2  # portions for each process, one in hand and one that waits: none is idle, and memory stays flat


def outcomes(jobs: list[Job], folder: str, processes: int, work: Work = perform) -> Iterator[tuple[int, Outcome]]:
    """(number of the job, its outcome) as each is done, in any order; answers go to files below `folder`.

    Where a process dies, all that were in hand are tried again, each alone: that which kills its process once more is
    at fault. `work` is what is done with each, a function that can be pickled. Raises MouseError (MD909) where no process lives.
    """
    waiting: deque[Numbered] = deque(enumerate(jobs))
    suspects: deque[Numbered] = deque()
    while waiting or suspects:
        with _pool(min(processes, len(waiting) + len(suspects))) as pool:
            flying: dict[Future[list[Outcome]], list[Numbered]] = {}
            try:
                yield from _drained(pool, flying, waiting, suspects, Task(folder, work), processes)
            except BrokenProcessPool:
                left = [each for portion in flying.values() for each in portion]
                if len(left) == 1:
                    _probe(Task(folder, work))
                    yield left[0][0], died(left[0][1], folder)
                else:
                    suspects.extendleft(reversed(left))
            except BaseException:  # Ctrl-C, or the reader of the outcomes has had enough: what waits must not begin
                pool.shutdown(wait=False, cancel_futures=True)
                raise


def _probe(task: Task) -> None:
    """Raise MouseError (MD909) where even a process without a job dies: it is no deck's fault then."""
    with _pool(1) as pool:
        try:
            pool.submit(task, []).result()
        except BrokenProcessPool as error:
            help = "check the system log for memory and process limits; resume with the same command"
            raise MouseError.of("MD909", "processes for jobs cannot be started", help=help) from error


def _drained(
    pool: ProcessPoolExecutor,
    flying: dict[Future, list[Numbered]],
    waiting: deque[Numbered],
    suspects: deque[Numbered],
    task: Task,
    processes: int,
) -> Iterator[tuple[int, Outcome]]:
    """Outcomes until nothing is left. Raises BrokenProcessPool with those in hand left in `flying`."""
    size = 1
    while waiting or suspects or flying:
        alone = bool(suspects) and not flying
        source, room = (suspects, 1) if alone else (waiting, 0 if suspects else _AHEAD * processes - len(flying))
        for _ in range(room):
            _hand_over(pool, flying, source, task, 1 if alone else min(size, -(-len(source) // (2 * processes))))
        done, _ = wait(flying, return_when=FIRST_COMPLETED)
        for future in done:
            found = future.result()
            yield from zip((number for number, _ in flying.pop(future)), found, strict=True)
            size = next_size(found)


def _hand_over(
    pool: ProcessPoolExecutor, flying: dict[Future, list[Numbered]], source: deque[Numbered], task: Task, size: int
) -> None:
    """The next `size` jobs of `source`, if there are any."""
    portion = [source.popleft() for _ in range(min(size, len(source)))]
    if not portion:
        return
    try:
        flying[pool.submit(task, portion)] = portion
    except BrokenProcessPool:
        source.extendleft(reversed(portion))
        raise


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


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
