"""A smooth random field over the cells of a structure, fitted beside the parameters of the deck.

v (c,), the relative change in each cell, is Gaussian with covariance s^2 exp(-d^2 / 2 l^2), d between cells. With the leading
eigenvectors of that, v = s P w, w ~ N(0, I): as many unknowns more, in which K or M is linear. The evidence of each spread s and
correlation length l is Laplace's; they are integrated over a grid, all alike beforehand.
"""

from dataclasses import dataclass, replace

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import Reduced
from mouse_cli.diagnosis.nameless import Nameless
from mouse_cli.diagnosis.nameless._cells import Cells
from mouse_cli.diagnosis.nameless._correlated import affine

LENGTHS = (0.08, 0.2, 0.5, np.inf)  # correlation lengths, of the extent of the cells; infinite: a gradient
MOTIONS = (0.2, 0.5, np.inf)  # those of a motion about one that is affine; infinite: it is affine
_LINEAR = 2  # unknowns of a constant and a slope


@dataclass(frozen=True)
class Smooth:
    """A field of one kind: rival; cells; P (c, w), its spread in it; spread s; length l in the unit of the cells.

    sign: of a change of rank one; 0: the change is in proportion to the field.
    """

    rival: Nameless
    cells: Cells
    P: np.ndarray
    spread: float
    length: float
    sign: int = 0

    def values(self, w: np.ndarray) -> np.ndarray:
        """Relative changes (c,) at w (w,)."""
        return self.P @ w


def smooth(rival: Nameless, cells: Cells, spread: float, share: float, sign: int = 0) -> Smooth:
    """The field of that spread, correlated over that share of the extent of its cells."""
    if rival.signs and not (cells.rigid and np.isinf(share)):
        rival = replace(rival, even="")  # no motion of the whole as one body
    length, P = (share, affine(cells.at)) if np.isinf(share) else cells.correlated(share)
    if rival.gradient and np.isinf(share) and np.linalg.matrix_rank(P) == _LINEAR:
        rival = replace(rival, even=rival.gradient)
    P = np.hstack([affine(cells.at), P]) if rival.signs and np.isfinite(share) else P
    return Smooth(rival, cells, spread * P, spread, length, sign)


@dataclass(frozen=True, kw_only=True)
class Fielded(Reduced):
    """A reduced model with a field in it: z = [z of the deck (k,), w]. of_field (w, r, r): what each w adds to K or M; with_it: to
    M, where both change; None: one does.
    """

    nameless: Smooth
    of_field: np.ndarray
    with_it: np.ndarray | None = None

    @property
    def _added(self) -> dict[str, np.ndarray]:
        """What each w adds (w, r, r), by matrix."""
        own = {self.nameless.cells.into: self.of_field}
        return own if self.with_it is None else own | {"M": self.with_it}

    @property
    def deck(self) -> int:
        """How many of z are of the deck."""
        return super().L.shape[1]

    @property
    def L(self) -> np.ndarray:
        """Root (p, k + w) of the prior of the deck's parameters, which do not follow the field."""
        own = super().L
        return np.hstack([own, np.zeros((len(own), len(self.of_field)))])

    def matrices(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """K and M (r, r) at z."""
        found = dict(zip("KM", super().matrices(z), strict=True))
        for into, added in self._added.items():
            found[into] = found[into] + np.tensordot(z[self.deck :], added, 1)
        return found["K"], found["M"]

    def slopes(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz and dM/dz (k + w, r, r)."""
        found = dict(zip("KM", super().slopes(z), strict=True))
        for into, added in self._added.items():
            found[into][self.deck :] = added
        return found["K"], found["M"]

    def moved(self, z: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """dK/dz u and dM/dz u (k + w, r, m) for motion u (r, m)."""
        found = dict(zip("KM", super().moved(z, u), strict=True))
        for into, added in self._added.items():
            found[into][self.deck :] = added @ u
        return found["K"], found["M"]

    def bare(self, z: np.ndarray) -> np.ndarray:
        """z (k + w,) without the field."""
        return np.append(z[: self.deck], np.zeros(len(z) - self.deck))

    def at(self, theta: np.ndarray) -> "Fielded":
        """Itself: a field is of the model as it is."""
        return self


def fielded(base: Reduced, field: Smooth, cells: Cells | None) -> Fielded:
    """`base` with a field in it, in `cells` of its own that are those of the field; None: it does not have it."""
    own = {name: getattr(base, name) for name in Reduced.__dataclass_fields__}
    empty = np.zeros((field.P.shape[1], base.r, base.r))
    if cells is None:
        return Fielded(**own, nameless=field, of_field=empty)
    beside = cells.beside and cells.beside.summed(field.P)
    return Fielded(**own, nameless=field, of_field=cells.summed(field.P), with_it=beside)
