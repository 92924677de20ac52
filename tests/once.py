"""What several tests ask for, made once by all processes of a run."""

from collections.abc import Callable
from pathlib import Path

folder: Path | None = None  # that all processes of this run have; None: there is one process


def once(name: str, make: Callable[[], bytes]) -> bytes:
    """What `make` gives, under that name: the first process that asks makes it, the others wait and read."""
    if folder is None:
        return make()
    import fcntl

    path = folder / name
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not path.exists():
            path.write_bytes(make())
        return path.read_bytes()
