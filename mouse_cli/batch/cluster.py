"""Jobs done by workers of dask.distributed, on this machine or on others that see the same folders."""

import os
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mouse_cli._errors import MouseError
from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.portions import Numbered, Task, Work, next_size
from mouse_cli.batch.work import died, perform

_AHEAD = 3  # portions for each worker
_PORTION_S = 0.5  # seconds of work in one: workers may be far, and the scheduler takes some milliseconds for each
_WAIT_S = 20  # for a scheduler to answer


@contextmanager
def client(scheduler: str | None, workers: int) -> Iterator[Any]:
    """A client of the scheduler at that address, or of `workers` processes of this machine.

    Raises MouseError: MD905 where the package is not installed, MD908 where no scheduler answers.
    """
    try:
        import distributed
    except ImportError as error:
        help = "pip install 'mouse-cli[cluster]', or leave out --scheduler and --cluster: processes of this machine need nothing"
        raise MouseError.of("MD905", "the package distributed is not installed", help=help) from error
    local = scheduler is None
    try:
        if local:
            options = {"n_workers": workers, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
            found = distributed.Client(**options)
        else:
            found = distributed.Client(scheduler, timeout=_WAIT_S)
    except (OSError, ValueError) as error:
        message = f"no scheduler answers at {scheduler or 'this machine'}: {str(error).splitlines()[0][:200]}"
        raise MouseError.of("MD908", message, help="see that it runs: dask scheduler") from error
    try:
        yield found
    finally:
        found.close()


def outcomes(jobs: list[Job], folder: str, client: Any, work: Work = perform) -> Iterator[tuple[int, Outcome]]:
    """(number of the job, its outcome) as each is done, in any order; workers write the answers below `folder`.

    Jobs of a worker that died are tried by others; one that has killed several is at fault (MD902).
    """
    from distributed import KilledWorker, as_completed

    waiting: deque[Numbered] = deque(enumerate(jobs))
    task, size = Task(folder, work, os.getcwd()), 1
    flying: dict[str, list[Numbered]] = {}
    done = as_completed()

    def hand_over(portion: list[Numbered]) -> None:
        future = client.submit(task, portion, pure=False)
        flying[future.key] = portion
        done.add(future)

    while waiting or flying:
        workers = max(1, len(client.scheduler_info(n_workers=-1)["workers"]))
        while waiting and len(flying) < _AHEAD * workers:
            count = min(size, -(-len(waiting) // (2 * workers)))
            hand_over([waiting.popleft() for _ in range(count)])
        future = next(done)
        portion = flying.pop(future.key)
        try:
            found = future.result()
        except KilledWorker:
            if len(portion) == 1:
                yield portion[0][0], died(portion[0][1], folder)
            for each in portion if len(portion) > 1 else ():
                hand_over([each])
            continue
        yield from zip((number for number, _ in portion), found, strict=True)
        size = next_size(found, _PORTION_S)
