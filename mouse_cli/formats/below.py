"""Files that a deck or a manifest names: below its own folder, unless the user said otherwise on the command line."""

import os
import stat

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


class Refused(Exception):
    """A name by which nothing is read: the code and the help of its diagnostic."""

    def __init__(self, code: str, message: str, help: str):
        super().__init__(message)
        self.code, self.help = code, help


def named(folder: str, name: str, outside: bool = False, whose: str = "the folder of the deck") -> str:
    """Real path of the file that a deck in `folder` calls `name`; of a file that is not there too.

    A deck from elsewhere must not read beyond its own folder: no absolute path, `..` or link leads out, unless `outside` is
    allowed. A pipe or a device is never read. whose: `folder` in words. Raises Refused (MD231, MD250). What changes the folder
    while it is read is not guarded against.
    """
    if "\0" in name or not name:
        raise Refused("MD231", "which is no name of a file", "give the name of a file")
    path = os.path.join(folder, name)
    if os.path.isabs(name) and not outside:
        raise _out(whose)
    return found(folder, path, outside, whose)


def found(folder: str, path: str, outside: bool = False, whose: str = "the folder of the deck") -> str:
    """Real path of the file `path`, which a search in `folder` came upon or a deck there names. Raises Refused."""
    root, real = os.path.realpath(folder), os.path.realpath(path)
    if not outside and not real.startswith(os.path.join(root, "")):
        raise _out(whose)
    try:
        mode = os.stat(real).st_mode
    except (OSError, ValueError):  # the reader says so
        return real
    if not stat.S_ISREG(mode):
        what = next((word for is_kind, word in _KINDS if is_kind(mode)), "something else")
        raise Refused("MD250", f"which is not a file but {what}", "give the name of a file")
    return real


def _out(whose: str) -> Refused:
    help = "put the file beside the deck and give its name alone; or allow it: --allow-outside"
    return Refused("MD231", f"which is not below {whose}", help)
