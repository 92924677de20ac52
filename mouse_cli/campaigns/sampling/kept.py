"""A walk as it is kept in a file between its looks, so that one that was broken off goes on as if it had not been."""

import contextlib
import hashlib
import io
import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from mouse_cli import __version__
from mouse_cli._atomic import write_bytes_atomically

_ARRAYS = ("accepted", "chain", "log_prob", "hz")
# Share by which a chain grows before it is written again: so all writing together is of the order of one chain
_GROWTH = 0.1


class Kept:
    """The file `path`.part of a walk; without a path nothing is kept."""

    def __init__(self, path: str | None):
        self.path = path and Path(f"{path.removesuffix('.npz')}.npz.part")
        self._written, self._key = 0, ""

    def backend(self, emcee: Any, begun: np.ndarray, *givens: np.ndarray) -> Any:
        """Where emcee keeps the chain of walkers from `begun` (w, k): as far as one with the same `givens` had come, or empty."""
        digest = hashlib.sha256(__version__.encode())
        for each in (begun, *givens):
            digest.update(np.ascontiguousarray(each).tobytes())
        self._key = digest.hexdigest()
        backend = emcee.backends.Backend()
        backend.reset(*begun.shape)
        if self.path is not None:
            with contextlib.suppress(OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
                self._fill(backend)
        return backend

    def _fill(self, backend: Any) -> None:
        with np.load(self.path, allow_pickle=False) as held:
            values = {name: held[name] for name in (*_ARRAYS, "words", "place", "key")}
        if str(values["key"]) != self._key:
            return
        (position, has), cached = values["place"][:2].astype(int), float(values["place"][2])
        backend.accepted, backend.chain, backend.log_prob = (values[name] for name in _ARRAYS[:3])
        backend.blobs = _blobs(values["hz"])
        backend.random_state = "MT19937", values["words"], int(position), int(has), cached
        backend.iteration = self._written = len(values["chain"])

    def keep(self, backend: Any) -> None:
        """Write the chain, when it has grown by a tenth."""
        if self.path is None or backend.iteration < (1 + _GROWTH) * self._written:
            return
        self._written = n = backend.iteration
        _, words, position, has, cached = backend.random_state
        arrays = backend.accepted, backend.chain[:n], backend.log_prob[:n], backend.blobs["hz"][:n]
        values = dict(zip(_ARRAYS, arrays, strict=True))
        stream = io.BytesIO()
        np.savez(stream, words=words, place=np.array([position, has, cached], float), key=np.array(self._key), **values)
        write_bytes_atomically(self.path, stream.getvalue())

    def done(self) -> None:
        """The walk is at its end: nothing is kept any longer."""
        if self.path is not None:
            with contextlib.suppress(OSError):
                os.unlink(self.path)


def _blobs(hz: np.ndarray) -> np.ndarray:
    """Frequencies (s, w, m) as emcee keeps what belongs to a place: (s, w) of one field."""
    found = np.empty(hz.shape[:2], [("hz", float, hz.shape[2:])])
    found["hz"] = hz
    return found
