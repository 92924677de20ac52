"""The folder of answers: one batch at a time writes to it."""

import contextlib
import os
from collections.abc import Iterator
from glob import escape, glob

from mouse_cli._errors import WrittenError

_LOCK = ".mouse-batch"


@contextlib.contextmanager
def held(folder: str) -> Iterator[None]:
    """Make `folder` and hold it against other batches; what a kill left half-written is deleted.

    Raises WrittenError: MD290 where it cannot be made, MD904 where another batch holds it.
    """
    try:
        os.makedirs(folder, exist_ok=True)
        stream = open(os.path.join(folder, _LOCK), "a")  # noqa: SIM115 - closed below
    except OSError as error:
        help = "check its name, its permissions and the free space"
        message = f"cannot write to the folder {folder}: {error.strerror or error}"
        raise WrittenError.of("MD290", message, help=help) from error
    with stream:
        _lock(stream, folder)
        for left in glob(os.path.join(escape(folder), ".*.json.*")):
            with contextlib.suppress(OSError):
                os.unlink(left)
        yield


def _lock(stream, folder: str) -> None:
    """The system frees the lock when the process ends, however it does."""
    try:
        import fcntl
    except ImportError:  # pragma: no cover - Windows
        return
    try:
        fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        help = "wait for it to end, or give another folder with -o"
        raise WrittenError.of("MD904", f"another batch writes to {folder}", help=help) from error
