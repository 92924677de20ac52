"""Finite elements of plane bars, own and in numpy: bending, shear, axial force, bed, all varying along a bar.

w and the turn theta of the section by the interdependent polynomials of Timoshenko's bar (Przemieniecki 1968, sect. 5.6; without
shear they are Hermite's), integrated by four Gauss points. Truths use four of these to one of a deck.
"""

import numpy as np

from benchmarks.trials.assembly import Assembly

_POINT, _SHARE = np.polynomial.legendre.leggauss(4)
GAUSS, SHARE = (_POINT + 1) / 2, _SHARE / 2


class Bars(Assembly):
    """Bars between points (n, 2) in m; degrees of freedom 3 i, 3 i + 1, 3 i + 2: ux, uy and the turn of point i.

    Fields (e, 4) at the Gauss points of each element: EI (N m2), EA (N), m (kg/m), rotary (kg m), GA (N, infinite: no shear),
    axial (N, tension positive), bed (N/m2); `along` (e, 4) is the distance from the beginning of the member in m.
    """

    def __init__(self, points: np.ndarray, ends: np.ndarray, along: np.ndarray) -> None:
        self.points, self.ends = points, ends
        step = points[ends[:, 1]] - points[ends[:, 0]]
        self.length = np.hypot(*step.T)
        self.cosine, self.sine = (step / self.length[:, None]).T
        self.along = along[:, None] + self.length[:, None] * GAUSS
        self.dofs = np.concatenate([3 * ends[:, :1] + range(3), 3 * ends[:, 1:] + range(3)], axis=1)
        flat = np.zeros_like(self.along)
        self.EI, self.EA, self.m, self.rotary, self.axial, self.bed = (flat.copy() for _ in range(6))
        self.GA = flat + np.inf
        super().__init__(np.zeros((3 * len(points),) * 2), np.zeros((3 * len(points),) * 2))

    def where(self) -> np.ndarray:
        """Coordinates (e, 4, 2) of the Gauss points."""
        first = self.points[self.ends[:, 0]][:, None]
        step = self.length[:, None] * GAUSS
        return first + np.stack([step * self.cosine[:, None], step * self.sine[:, None]], axis=2)

    def scale(self, names: tuple[str, ...], own: np.ndarray, factor: float) -> None:
        """Multiplies fields of the elements or Gauss points `own`, a mask."""
        for name in names:
            getattr(self, name)[own] *= factor

    def hinge(self, element: int, end: int, k: float) -> None:
        """The end (0 or 1) of an element turns against its point, with k in N m/rad."""
        point = int(self.dofs[element, 3 * end + 2])
        own = self.new_dof()
        self.dofs[element, 3 * end + 2] = own
        self.spring({own: 1.0, point: -1.0}, k)

    def core(self) -> tuple[np.ndarray, np.ndarray]:
        """K and M of all elements."""
        K, M = np.zeros((self.n, self.n)), np.zeros((self.n, self.n))
        for matrix, own in zip((K, M), self._elements(), strict=True):
            np.add.at(matrix, (self.dofs[:, :, None], self.dofs[:, None, :]), own)
        return K, M

    def _elements(self) -> tuple[np.ndarray, np.ndarray]:
        """K and M (e, 6, 6) of the elements along global directions."""
        l, one = self.length, np.ones((len(self.length), 4))
        weight = SHARE * l[:, None]
        phi = 12 * self.EI.mean(axis=1) / (self.GA.mean(axis=1) * l**2)
        w, slope, turn, bend = _polynomials(l, phi)
        u = np.zeros((len(l), 4, 6))
        u[..., 0], u[..., 3] = 1 - GAUSS, GAUSS
        du = np.zeros((len(l), 4, 6))
        du[..., 0], du[..., 3] = -one / l[:, None], one / l[:, None]
        total = lambda field, a: np.einsum("eg,egi,egj->eij", weight * field, a, a)
        K = total(self.EI, bend) + total(self.EA, du) + total(self.axial, slope) + total(self.bed, w)
        K += total(np.where(np.isfinite(self.GA), self.GA, 0.0), slope - turn)
        M = total(self.m, w) + total(self.m, u) + total(self.rotary, turn)
        c, s, T = self.cosine, self.sine, np.zeros((len(l), 6, 6))
        for i in (0, 3):
            T[:, i, i], T[:, i, i + 1], T[:, i + 1, i], T[:, i + 1, i + 1], T[:, i + 2, i + 2] = c, s, -s, c, 1.0
        turned = lambda A: np.einsum("eki,ekl,elj->eij", T, A, T)
        return turned(K), turned(M)


def _polynomials(l: np.ndarray, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """w, w', theta and theta' (e, 4, 6) of the six displacements of an element, at its Gauss points."""
    x, l, p = GAUSS[None], l[:, None], phi[:, None]
    zero, share = 0 * x * l, 1 / (1 + p)
    w = [1 - 3 * x**2 + 2 * x**3 + p * (1 - x), l * (x - 2 * x**2 + x**3 + p * (x - x**2) / 2),
         3 * x**2 - 2 * x**3 + p * x, l * (-(x**2) + x**3 + p * (x**2 - x) / 2)]  # fmt: skip
    slope = [(-6 * x + 6 * x**2 - p) / l, 1 - 4 * x + 3 * x**2 + p * (1 - 2 * x) / 2,
             (6 * x - 6 * x**2 + p) / l, -2 * x + 3 * x**2 + p * (2 * x - 1) / 2]  # fmt: skip
    turn = [6 * (x**2 - x) / l, 1 - 4 * x + 3 * x**2 + p * (1 - x),
            6 * (x - x**2) / l, 3 * x**2 - 2 * x + p * x]  # fmt: skip
    bend = [(12 * x - 6) / l**2, (6 * x - 4 - p) / l, (6 - 12 * x) / l**2, (6 * x - 2 + p) / l]
    six = lambda f: np.stack([zero, f[0] * share, f[1] * share, zero, f[2] * share, f[3] * share], axis=2)
    return six(w), six(slope), six(turn), six(bend)
