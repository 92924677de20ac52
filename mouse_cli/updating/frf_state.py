"""Frequency response functions of the model at given values of its parameters, and their derivatives, beside its modes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.frf import Dynamics, Fields, FrfModel
from mouse_cli.dynamics.frf_basis import FINAL, ITERATING, frf_model
from mouse_cli.dynamics.frf_slopes import Change, slopes
from mouse_cli.model.arrays import Matrix
from mouse_cli.observables.frf import FrfObservable
from mouse_cli.terms.assembly import Assembly
from mouse_cli.updating.frf_gains import Gains


@dataclass(frozen=True)
class FrfSetting:
    """What stays the same of FRFs during a run: one observable a measurement; modes that a basis needs (None: all there are).

    gains: of all measurements. held: those that are predicted and not fitted.
    """

    observables: tuple[FrfObservable, ...]
    gains: Gains
    count: int | None = None
    held: tuple[FrfObservable, ...] = ()

    @property
    def everything(self) -> tuple[FrfObservable, ...]:
        """All measurements, those that are held out behind the others."""
        return self.observables + self.held

    @property
    def top(self) -> float:
        """Highest |s| of all lines, rad/s."""
        return max((float(np.abs(o.s).max(initial=0.0)) for o in self.everything), default=0.0)

    @property
    def sensings(self) -> tuple[Matrix, ...]:
        """Responses and forces of each measurement in turn."""
        return tuple(side for o in self.everything for side in (o.test.outputs, o.test.inputs))

    def data(self) -> tuple[np.ndarray, np.ndarray]:
        """y (q,) and sd (q,) of all measurements, one after the other."""
        parts = [o.measured() for o in self.observables]
        y, sd = (np.concatenate([part[k] for part in parts] or [np.zeros(0)]) for k in (0, 1))
        return y, sd

    def checked(self) -> np.ndarray:
        """Lines at which the error of a basis is found: the highest, and those of the largest responses."""
        found = []
        for o in self.everything:
            size = np.where(o.have, np.abs(o.H), 0.0).max(axis=(1, 2), initial=0.0)
            found += [o.s[int(size.argmax())], o.s[-1]] if len(o.s) else []
        return np.array(sorted(set(found), key=abs, reverse=True))


class FrfState:
    """The FRFs of a model K, M at theta (p,); built while the space of `solution` lives: the basis of a sparse one grows from it.

    final: their error is found at several lines and brought below FINAL.
    """

    def __init__(
        self,
        setting: FrfSetting,
        assembly: Assembly,
        theta: np.ndarray,
        K: Matrix,
        M: Matrix,
        solution: EigenSolution,
        final: bool = False,
    ):
        self.setting, self.assembly, self.theta = setting, assembly, theta
        checked = setting.checked()
        self.model: FrfModel = frf_model(
            Dynamics(K, M, *assembly.damping(theta)),
            setting.sensings,
            checked if final else checked[:1],
            solution,
            FINAL if final else ITERATING,
        )
        self.fields = [self.model.at(o.nodes) for o in setting.observables]
        self.receptance = [self.read(k, fields) for k, fields in enumerate(self.fields)]

    @property
    def predicted(self) -> np.ndarray:
        """The data (q,) of all measurements."""
        pairs = zip(self.setting.observables, self.receptance, strict=True)
        return np.concatenate([np.zeros(0), *(o.predicted(alpha) for o, alpha in pairs)])

    def partials(self, change: Change) -> np.ndarray:
        """T (q, p): derivatives by whatever p things `change` is by."""
        parts = zip(self.setting.observables, self.receptance, self.fields, strict=True)
        found = [o.partials(alpha, self.slopes(k, f, change, alpha), change.p) for k, (o, alpha, f) in enumerate(parts)]
        return np.concatenate([np.zeros((0, change.p)), *found])

    def everywhere(self) -> Iterator[np.ndarray]:
        """H (f, o, i) of each measurement at all of its lines, in its own kind."""
        for k, o in enumerate(self.setting.everything):
            whole = replace(o, lines=np.arange(len(o.test.omega)), width=0.0)
            with np.errstate(divide="ignore", invalid="ignore"):
                yield whole.expected(self.read(k, self.model.at(whole.nodes)))

    def read(self, k: int, fields: Fields) -> np.ndarray:
        """Receptance (n, o, i) of measurement k at the nodes of its lines, gains in it."""
        return fields.receptance(2 * k, 2 * k + 1) * self.setting.gains.factor(k, self.theta)

    def slopes(
        self, k: int, fields: Fields, change: Change, receptance: np.ndarray
    ) -> Iterator[tuple[slice, np.ndarray]]:
        """Derivatives of `receptance` (f, o, i), read of measurement k, by whatever `change` is by: some at a time, gains last."""
        factor = self.setting.gains.factor(k, self.theta)[..., None]
        for part, values in slopes(fields, change, 2 * k, 2 * k + 1):
            yield part, values * factor
        if change.p == len(self.theta):
            yield from self.setting.gains.slopes(k, self.theta, receptance)
