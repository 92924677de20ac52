"""The lines at which all parts of a coupled structure are known."""

from dataclasses import dataclass

import numpy as np

from mouse_cli._errors import DeckError
from mouse_cli.model.coupling import Coupling, Substructure
from mouse_cli.model.frf_test import KINDS

_SAME = 1e-4  # of the spacing by which lines that are one may differ


@dataclass(frozen=True)
class Common:
    """hz (f,); s = decay_rate + i omega (f,), rad/s; rows: of each part that is measured, the numbers of these lines in its
    functions."""

    hz: np.ndarray
    s: np.ndarray
    rows: dict[int, np.ndarray]
    decay_rate: float = 0.0


def common_lines(coupling: Coupling) -> Common:
    """The lines that the deck asks for, or all those measured in its band. Raises DeckError (MD711, MD712)."""
    measured = {k: part for k, part in enumerate(coupling.substructures) if part.measured}
    hz = coupling.lines.frequency_hz
    if hz is None:
        first = next(iter(measured.values()))
        hz = first.frf.frequency_hz
        for part in measured.values():
            hz = hz[_nearest(part, hz)[1]]
        if coupling.lines.band is not None:
            hz = hz[(hz >= coupling.lines.band[0]) & (hz <= coupling.lines.band[1])]
    rows = {}
    for k, part in measured.items():
        rows[k], there = _nearest(part, hz)
        if not there.all():
            raise _apart(f"nothing was measured on {part.name} at {hz[~there][0]:.6g} Hz; its lines are {_band(part)}")
    keep = _usable(measured, rows, hz)
    if not len(hz) or not keep.any():
        raise _apart(
            f"no line is common to {', '.join(part.name for part in measured.values()) or 'the parts'} in the band"
        )
    rate = _decay(measured)
    hz = hz[keep]
    return Common(hz, rate + 2j * np.pi * hz, {k: each[keep] for k, each in rows.items()}, rate)


def _nearest(part: Substructure, hz: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number of the measured line nearest to each (f,), and whether it is that line."""
    own = part.frf.frequency_hz
    right = np.clip(np.searchsorted(own, hz), 1, max(len(own) - 1, 1)) if len(own) > 1 else np.zeros(len(hz), int)
    row = np.where(
        np.abs(own[right] - hz) < np.abs(own[np.maximum(right - 1, 0)] - hz), right, np.maximum(right - 1, 0)
    )
    spacing = np.diff(own).min() if len(own) > 1 else 1.0
    return row, np.abs(own[row] - hz) <= _SAME * spacing


def _usable(measured: dict[int, Substructure], rows: dict[int, np.ndarray], hz: np.ndarray) -> np.ndarray:
    """Lines (f,) at which every measured part has values: none at 0 Hz of mobility and accelerance, none where nothing was
    measured."""
    keep = np.ones(len(hz), bool)
    for k, part in measured.items():
        H = part.frf.H
        if not np.isfinite(H.sum(axis=(1, 2))[rows[k]]).all():
            used = H[rows[k]]
            taken = np.isfinite(used).any(axis=0)
            keep &= np.isfinite(used[:, taken]).all(axis=1)
        if KINDS[part.frf.kind] and part.frf.decay_rate == 0:
            keep &= hz > 0
    return keep


def _decay(measured: dict[int, Substructure]) -> float:
    rates = {part.name: part.frf.decay_rate for part in measured.values()}
    if len(set(rates.values())) > 1:
        words = ", ".join(f"{name} {rate:g} 1/s" for name, rate in rates.items())
        raise DeckError.of("MD712", f"exponential windows differ: {words}", help="measure with one window")
    return next(iter(rates.values()), 0.0)


def _band(part: Substructure) -> str:
    hz = part.frf.frequency_hz
    return f"from {hz[0]:.6g} to {hz[-1]:.6g} Hz, {np.diff(hz).min(initial=np.inf):.6g} Hz apart"


def _apart(message: str) -> DeckError:
    return DeckError.of("MD711", message, help="leave lines out, or give a band in which all was measured")
