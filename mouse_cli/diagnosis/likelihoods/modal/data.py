"""The modal test as a diagnosis sees it: logarithms of frequencies, and shapes of unknown sign and length."""

from copy import copy
from functools import cached_property

import numpy as np

from mouse_cli.dynamics.correlation import Measured
from mouse_cli.dynamics.frequency import eigenvalue
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.theory import Theory

_UNSEEN = 1e-9  # share of the largest shape of the model below which sensors see nothing of one


class Data:
    """m modes at s sensors, q data: ln f of each mode, then its shape, over their standard deviations.

    Those are what the test states and, beside it, the errors of theory (`allowed`).

    The scale a of each shape is profiled: a = f'W y / f'W f (Golub and Pereyra 1973), unless the test states it (`scale: none`).
    beside: modes of the same sensors that are no data here, and which no mode of the model may be at once with one of these.
    """

    def __init__(self, test: ModalTest, allowed: Theory, beside: ModalTest | None = None):
        self.test, self.m, self.s, self.allowed = test, test.m, test.s, allowed
        self.has_frequency = np.isfinite(test.frequency_hz)
        self._log = 0.5 * np.log(np.where(self.has_frequency, eigenvalue(test.frequency_hz), 1.0))
        stated = np.where(self.has_frequency, test.frequency_sd_hz / test.frequency_hz, 1.0)
        self.sd_log = np.hypot(stated, allowed.frequency)
        self.has_shape = np.isfinite(test.shapes)
        shapes = np.where(self.has_shape, test.shapes, 0.0)
        sd = np.hypot(test.shape_sd, allowed.shape * np.abs(shapes).max(axis=0, initial=0.0))
        self._w = np.where(self.has_shape, 1 / np.where(self.has_shape, sd, 1.0), 0.0)
        self._y = shapes * self._w
        self.scaled = test.scale != "none"
        self.slack = 0.0  # by which log_sd is larger than that of the test as it was
        self.by_shape = self.has_shape.size > 0 and int(self.has_shape.sum(axis=0).min()) >= 2
        every = [test] if beside is None else [test, beside]
        shapes, hz, number = (np.concatenate([getattr(one, name) for one in every], axis=-1)
                              for name in ("shapes", "frequency_hz", "number"))  # fmt: skip
        self._measured = Measured(shapes, hz)
        self._last = 2 * int(number.max(initial=0)) + 6
        self._rigid = 1e-3 * np.nanmin(hz, initial=np.inf)
        self._whole = bool(self.has_frequency.all() and self.has_shape.all())

    def loosened(self, of_frequencies: np.ndarray, of_shapes: np.ndarray) -> "Data":
        """The same data with further errors: sd of ln f (m,), and of shapes (s, m) at their own scale."""
        found = self._at(np.hypot(self.sd_log, of_frequencies))
        sd = np.hypot(1 / np.where(self.has_shape, self._w, 1.0), of_shapes)
        found._w = np.where(self.has_shape, 1 / sd, 0.0)
        found._y = np.nan_to_num(self.test.shapes) * found._w
        found.slack = found.log_sd - (self.log_sd - self.slack)
        return found

    def sharpened(self, known: np.ndarray) -> "Data":
        """The same data without the errors `known` (m,), sd of ln f, where these are unknowns of their own."""
        found = self._at(np.sqrt(np.maximum(self.sd_log**2 - known**2, (1e-3 * self.sd_log) ** 2)))
        found.slack += found.log_sd - self.log_sd
        return found

    def _at(self, sd_log: np.ndarray) -> "Data":
        """The same data at other sd of ln f (m,)."""
        found = copy(self)
        found.__dict__.pop("theory", None)
        found.sd_log = sd_log
        return found

    @cached_property
    def theory(self) -> np.ndarray:
        """sd of ln f (m,) beside that of the measurement: what theory and numerics leave; theory alone where none was measured."""
        with np.errstate(invalid="ignore"):
            stated = np.where(self.has_frequency, self.test.frequency_sd_hz / self.test.frequency_hz, 1.0)
        least = self.allowed.frequency
        return np.where(self.has_frequency, np.sqrt(np.maximum(self.sd_log**2 - stated**2, least**2)), least)

    @cached_property
    def modes(self) -> np.ndarray:
        """Mode (q,), by its place in the test, that each of the data is of."""
        own = np.broadcast_to(np.arange(self.m), (self.s, self.m))
        return self._stacked(np.arange(self.m), own)

    @property
    def dof(self) -> int:
        """Data less the scales that are fitted to them."""
        profiled = int(self.has_shape.any(axis=0).sum()) if self.scaled else 0
        return int(self.has_frequency.sum() + self.has_shape.sum()) - profiled

    @property
    def log_sd(self) -> float:
        """sum ln(sqrt(2 pi) sd) over the data: what a log density has beside the whitened residual."""
        sd = np.concatenate([self.sd_log[self.has_frequency], 1 / self._w[self.has_shape]])
        return float(np.sum(np.log(np.sqrt(2 * np.pi) * sd)))

    def pair(self, eigenvalues: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """Index (m,) of the model mode that each measured one is, for shapes `seen` (s, k): by shape, or by number; k or more of
        one that the model has not.
        """
        if not self.by_shape:
            return self.test.number - 1
        reach = min(len(eigenvalues), self._last)
        hz = np.sqrt(np.maximum(eigenvalues[:reach], 0.0)) / (2 * np.pi)
        hz[hz < self._rigid] = 0.0
        return self._measured.pair(seen[:, :reach], hz)[: self.m]

    def residual(self, eigenvalues: np.ndarray, seen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Whitened residual (q,), measured minus model, for eigenvalues (m,) and shapes `seen` (s, m); scales a (m,)."""
        return self._left(eigenvalues, seen * self._w, self._y)

    def residual_beside(
        self, eigenvalues: np.ndarray, seen: np.ndarray, modes: np.ndarray, sd: np.ndarray
    ) -> np.ndarray:
        """Whitened residual (q,) for shapes `seen` (s, k) of all modes, if each of `modes` (m,) has sd (m, k) of them in it.

        S^-1/2 (y - a f), S = I + |y|^2 / |f|^2 F sd^2 F', for each measured shape y, its mode f and all modes F, over the sd of
        the data.
        """
        f, y, near = (seen[:, modes] * self._w).T, self._y.T, sd.any(axis=0)
        size = np.linalg.norm(f, axis=1)
        length = np.linalg.norm(y, axis=1) / np.maximum(size, max(_UNSEEN * size.max(), 1e-100))
        F = self._w.T[:, :, None] * seen[:, near] * (length[:, None] * sd[:, near])[:, None]
        f, y = np.moveaxis(whitened(F, np.stack([f, y], axis=2)), 2, 0)
        return self._left(eigenvalues[modes], f.T, y.T)[0]

    def _left(self, eigenvalues: np.ndarray, f: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As `residual`, for shapes f of the model and y of the test (s, m), whitened."""
        off = (self._log - 0.5 * np.log(np.maximum(eigenvalues, 1e-300))) / self.sd_log
        size = np.einsum("sm,sm->m", f, f)
        along = np.einsum("sm,sm->m", f, y)
        fitted = np.divide(along, size, out=np.zeros(self.m), where=size > 0)
        a = fitted if self.scaled else np.where(along < 0, -1.0, 1.0)
        return self._stacked(off, y - a * f), a

    def scale_sd(self, seen: np.ndarray) -> np.ndarray:
        """Standard deviation (m,) of the scale a that is fitted to shapes `seen` (s, m); 0 where the test states it."""
        size = np.einsum("sm,sm->m", seen * self._w, seen * self._w)
        return np.where(self.scaled & (size > 0), 1 / np.sqrt(np.maximum(size, 1e-300)), 0.0)

    def jacobian(self, eigenvalues, seen, a, d_eigenvalues, d_seen) -> np.ndarray:
        """d(prediction)/dx (q, k), whitened, for derivatives d_eigenvalues (m, k) and d_seen (s, m, k)."""
        d_log = 0.5 * d_eigenvalues / np.maximum(eigenvalues, 1e-300)[:, None] / self.sd_log[:, None]
        f, moved = seen * self._w, d_seen * (a * self._w)[:, :, None]
        if self.scaled:
            size = np.maximum(np.einsum("sm,sm->m", f, f), 1e-300)
            moved = moved - f[:, :, None] * (np.einsum("sm,smk->mk", f, moved) / size[:, None])
        return self._stacked(d_log, moved)

    def _stacked(self, of_frequencies: np.ndarray, of_shapes: np.ndarray) -> np.ndarray:
        if self._whole:
            return np.concatenate([of_frequencies, of_shapes.reshape(self.s * self.m, *of_shapes.shape[2:])])
        return np.concatenate([of_frequencies[self.has_frequency], of_shapes[self.has_shape]])


def whitened(wide: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(I + A A')^-1/2 times values (..., q, n), for A (..., q, c) = `wide`, by the smaller of A'A and A A'.

    I - A h(A'A) A', h(x) = 1 / (sqrt(1 + x) (1 + sqrt(1 + x))), which vanish together.
    """
    wide_t = np.swapaxes(wide, -1, -2)
    if wide.shape[-1] >= wide.shape[-2]:
        x, U = np.linalg.eigh(wide @ wide_t)
        return U @ ((np.swapaxes(U, -1, -2) @ values) / np.sqrt(1 + np.maximum(x, 0.0))[..., None])
    x, U = np.linalg.eigh(wide_t @ wide)
    B, length = wide @ U, np.sqrt(1 + np.maximum(x, 0.0))
    return values - B @ ((np.swapaxes(B, -1, -2) @ values) / (length * (1 + length))[..., None])
