"""Frequency response functions as a diagnosis sees them: real and imaginary parts over their standard deviations."""

from dataclasses import dataclass, field, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.data import Data
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.model.frf_test import MOST_LINES, FrfTest
from mouse_cli.model.theory import Theory
from mouse_cli.observables.frf import observe
from mouse_cli.observables.frf_leakage import AtNodes, Leakage, of_window
from mouse_cli.observables.frf_smoothing import smoothed

# Values of one measurement, and its lines, at least and at most
_VALUES, _FEW, _MOST = 4000, MOST_LINES, 2 * MOST_LINES
_EVEN = 1e-3  # of the spacing of lines, by which that of one block may scatter


@dataclass(frozen=True)
class Lines(AtNodes):
    """f lines of o responses to i forces: s (f,), rad/s; H, sd (f, o, i), sd of the real and of the imaginary part.

    has (f, o, i): what was measured. leakage: what H1 makes of the functions of a model; None: nothing. assumed: no accuracy was
    stated.
    """

    test: FrfTest
    s: np.ndarray
    H: np.ndarray
    sd: np.ndarray
    has: np.ndarray
    leakage: Leakage | None = None
    assumed: bool = False

    @property
    def omega(self) -> np.ndarray:
        """rad/s (f,)."""
        return self.s.imag

    def every(self, count: int) -> "Lines":
        """Every so manieth line of them."""
        own = {name: getattr(self, name)[::count] for name in ("s", "H", "sd", "has")}
        return replace(self, **own, leakage=of_window(self.test, own["s"]))

    def windowed(self, name: str) -> "Lines":
        """The same as H1 of blocks of that window, as long as the spacing of the lines says; itself where more is stated."""
        apart = np.diff(self.test.frequency_hz)
        even = len(apart) > 0 and float(np.ptp(apart)) < _EVEN * float(apart.min(initial=np.inf))
        if self.test.window is not None or self.test.decay_rate or not even:
            return self
        test = replace(self.test, window=BlockWindow(name, 1 / float(np.median(apart))))
        return replace(self, test=test, leakage=of_window(test, self.s))

    def broadened(self, width: float) -> "Lines":
        """The same functions with every resonance as broad as by a damping ratio larger by `width`, known to some per cent."""
        seen = smoothed(self.test, width)
        H, sd = (np.where(seen.have, each, other) for each, other in ((seen.H, 0.0), (seen.sd, 1.0)))
        return replace(self, s=seen.s, H=H, sd=sd, has=seen.have, leakage=None)

    def whitened(self, H: np.ndarray) -> np.ndarray:
        """Real and imaginary parts (..., 2 q) of what was measured of H (..., f, o, i), over their standard deviations."""
        measured, sd = (H, self.sd) if self.has.all() else (H[..., self.has], self.sd[self.has])
        measured = measured.reshape(*H.shape[:-3], sd.size)
        return np.concatenate([measured.real / sd.ravel(), measured.imag / sd.ravel()], axis=-1)


def lines(test: FrfTest, theory: Theory) -> Lines:
    """The lines of `test` that tell most, as a run chooses them, but more of them; with what theory leaves of shapes."""
    most = int(np.clip(_VALUES / (test.H.shape[1] * test.H.shape[2]), _FEW, _MOST))
    seen = observe(replace(test, lines=max(test.lines, most)), "complex")
    H = np.where(seen.have, seen.H, 0.0)
    sd = np.where(seen.have, np.hypot(seen.sd, theory.shape / np.sqrt(2) * _largest(H)), 1.0)
    return Lines(test, seen.s, H, sd, seen.have, seen.leakage, seen.assumed)


def _largest(H: np.ndarray) -> np.ndarray:
    """|H| (f, o, i) as large as that of the response that is largest at its line, each beside its own mean square."""
    size = np.sqrt((np.abs(H) ** 2).mean(axis=0))
    share = np.divide(np.abs(H), size, out=np.zeros(H.shape), where=size > 0)
    return size * share.max(axis=1, keepdims=True)


@dataclass(frozen=True)
class FrfData:
    """All FRFs of a diagnosis. theory (c,): sd of ln f of the lowest modes by what theory and mesh leave. alike: how many data say
    the same. scale: of the variances, over what they were held to be. late: sd (s) of delays of responses; 0: they have none.
    modes: measured beside them, their accuracies those of the test, as `theory` is that of both.
    """

    blocks: tuple[Lines, ...]
    theory: np.ndarray = field(default_factory=lambda: np.zeros(0))
    alike: float = 1.0
    scale: float = 1.0
    late: float = 0.0
    modes: Data | None = None
    by_shape: bool = True  # modes are told apart by what several sensors read

    @property
    def dof(self) -> int:
        """Real numbers measured, those that say the same counted once."""
        functions = int(2 * sum(block.has.sum() for block in self.blocks) / self.alike)
        return functions + (self.modes.dof if self.modes else 0)

    @property
    def slack(self) -> float:
        """That of the modes: no value of a function is made less accurate between rivals."""
        return self.modes.slack if self.modes else 0.0

    @property
    def assumed(self) -> bool:
        """Whether no accuracy was stated for some of them."""
        return any(block.assumed for block in self.blocks)

    def reweighted(self, alike: float, scale: float) -> "FrfData":
        """The same where `alike` data say the same, and variances are `scale` times what they were held to be."""
        more = np.sqrt(alike * scale)
        blocks = tuple(replace(block, sd=block.sd * more) for block in self.blocks)
        return replace(self, blocks=blocks, alike=self.alike * alike, scale=self.scale * scale)

    def delayed(self) -> "FrfData":
        """The same where responses may be late, sd a radian at the highest line."""
        return replace(self, late=1 / max(float(block.omega.max()) for block in self.blocks))

    @property
    def middle(self) -> float:
        """omega_0 (rad/s), the middle of the band on a logarithmic scale."""
        omega = np.concatenate([block.omega for block in self.blocks])
        return float(np.sqrt(omega.min() * omega.max()))
