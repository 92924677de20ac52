"""What became of a measurement of frequency response functions: the model before and after the revision beside it."""

from dataclasses import dataclass

import numpy as np

from mouse_cli.model.frf_test import FrfTest


@dataclass(frozen=True)
class FrfFit:
    """Prior and revised H (f, o, i) at all lines of `test`, of its kind.

    lines (l,): from 0, those that were fitted, in `form`; have (f, o, i): values that could be; sd (f, o, i): standard deviation
    of real and imaginary part as taken; assumed: whether some of them were. prior_sd, revised_sd (f, o, i): of ln|H|, from the
    covariance of the parameters; NaN where that was too much to compute. basis_error: relative, of the FRFs of a large model.
    """

    test: FrfTest
    form: str
    lines: np.ndarray
    have: np.ndarray
    sd: np.ndarray
    assumed: bool
    prior: np.ndarray
    revised: np.ndarray
    prior_sd: np.ndarray
    revised_sd: np.ndarray
    basis: int = 0
    basis_error: float = 0.0

    def off_db(self, model: np.ndarray) -> np.ndarray:
        """20 log10 |model / measured| (f, o, i) where there is something to compare; NaN elsewhere."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.have, 20 * np.log10(np.abs(model) / np.abs(self.test.H)), np.nan)

    def median_db(self, model: np.ndarray) -> float:
        """Median of |off_db| over everything measured, dB."""
        return float(np.nanmedian(np.abs(self.off_db(model)))) if self.have.any() else float("nan")

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
