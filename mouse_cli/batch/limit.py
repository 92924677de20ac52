"""A limit on the seconds of a job, kept by an exception in the thread that does it."""

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager


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
