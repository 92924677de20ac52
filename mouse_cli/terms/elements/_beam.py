"""Algebra of straight two-node elements: local axes, offsets, releases, and the shapes that they bend in.

Local directions: x from end 1 to end 2; y in the plane of x and the option `orientation`, or without one horizontal, z x x
with z the global Z (global Y where the element stands upright), so that local z is the upward side; z = x x y.
Bending in the local x-y plane has Iz and kappa_y, in the x-z plane Iy and kappa_z.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from mouse_cli.terms.elements import END_DIRECTIONS, END_VECTORS, VECTOR, Layout, Matrices, Option
from mouse_cli.terms.elements._axes import DIRECTIONS, arm, unit

ORIENTATION = {
    "orientation": Option(
        "vector in the local x-y plane; none: local y is horizontal (global Y where the element is upright)",
        None,
        form=VECTOR,
    ),
}
OFFSETS = {"offsets": Option("global vectors in m from a node to the end of the element there", None, form=END_VECTORS)}
RELEASES = {"releases": Option("local directions in which an end carries no load", None, form=END_DIRECTIONS)}
TRANSLATIONAL = "translational"
AT_ENDS = ("lumped", TRANSLATIONAL)  # mass matrices with half of a beam at each end
PLANES = (  # of bending: local degrees of freedom w1, slope1, w2, slope2, and the sense in which they count
    (np.array([1, 5, 7, 11]), np.array([1.0, 1.0, 1.0, 1.0])),
    (np.array([2, 4, 8, 10]), np.array([1.0, -1.0, 1.0, -1.0])),
)
_SINGULAR = 1e-10  # of eigenvalues of a matrix with unit diagonal
_SHEARED = np.sqrt(2) - 1  # see `inertial`
# Gauss and Legendre's four points (Abramowitz and Stegun 25.4.29), exact to degree 7; products of shapes have degree 6
POINTS = (1 + np.sqrt(3 / 7 + 2 / 7 * np.sqrt(1.2) * np.array([1, -1, -1, 1])) * np.array([-1, -1, 1, 1])) / 2
WEIGHTS = (18 - np.sqrt(30) * np.array([1, -1, -1, 1])) / 72
_POWERS = np.array([2, 3, 2, 3])  # of the length in integrals of shapes that have their derivatives at the ends
CUBIC = np.array(
    [[1.0, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1]]
)  # shapes on a unit length, by powers of x


@dataclass(frozen=True)
class Span:
    """length (e,) in m; axes (e, 3, 3), rows local x, y, z; motion (e, 12, 12): of the ends, local, from that of the nodes."""

    length: np.ndarray
    axes: np.ndarray
    motion: np.ndarray


def span(layout: Layout) -> Span:
    """Length, local axes and the motion of the ends of each element; computed once."""
    return layout.once("span", _span)


def _span(layout: Layout) -> Span:
    arms = np.zeros((2, 3))
    for end, vector in (layout.options.get("offsets") or {}).items():
        arms[int(end) - 1] = vector
    ends = layout.coordinates + arms
    along = ends[:, 1] - ends[:, 0]
    x = unit(along)
    axes = _axes(x, layout.options.get("orientation"))
    motion = np.zeros((len(layout), 12, 12))
    for i in range(2):
        part = arm(arms[i])
        for j in (0, 3):
            motion[:, 6 * i + j : 6 * i + j + 3, 6 * i : 6 * i + 6] = axes @ part[j : j + 3]
    return Span(np.linalg.norm(along, axis=1), axes, motion)


def _axes(x: np.ndarray, orientation: np.ndarray | None) -> np.ndarray:
    if orientation is None:
        up = np.cross([0.0, 0.0, 1.0], x)
        y = np.where(np.linalg.norm(up, axis=1, keepdims=True) > 1e-6, up, [0.0, 1.0, 0.0])
    else:
        y = np.broadcast_to(np.asarray(orientation, float), x.shape)
    y = unit(y - np.einsum("ij,ij->i", x, y)[:, None] * x)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def two_ended(along: np.ndarray, value: np.ndarray, dofs: tuple[int, int], pattern: tuple[float, float]) -> None:
    """Adds value (e,) times [[a, b], [b, a]] to the local matrices `along` (e, 12, 12) at two dofs."""
    i, j = dofs
    for row, col, factor in ((i, i, pattern[0]), (j, j, pattern[0]), (i, j, pattern[1]), (j, i, pattern[1])):
        along[:, row, col] += factor * value


def in_plane(along: np.ndarray, block: np.ndarray, plane: int) -> None:
    """Adds the bending matrices block (e, 4, 4) to the local matrices `along` (e, 12, 12)."""
    dofs, sense = PLANES[plane]
    along[:, dofs[:, None], dofs] += block * np.outer(sense, sense)


def shapes(length: np.ndarray, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Deflection, its slope and the rotation of the section (e, 4 points, 4) for unit motions of the ends.

    The exact static shapes of a beam with phi = 12 E I / (kappa G A l^2) (Friedman and Kosmatka 1993); phi = 0: cubic.
    """
    x = POINTS[:, None]
    one = np.ones_like(x)
    L, phi = length[:, None, None], np.asarray(phi)[:, None, None]
    columns = {  # powers 0 to 3 of x, without phi and with it; the second and fourth are multiplied by L
        "w": (
            np.hstack([1 - 3 * x**2 + 2 * x**3, x - 2 * x**2 + x**3, 3 * x**2 - 2 * x**3, x**3 - x**2]),
            np.hstack([1 - x, (x - x**2) / 2, x, (x**2 - x) / 2]),
        ),
        "slope": (
            np.hstack([6 * x**2 - 6 * x, 1 - 4 * x + 3 * x**2, 6 * x - 6 * x**2, 3 * x**2 - 2 * x]),
            np.hstack([-one, 0.5 - x, one, x - 0.5]),
        ),
        "rotation": (
            np.hstack([6 * x**2 - 6 * x, 1 - 4 * x + 3 * x**2, 6 * x - 6 * x**2, 3 * x**2 - 2 * x]),
            np.hstack([0 * x, 1 - x, 0 * x, x]),
        ),
    }
    turning = np.array([0.0, 1.0, 0.0, 1.0])
    scale = np.where(turning == 1, L, 1.0)
    w, slope, rotation = ((a + phi * b) / (1 + phi) * scale for a, b in columns.values())
    return w, slope / L, rotation / L


