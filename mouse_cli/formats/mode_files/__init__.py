"""Mode shapes kept in files: one module = one format; here, what each of them hands over."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mouse_cli.formats import data_files


@dataclass(frozen=True)
class ModeTable:
    """m modes at s sensors: names (s,) as decks write them, `12TY`; frequency_hz, damping (m,), NaN where not said; shapes (s, m).

    Frequencies ascend. shapes: as the file scales them, NaN where a mode has no value; complex ones turned so that their real parts
    are largest, and those parts. Those with a modal mass are divided by its root. mass_kg: one of the
    file's unit of mass, None where it says none.
    """

    names: tuple[str, ...]
    frequency_hz: np.ndarray
    damping: np.ndarray
    shapes: np.ndarray
    mass_kg: float | None = None


@dataclass(frozen=True, slots=True)
class ModeFormat:
    """A format of mode shapes: read(path) gives a ModeTable. suffixes: of its files, without the point; default: `key`."""

    key: str
    read: Callable[[str], ModeTable]
    suffixes: tuple[str, ...] = ()
    claims: Callable[[bytes], bool] | None = None


def read_modes(path: str) -> ModeTable:
    """The mode shapes in the file `path`. Raises DeckError (MD250 to MD262)."""
    form = data_files.reader(__name__, path, "a file of mode shapes")
    return data_files.opened(form, path)
