"""What a worker does with one job: nothing where the answer is there, else run it within a limit of time, and keep the answer."""

import ctypes
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mouse_cli._errors import ERROR, DeckError, Diagnostic, MouseError, fault
from mouse_cli.batch import record
from mouse_cli.batch.changes import CHANGES, changed, edited
from mouse_cli.batch.job import CHECK, DIAGNOSE, Job
from mouse_cli.batch.outcome import Outcome, outcome, unwritten
from mouse_cli.batch.record import Answer
from mouse_cli.formats import file_bytes, read_draft
from mouse_cli.model.problem import Problem

_CHOICES = ("candidates", "causes")  # options of a diagnosis
_OWN = (*_CHOICES, *CHANGES, "legacy", "scale")


def perform(job: Job, folder: str, limit_s: float | None = None) -> Outcome:
    """The outcome of `job`, whose answer is in its file below `folder` afterwards. Raises nothing but what ends a process.

    limit_s: seconds after which it is broken off (MD910).
    """
    path = job.result(folder)
    try:
        data = file_bytes(job.deck)
        identity = job.identity(data)
        known = record.read(path, identity)
        return (
            outcome(job, known, path, resumed=True) if known else keep(job, _timed(job, data, identity, limit_s), path)
        )
    except DeckError as error:
        return keep(job, Answer("", error.exit_code, error.diagnostics, None), path)
    except OSError as error:
        return keep(job, Answer("", 4, (_unreadable(job, error),), None), path)
    except Exception as error:  # of what keeps answers, not of what finds them
        return outcome(job, Answer("", 5, (_unexpected(job, error),), None), path)


def keep(job: Job, answer: Answer, path: str) -> Outcome:
    """The outcome of an answer after writing it to `path`."""
    try:
        record.write(path, job, answer)
    except MouseError as error:  # the disk is full: the other jobs may still find room
        return unwritten(outcome(job, answer, path), error.diagnostics)
    return outcome(job, answer, path)


def died(job: Job, folder: str) -> Outcome:
    """The outcome of a job that ended its worker."""
    help = "run the deck by itself; where memory is short, give fewer --jobs"
    found = Diagnostic("MD902", ERROR, f"{job.deck}: the process that ran it died", help=help)
    return keep(job, Answer("", 5, (found,), None), job.result(folder))


def _timed(job: Job, data: bytes, identity: str, limit_s: float | None) -> Answer:
    begun = time.perf_counter()
    try:
        with at_most(limit_s):
            exit_code, diagnostics, document = _answer(job, data)
    except MouseError as error:
        exit_code, diagnostics, document = error.exit_code, error.diagnostics, None
    except (Exception, OutOfTime) as error:  # it must not stop the other jobs; it is sought again by the next batch
        exit_code, diagnostics, document, identity = 5, (_unexpected(job, error),), None, ""
    return Answer(identity, exit_code, diagnostics, document, time.perf_counter() - begun)


def _answer(job: Job, data: bytes) -> tuple[int, tuple[Diagnostic, ...], dict[str, Any] | None]:
    """Exit code, findings and document of the command."""
    problem = _problem(job, data)
    if job.command == CHECK:
        from mouse_cli.updating.prior_model import examine

        return 0, problem.warnings + examine(problem), None
    from mouse_cli.report import document

    found = _diagnosed(problem, job.options) if job.command == DIAGNOSE else _run(problem)
    return found.exit_code, problem.warnings, document(found)


def _problem(job: Job, data: bytes) -> Problem:
    """The problem of the deck, options of the job in place of its own."""
    from dataclasses import replace

    from mouse_cli.formats.assemble import assemble

    data = edited(data, job.deck, job.options)
    draft = read_draft(data, job.deck, outside=job.outside, legacy=bool(job.options.get("legacy")))
    if job.options.get("scale") and draft.test:
        draft = replace(draft, test=replace(draft.test, scale=job.options["scale"]))
    changes = {name: value for name, value in job.options.items() if name not in _OWN}
    return changed(assemble(draft.with_run(**changes) if changes else draft), job.options)


def _run(problem: Problem):
    if problem.by_recordings:
        from mouse_cli.updating.recordings.update import update_records

        return update_records(problem, lambda text: None)
    from mouse_cli.updating import run

    return run(problem)


def _diagnosed(problem: Problem, options: dict[str, Any]):
    from mouse_cli.diagnosis.diagnose import diagnose
    from mouse_cli.model.diagnosis import Choices

    only = options.get("candidates")
    return diagnose(problem, choices=Choices(tuple(only) if only else None, options.get("causes", 2)))


def _unreadable(job: Job, error: OSError) -> Diagnostic:
    message = f"{job.deck}: a file that the deck names cannot be read: {error}"
    return Diagnostic("MD250", ERROR, message, help="check the file and its permissions")


def _unexpected(job: Job, error: BaseException) -> Diagnostic:
    if isinstance(error, OutOfTime):
        help = "give a longer --time-limit, or run the deck by itself"
        return Diagnostic("MD910", ERROR, f"{job.deck}: ended at its time limit", help=help)
    if isinstance(error, MemoryError):
        return Diagnostic("MD512", ERROR, f"{job.deck}: not enough memory for a model of this size")
    return fault(error, job.deck)


class OutOfTime(BaseException):
    """The time of the job is over. No Exception, so that nothing takes it for a fault of its own."""


@contextmanager
def at_most(seconds: float | None) -> Iterator[None]:
    """Raise OutOfTime within the block once it has taken `seconds`; at once, or where a call of a library returns to Python.

    Works in any thread: workers of dask do jobs in others than the main one, which signals do not reach.
    """
    if seconds is None:
        yield
        return
    thread, settled, lock = threading.get_ident(), False, threading.Lock()

    def interrupt() -> None:
        with lock:
            if not settled:
                _raise(thread, OutOfTime)

    timer = threading.Timer(seconds, interrupt)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        with lock:
            settled = True
        timer.cancel()
        _raise(thread, None)  # one that was raised and has not arrived must not meet the next job


def _raise(thread: int, kind: type[BaseException] | None) -> None:
    what = ctypes.py_object(kind) if kind else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), what)
