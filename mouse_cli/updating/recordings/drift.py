"""What drifts while it is recorded: a bolt that works loose, a structure that warms up, a joint that dries, a tank that fills.

A parameter p(t) of the model asks for the force -(dK u + dC u' + dM a) (p(t) - p), u that of the record: linear in its path p(t).
"""

from dataclasses import dataclass

import numpy as np

from mouse_cli.updating.recordings.regression import Regression
from mouse_cli.updating.recordings.study import Study

_LEAST = 0.9  # share of what is left that a drift takes
_ALIKE = 1.5  # times what the best one leaves, up to which another parameter may be what drifts
_DEGREE = 3  # of the path in time
_LEVELS, _PARTS = 1.5, 3  # ratio of the rms of parts of a record, up to which what depends on the level is no drift
_ACROSS = 3  # motions through which the force of a parameter acts, at most


@dataclass(frozen=True)
class Drift:
    """names: of the parameter, and of others that would do; ends: at the beginning and the end, in words; share of what is left."""

    names: tuple[str, ...]
    ends: tuple[str, str]
    samples: int
    share: float

    def said(self) -> str:
        """What it is, in a sentence."""
        name, *others = self.names
        rivals = f" (or {', '.join(others)}, which would do as well)" if others else ""
        begin, end = self.ends
        return (
            f"The structure drifts while it is recorded: {name}{rivals} goes from {begin} to {end} in {self.samples} samples, "
            f"and that takes {100 * self.share:.3g} % of what the model leaves. What works loose, warms up, dries or fills does "
            "so, and no law of its motion does. These values are of a first look, without a standard deviation: record again "
            "when it has settled, or diagnose short parts, each by itself (segment)."
        )


def drift(own: Study) -> Drift | None:
    """The parameter whose drift takes most of what is left of the loudest record; None: none takes enough.

    What depends on the level of the motion drifts with it where the level does.
    """
    series = own.look
    if series.free or series.slow or not _steady(series.measured / series.sd):
        return None
    at = own.at(own.places[0])
    found = [(*_taken(at, j), j) for j in range(own.base.linear.k)]
    share, path, j = max(found, key=lambda one: one[0], default=(0.0, np.zeros(2), 0))
    if share < _LEAST:
        return None
    alike = sorted((one for one in found if 1 - one[0] <= _ALIKE * (1 - share)), key=lambda one: -one[0])
    z = at.begin(np.zeros_like(at.y), np.zeros(0))[0][: own.base.linear.k]
    names = tuple(own.base.linear.names[i] for *_, i in alike)
    return Drift(names, tuple(_value(own, z, j, float(path[i])) for i in (0, -1)), len(series), share)


def _steady(measured: np.ndarray) -> bool:
    """Whether outputs (t, s) are as loud in each part of the record."""
    rms = [float(np.sqrt((part**2).mean())) for part in np.array_split(measured, _PARTS)]
    return max(rms) < _LEVELS * min(rms)


def _taken(at: Regression, j: int) -> tuple[float, np.ndarray]:
    """Share of what is left that a path of nuisance j takes, and its distance (t,) from the value that is the same throughout."""
    s, w = at.spectrum, at.spectrum.w[:, None]
    dM, dC, dK = (slopes[j] for slopes in at.base.linear.slopes)
    across, size, _ = np.linalg.svd(np.hstack([dK, dC, dM]))
    U = s.motions(across[:, : min(_ACROSS, int((size > 1e-9 * size[0]).sum()))])
    a = -(w**2) * U + (0.0 if s.carried is None else s.carried)
    force = s.history(U @ dK.T + 1j * w * (U @ dC.T) + a @ dM.T)
    powers = np.polynomial.legendre.legvander(np.linspace(-1, 1, len(force)), _DEGREE)[:, 1:]
    lines = (s.line(power[:, None] * force * s.window[:, None]) for power in powers.T)
    share, sizes = at.taken([at.stacked(s.history(-np.einsum("lsn,ln->ls", s.SH, F)) * s.window[:, None]) for F in lines])
    return share, powers @ sizes


def _value(own: Study, z: np.ndarray, j: int, by: float) -> str:
    """Nuisance j of z (k,) moved `by` so many prior sd, as a parameter of the deck or in sd."""
    moved = z + by * np.eye(len(z))[j]
    if own.base.linear.names[j] in (names := [one.name for one in own.problem.parameters]):
        i = names.index(own.base.linear.names[j])
        return f"{own.model.theta(moved[: own.model.own])[i]:.4g} {own.problem.parameters[i].unit}".strip()
    return f"{moved[j]:+.1f} prior sd"