def inertial(length: np.ndarray, phi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Deflection and rotation (e, 4 points, 4) whose inertia is that of a beam: the mass is the integral of their squares.

    Static shapes lack the bubble into which the element's own inertia shears it, by which frequencies are too high in proportion
    to l^2. By V' = -m lam w and integration by parts its energy is that of a mass m l^3/12 g w', g the shear angle, w' the mean
    slope, t = w' - g. Alone that is not positive definite; but w'^2 + g w' = (w' + c g)^2 + c^2 g t with c = sqrt(2) - 1, and the
    first is the mass of a deflection w + c g (x - l/2). What is left out, c^2 g t, is a sixth of the error. A mass of its order
    fitted to waves, as Felippa's templates (J. Aerosp. Eng. 19, 2006); phi = 0: the consistent one.
    """
    w, slope, rotation = shapes(length, phi)
    return w + _SHEARED * (POINTS[:, None] - 0.5) * length[:, None, None] * (slope - rotation), rotation


def integral(shape: np.ndarray, value: np.ndarray) -> np.ndarray:
    """Integral over the length (e, 4, 4) of shape' shape, times value (e,): a stiffness or mass times the length."""
    return value[:, None, None] * (shape.transpose(0, 2, 1) @ (WEIGHTS[:, None] * shape))


def kinked(length: np.ndarray | float, share: float) -> tuple[np.ndarray, np.ndarray | float]:
    """Integrals over the length of N psi (..., 4) and psi^2: inertia of bars that are kinked at a share of their length (...).

    Its deflection is N q + psi times the angle of the kink, N the cubic shapes, psi(x) = (x - a)_+ - (l - a) N_3 - N_4, which
    neither moves nor turns the ends. With a = share l, integral of (x - a)_+ x^n = 1/(n+2) - a/(n+1) + a^(n+2)/((n+1)(n+2)).
    """
    past, M, rest = _past(), _unit_mass(), 1 - share
    beyond = past @ share ** np.arange(6)  # of N (x - a)_+
    both = beyond - rest * M[2] - M[3]
    own = rest**3 / 3 - 2 * (rest * beyond[2] + beyond[3]) + rest**2 * M[2, 2] + 2 * rest * M[2, 3] + M[3, 3]
    return np.asarray(length)[..., None] ** _POWERS * both, length**3 * float(own)


