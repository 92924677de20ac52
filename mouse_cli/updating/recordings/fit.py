"""What a fit of a hypothesis to recordings found."""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from mouse_cli.model.diagnosis import Cause, Size
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.hypothesis import Hypothesis


@dataclass
class Fit:
    """What a fit found. x (k,): nuisances and law; states (2n, G); covariance (k, k); misfit: chi2; log_evidence."""

    hypothesis: Hypothesis
    x: np.ndarray
    states: np.ndarray
    covariance: np.ndarray
    misfit: float
    dof: float
    cost: float
    log_evidence: float
    residual: np.ndarray = field(repr=False)
    nameless: ClassVar[None] = None  # no rival without a name is sought in recordings
    data: ClassVar[None] = None  # no errors of sensors are sought in them either
    log_places: ClassVar[float] = 0.0  # its evidence has no prior of places

    @property
    def recipes(self) -> tuple[Part, ...]:
        """Its laws at their places."""
        return self.hypothesis.parts

    def idle(self, noise: float) -> float:
        """Of its unknowns records leave none to its range."""
        return 0.0

    @property
    def groups(self) -> list[str]:
        """Groups of its laws."""
        return [cause.group for cause in self.causes]

    @property
    def calibrated(self) -> tuple[str, ...]:
        """Gains and delays of channels that were estimated, in words."""
        own = slice(self.hypothesis.offsets.stop, self.hypothesis.nuisances)
        sd = np.sqrt(np.abs(np.diag(self.covariance)))[own]
        return self.hypothesis.channels.said(self.x[own], sd)

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Its laws at their places, with their sizes, whose sd are of noise as large as what it leaves."""
        wider = np.sqrt(max(self.misfit / max(self.dof, 1), 1.0))
        sd = np.sqrt(np.abs(np.diag(self.covariance)))[self.hypothesis.nuisances :]
        found = []
        for part, p in self.hypothesis.sizes(self.x[None]):
            own, sd = sd[: len(part.unknowns)], sd[len(part.unknowns) :]
            values = zip(part.unknowns, p[:, 0], own, strict=True)
            sizes = tuple(Size(u.name, u.unit, float(v), float(wider * v * s), u.lower, u.upper) for u, v, s in values)
            group = part.law.seen_as(own)
            found.append(Cause(part.law.key, group, part.title, part.site, sizes))
        return tuple(found)
