"""What became of a measurement of frequency response functions: one model beside it, or one before and one after."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.frf_test import FrfTest

_Z90 = 1.6448536269514722  # half width of a 90 % interval in standard deviations


@dataclass(frozen=True)
class Modelled:
    """The functions of one model: H (f, o, i), of the kind measured; sd (f, o, i) of ln|H|, by what is uncertain in it.

    key, name: which model it is, for programs and for people. sd is NaN where it was too much to compute.
    """

    key: str
    name: str
    H: np.ndarray
    sd: np.ndarray


@dataclass(frozen=True)
class FrfFit:
    """`models` at all lines of `test`, the one that explains least first.

    lines (l,): from 0, those that were fitted, in `form`, none of a measurement that is held out; have (f, o, i): values that could
    be; sd (f, o, i): standard deviation of real and imaginary part as taken; assumed: whether some of them were. basis: vectors of
    a large model's basis; basis_error: relative, of its FRFs.
    """

    test: FrfTest
    form: str
    lines: np.ndarray
    have: np.ndarray
    sd: np.ndarray
    assumed: bool
    models: tuple[Modelled, ...]
    basis: int = 0
    basis_error: float = 0.0

    @property
    def prior(self) -> np.ndarray:
        """H (f, o, i) of the first model."""
        return self.models[0].H

    @property
    def revised(self) -> np.ndarray:
        """H (f, o, i) of the last model."""
        return self.models[-1].H

    def off_db(self, model: np.ndarray) -> np.ndarray:
        """20 log10 |model / measured| (f, o, i) where there is something to compare; NaN elsewhere."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.have, 20 * np.log10(np.abs(model) / np.abs(self.test.H)), np.nan)

    def median_db(self, model: np.ndarray) -> float:
        """Median of |off_db| over everything measured, dB."""
        return float(np.nanmedian(np.abs(self.off_db(model)))) if self.have.any() else float("nan")

    def off_sd(self, model: np.ndarray) -> np.ndarray:
        """|model - measured| (f, o, i) over the root mean square that its noise has; NaN where nothing was measured."""
        with np.errstate(divide="ignore", invalid="ignore"):
            off = np.abs(model - self.test.H) / (np.sqrt(2) * self.sd)
        return np.where(np.isfinite(off), off, np.nan)

    def rms_sd(self, model: np.ndarray) -> float:
        """Root mean square of off_sd: 1 for a model that leaves noise alone; NaN where nothing was measured."""
        off = self.off_sd(model)
        return float(np.sqrt(np.nanmean(off**2))) if np.isfinite(off).any() else float("nan")

    def covered(self, model: Modelled) -> float:
        """Share of the measured |H| within the model's 90 % intervals, its own sd and that of the measurement; NaN without sd."""
        with np.errstate(divide="ignore", invalid="ignore"):
            off = np.log(np.abs(model.H) / np.abs(self.test.H))
            ratio = np.abs(off) / np.hypot(model.sd, self.sd / np.abs(self.test.H))
        ratio = ratio[self.have]
        return float((ratio <= _Z90).mean()) if len(ratio) and np.isfinite(ratio).all() else float("nan")

    def frac(self, model: np.ndarray) -> np.ndarray:
        """FRAC (o, i) of each function: |sum conj(h) g|^2 / (sum |h|^2 sum |g|^2) over its lines (Heylen and Lammens 1996)."""
        h, g = (np.where(self.have, np.where(self.have, x, 0.0), 0.0) for x in (self.test.H, model))
        size = (np.abs(h) ** 2).sum(axis=0) * (np.abs(g) ** 2).sum(axis=0)
        inner = np.abs((h.conj() * g).sum(axis=0)) ** 2
        return np.divide(inner, size, out=np.full(size.shape, np.nan), where=size > 0)

    def fdac(self, model: np.ndarray) -> np.ndarray:
        """FDAC (i,) of each force: likeness of deflections at equal frequencies, Re of it, its mean over lines (Pascual 1997).

        NaN for fewer than two responses, which have no shape.
        """
        h, g = (np.where(self.have, np.where(self.have, x, 0.0), 0.0) for x in (self.test.H, model))
        size = np.sqrt((np.abs(h) ** 2).sum(axis=1) * (np.abs(g) ** 2).sum(axis=1))
        inner = (h.conj() * g).sum(axis=1).real
        likeness = np.divide(inner, size, out=np.full(size.shape, np.nan), where=size > 0)
        if h.shape[1] < 2:
            return np.full(h.shape[2], np.nan)
        return np.array([np.nanmean(column) if np.isfinite(column).any() else np.nan for column in likeness.T])


@dataclass(frozen=True)
class Damping:
    """An amount of damping of the whole structure that functions show: value and sd in `unit`.

    determined: whether the functions tell it from none.
    """

    name: str
    meaning: str
    unit: str
    value: float
    sd: float
    determined: bool
