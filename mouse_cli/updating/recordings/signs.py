"""Signs of nonlinearity in the records of a deck; see records.linearity. They are told and decide nothing."""

import numpy as np

from mouse_cli.model.record_diagnosis import LevelSign, Linearity
from mouse_cli.records.linearity import distortion, incoherent, period
from mouse_cli.updating.recordings.fit import Fit
from mouse_cli.updating.recordings.polish import Polish
from mouse_cli.updating.recordings.segments import Segments
from mouse_cli.updating.recordings.study import Study, begin

_STEPS = 8


def linearity(study: Study, baseline: Fit) -> Linearity:
    """All signs that the records give."""
    series = study.look
    levels = _levels(study, baseline)
    if series.force.shape[1] != 1:
        return Linearity(levels=levels)
    force, response = series.force[:, 0], series.measured[:, 0]
    struck = not np.median(np.abs(force - np.median(force)))  # blocks between strokes have no force to be coherent with
    share, length = np.nan if struck else incoherent(force, response, series.dt), period(force)
    found = None if length is None else distortion(force, response, length)
    if found is None:
        return Linearity(share, levels=levels)
    return Linearity(share, found.even / found.excited, found.odd / found.excited, found.noise / found.excited, levels)


def _levels(study: Study, baseline: Fit) -> tuple[LevelSign, ...]:
    """The linear model fitted to the quietest and to the loudest third of the segments of one record."""
    data = study.data[0]
    rms = np.sqrt((data.measured**2).mean(axis=(0, 1)))
    order, third = np.argsort(rms), max(1, len(rms) // 3)
    if len(rms) < 3:
        return ()
    found = []
    for own in (np.sort(order[:third]), np.sort(order[-third:])):
        part = Segments(data.series, data.starts[own], data.length)
        look = study.at(study.places[0], data.series)
        fit = Polish(study.base, [part], look.spread).fit(
            baseline.x, *begin(study.base, baseline.x, [part], [look]), steps=_STEPS
        )
        if fit is not None:
            size = float(np.sqrt((part.measured[0] ** 2).mean()) * data.series.sd[0])
            found.append(LevelSign(size, *_resonance(study, fit)))
    return tuple(found) if len(found) == 2 else ()


def _resonance(study: Study, fit: Fit) -> tuple[float, float]:
    """The lowest natural frequency in the band in Hz, and its damping ratio."""
    M, C, K = (m[0] for m in study.base.linear.matrices(fit.x[None, : study.base.linear.k]))
    n = len(M)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    poles = np.linalg.eigvals(A)
    poles = poles[(poles.imag > 0) & (np.abs(poles) > np.pi * study.band[0])]
    if not len(poles):
        return float("nan"), float("nan")
    first = poles[np.argmin(np.abs(poles))]
    return float(np.abs(first) / (2 * np.pi)), float(-first.real / np.abs(first))