@cache
def _past() -> np.ndarray:
    """Integrals of the cubic shapes on a unit length times (x - a)_+ as coefficients (4, 6) of the powers of a."""
    n = np.arange(4)
    powers = np.zeros((4, 6))
    powers[:, 0], powers[:, 1] = 1 / (n + 2), -1 / (n + 1)
    powers[n, n + 2] += 1 / ((n + 1) * (n + 2))
    return CUBIC @ powers


@cache
def _unit_mass() -> np.ndarray:
    """Integrals of products of the cubic shapes on a unit length (4, 4)."""
    return consistent(np.ones(1))[0]


def consistent(length: np.ndarray) -> np.ndarray:
    """Integral over the length (e, 4, 4) of N N', N the cubic shapes."""
    return integral(shapes(length, np.zeros(len(length)))[0], length)


def parted(length: np.ndarray | float, share: float) -> tuple[np.ndarray, np.ndarray | float]:
    """The same (..., 2) of bars that are parted there: along it, it moves by N u + chi times the gap, chi = H(x - a) - x/l."""
    rest, part = 1 - share, 1 - share**2
    both = np.array([rest**2 / 2 - 1 / 6, part / 2 - 1 / 3])
    return np.asarray(length)[..., None] * both, length * (rest - part + 1 / 3)


def released(releases: dict | None) -> np.ndarray:
    """Local directions, 0 to 11, in which ends carry no load."""
    own = [6 * (int(end) - 1) + DIRECTIONS.index(d) for end, names in (releases or {}).items() for d in names]
    return np.array(own, int)


def condensation(K: np.ndarray, releases: dict | None) -> np.ndarray | None:
    """Local motion (e, 12, 12) of ends of which some directions carry no load: u_c = -Kcc^-1 Kcr u_r; None without releases.

    Raises numpy.linalg.LinAlgError when the element may move by itself.
    """
    if not releases:
        return None
    free = released(releases)
    kept = np.setdiff1d(np.arange(12), free)
    Kcc = K[:, free[:, None], free].copy()
    rows = np.arange(len(free))
    Kcc[:, rows, rows] = np.where(Kcc[:, rows, rows] == 0, 1.0, Kcc[:, rows, rows])  # no stiffness there to release
    if not np.iscomplexobj(K) and _singular(Kcc):
        raise np.linalg.LinAlgError("the releases leave the element free to move")
    T = np.zeros(K.shape, K.dtype)
    T[:, kept, kept] = 1.0
    T[:, free[:, None], kept] = -np.linalg.solve(Kcc, K[:, free[:, None], kept])
    return T


def _singular(K: np.ndarray) -> bool:
    """Whether any of K (e, c, c), positive semidefinite, is singular but for rounding."""
    scale = 1 / np.sqrt(np.abs(np.einsum("eii->ei", K)))
    return bool((np.linalg.eigvalsh(K * scale[:, :, None] * scale[:, None, :])[:, 0] < _SINGULAR).any())


def to_nodes(layout: Layout, local: Matrices) -> Matrices:
    """Local matrices (e, 12, 12) of the ends, condensed and turned to the global axes at the nodes."""
    motion = span(layout).motion
    T = condensation(local["K"], layout.options.get("releases"))
    if T is not None:
        motion = T @ motion
    return {name: _congruent(motion, matrix) for name, matrix in local.items()}


def _congruent(T: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """T' matrix T; the parts of a complex matrix one by one where T is real, in half the time."""
    turned = T.transpose(0, 2, 1)
    if np.iscomplexobj(T) or not np.iscomplexobj(matrix):
        return turned @ matrix @ T
    found = np.empty(matrix.shape, complex)
    found.real, found.imag = (
        turned @ np.ascontiguousarray(matrix.real) @ T,
        turned @ np.ascontiguousarray(matrix.imag) @ T,
    )
    return found
