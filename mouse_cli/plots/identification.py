"""Figures of a modal identification."""

from typing import Any

import numpy as np

from mouse_cli.model.identification import Identification
from mouse_cli.plots import AFTER, BEFORE, Plot, labelled
from mouse_cli.plots._functions import unbroken


def stabilisation(found: Identification, axes: Any) -> bool:
    """Stable poles filled, others as points; lines at identified modes; the level behind."""
    seen = found.diagram
    if not len(seen.order):
        return False
    if len(seen.line_hz):
        behind = axes.twinx()
        behind.semilogy(seen.line_hz, np.where(seen.level > 0, seen.level, np.nan), color=BEFORE, linewidth=0.7)
        behind.set_ylabel("root mean square of all channels")
        behind.grid(visible=False)
    other, stable = ~seen.stable, seen.stable
    axes.plot(seen.frequency_hz[other], seen.order[other], ".", color="0.6", markersize=2, label="pole")
    axes.plot(seen.frequency_hz[stable], seen.order[stable], "o", color=AFTER, markersize=3, label="stable pole")
    for hz in found.modes.frequency_hz:
        axes.axvline(hz, color="black", linewidth=0.7, linestyle="--")
    axes.set_xlim(*found.band_hz)
    axes.set_xlabel("frequency, Hz")
    axes.set_ylabel("order")
    axes.legend(loc="upper right")
    return True


_MOST = 3


def frf_fit(found: Identification, axes: Any) -> bool:
    """Magnitudes over frequency: measured, fitted, and the error of the fit."""
    fit = found.fit
    if fit is None:
        return False
    size = np.nanmax(np.abs(fit.measured), axis=0)
    strongest = np.argsort(size, axis=None)[::-1][:_MOST]
    shades = ("0.35", "0.55", "0.72")
    hz = unbroken(fit.frequency_hz)
    for shade, k in zip(shades, strongest, strict=False):
        o, i = np.unravel_index(k, size.shape)
        name = f"{_name(fit.outputs, o)} / {_name(fit.inputs, i)}"
        axes.semilogy(hz, np.abs(fit.measured[:, o, i]), color=shade, linewidth=1.6, label=name)
        axes.semilogy(hz, np.abs(fit.fitted[:, o, i]), color=AFTER, linewidth=0.8)
    axes.plot([], [], color=AFTER, linewidth=0.8, label="fitted")
    axes.set_xlim(*found.band_hz)
    return labelled(axes, "frequency, Hz", fit.kind, 4)


def _name(names: tuple[str, ...], k: int) -> str:
    return names[k] if k < len(names) else str(k + 1)


PLOTS = (
    Plot("stabilisation", 110, "Stabilisation diagram", stabilisation, (Identification,)),
    Plot("frf-fit", 120, "Functions, measured and fitted", frf_fit, (Identification,)),
)
