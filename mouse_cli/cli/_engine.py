"""The engine of batches on the command line: where answers go, and who does the jobs."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import click

from mouse_cli.batch.outcome import Outcome

JOBS = (
    click.option("-j", "--jobs", type=click.IntRange(1, 1024), help="Processes at once.  [default: one for each core]"),
    click.option(
        "--time-limit",
        "limit_s",
        metavar="SECONDS",
        type=click.FloatRange(0, min_open=True),
        help="End jobs that take longer.",
    ),
)
CLUSTER = (
    click.option("--scheduler", metavar="ADDRESS", help="Workers of this dask scheduler, which see the same folders."),
    click.option("--cluster", metavar="N", type=click.IntRange(1, 1024), help="N dask workers on this machine."),
)


def folder(default: str) -> tuple[Callable, ...]:
    """The folder of the answers."""
    text = "Answers, one file a job."
    return (click.option("-o", "--output", metavar="FOLDER", default=default, show_default=True, help=text),)


def done(
    jobs: list, output: str, processes: int | None, scheduler: str | None, cluster: int | None, limit_s: float | None
) -> list:
    """The outcomes of the jobs, in their order; answers that are there below `output` are not sought again.

    Raises click.UsageError for options that exclude each other, WrittenError where the folder cannot be used.
    """
    from mouse_cli.batch.folder import held

    if sum(each is not None for each in (processes, scheduler, cluster)) > 1:
        raise click.UsageError("--jobs, --scheduler and --cluster exclude each other")
    with held(output), _workers(processes, scheduler, cluster, limit_s) as outcomes:
        return _collected(jobs, output, outcomes)


@contextmanager
def _workers(
    processes: int | None, scheduler: str | None, cluster: int | None, limit_s: float | None
) -> Iterator[Callable]:
    """What gives the outcomes of jobs and a folder: processes, or workers of dask."""
    from functools import partial

    from mouse_cli.batch.work import perform

    work = partial(perform, limit_s=limit_s)
    if scheduler is None and cluster is None:
        from mouse_cli.batch.processes import cores, outcomes

        yield lambda jobs, folder: outcomes(jobs, folder, processes or cores(), work)
        return
    from mouse_cli.batch import cluster as dask

    with dask.client(scheduler, cluster or 1) as client:
        yield lambda jobs, folder: dask.outcomes(jobs, folder, client, work)


def _collected(jobs: list, folder: str, outcomes: Callable) -> list:
    """The outcomes, in the order of the jobs."""
    found: list = [None] * len(jobs)
    with progress(len(jobs)) as show:
        for number, outcome in outcomes(jobs, folder):
            found[number] = outcome
            show(outcome)
    return found


_EVERY = 0.2  # s between two lines
_CLEAR = "\r\033[K"


@contextmanager
def progress(jobs: int) -> Iterator[Callable[[Outcome], None]]:
    """Call what it gives with each outcome; nothing is shown, and nothing left, where no terminal is."""
    if not sys.stderr.isatty():
        yield lambda outcome: None
        return
    begun = time.monotonic()
    done = run = bad = 0
    shown = begun

    def show(outcome: Outcome) -> None:
        nonlocal done, run, bad, shown
        done, run = done + 1, run + (not outcome.resumed)
        bad += bool(outcome.missed or outcome.counted > 1)
        now = time.monotonic()
        if now - shown >= _EVERY:
            shown = now
            click.echo(_CLEAR + line(done, jobs, bad, run / (now - begun)), err=True, nl=False)

    try:
        yield show
    finally:
        click.echo(_CLEAR, err=True, nl=False)


def line(done: int, jobs: int, bad: int, rate: float) -> str:
    """`312 of 1000 jobs, 42/s, 16 s left, 3 failed`; rate: jobs run in a second, those done before not counted.

    >>> line(312, 1000, 3, 42.0)
    '312 of 1000 jobs, 42/s, 16 s left, 3 failed'
    """
    parts = [f"{done} of {jobs} jobs"]
    if rate > 0:
        parts += [f"{rate:.3g}/s", f"{_time((jobs - done) / rate)} left"]
    return ", ".join([*parts, f"{bad} failed"] if bad else parts)


def _time(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
