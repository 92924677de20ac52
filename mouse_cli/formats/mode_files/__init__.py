"""Mode shapes kept in files: one module = one format; here, what each of them hands over, a ModeTable."""

from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.formats import data_files


@dataclass(frozen=True)
class ModeTable:
    """m modes at s sensors: names (s,) as decks write them, `12TY`; frequency_hz, damping (m,), NaN where not said; shapes (s, m).

    Frequencies ascend. shapes: as the file scales them, NaN where a mode has no value; complex ones turned so that their real parts
    are largest, and those parts. Those with a modal mass are divided by its root. mass_kg: one of the
    file's unit of mass, None where it says none. frequency_sd_hz (m,), shape_sd (s, m): None where the file states none. places,
    directions: by name, coordinates (3) or node, and direction (6, over TX to RZ), of sensors given by these.
    surveyed: the same of sensors that have numbers of nodes as well. metre: one of the file's unit of length, None where not said.
    """

    names: tuple[str, ...]
    frequency_hz: np.ndarray
    damping: np.ndarray
    shapes: np.ndarray
    mass_kg: float | None = None
    frequency_sd_hz: np.ndarray | None = None
    shape_sd: np.ndarray | None = None
    places: dict[str, tuple | int] = field(default_factory=dict)
    directions: dict[str, tuple] = field(default_factory=dict)
    surveyed: dict[str, tuple[tuple, tuple]] = field(default_factory=dict)
    metre: float | None = None

    def ascending(self) -> "ModeTable":
        """The same with the modes in ascending order of frequency."""
        order = np.argsort(self.frequency_hz, kind="stable")
        each = ("frequency_hz", "damping", "frequency_sd_hz", "shapes", "shape_sd")  # modes along their last axis
        given = {name: getattr(self, name) for name in each}
        return replace(self, **{name: values[..., order] for name, values in given.items() if values is not None})


def turned(shape: np.ndarray) -> np.ndarray:
    """Real parts of a shape turned so that they are largest; NaN stays."""
    known = shape[np.isfinite(shape)]
    if not known.imag.any():
        return shape.real
    return (shape * np.exp(-0.5j * np.angle((known**2).sum()))).real


def read_modes(path: str) -> ModeTable:
    """The mode shapes in the file `path`. Raises DeckError (MD250 to MD262)."""
    form = data_files.reader(__name__, path, "a file of mode shapes")
    return data_files.opened(form, path)
