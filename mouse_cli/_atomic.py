"""Whole files or none: text goes to a temporary name in the same folder, then takes its final name."""

import contextlib
import os
import tempfile
from pathlib import Path

from mouse_cli._errors import WrittenError


def write_text_atomically(path: str | Path, text: str) -> None:
    """Write `text` as UTF-8; an interrupt or a full disk leaves what stood there before.

    A symbolic link is followed, so that the link stays one. Permissions of an existing file are kept.
    Raises WrittenError (MD290) when the file cannot be written.
    """
    write_bytes_atomically(path, text.encode("utf-8", "replace"))


def write_bytes_atomically(path: str | Path, data: bytes) -> None:
    """Write `data` as `write_text_atomically` writes a text."""
    target = os.path.realpath(path)
    try:
        _replace(target, data)
    except OSError as error:
        raise WrittenError.of(
            "MD290",
            f"cannot write {path}: {error.strerror or error}",
            help="check the folder, its permissions and the free space; nothing was changed",
        ) from error


def _replace(target: str, data: bytes) -> None:
    if os.path.exists(target) and not os.path.isfile(target):  # /dev/stdout or a pipe has nothing to be kept whole
        Path(target).write_bytes(data)
        return
    handle, temporary = tempfile.mkstemp(prefix=f".{os.path.basename(target)}.", dir=os.path.dirname(target) or ".")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        os.chmod(temporary, _mode(target))
        os.replace(temporary, target)
    except BaseException:  # also Ctrl-C: the temporary file must go
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _mode(target: str) -> int:
    """Permissions of the file that is replaced; of a new one, what the umask leaves."""
    if os.path.exists(target):
        return os.stat(target).st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
