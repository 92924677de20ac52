"""How far a batch is, on terminals: jobs done, rate, time left."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import click

from mouse_cli.batch.outcome import Outcome

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
