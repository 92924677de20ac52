"""The engine of batches on the command line: where answers go, and who does the jobs."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import click

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
    from mouse_cli.cli._batch_progress import progress

    found: list = [None] * len(jobs)
    with progress(len(jobs)) as show:
        for number, outcome in outcomes(jobs, folder):
            found[number] = outcome
            show(outcome)
    return found
