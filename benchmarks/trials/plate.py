"""Thin rectangular plates by the conforming element of Bogner, Fox and Schmit (1965): w, w_x, w_y, w_xy at four corners.

The truth has every degree of freedom; the deck is a matrix model of the deflections alone, the rest condensed statically after
Guyan, as test analysis models are.
"""

import numpy as np

from benchmarks.trials.assembly import Assembly
from benchmarks.trials.case import Blank, Prior, drawn

COLUMNS, ROWS = 10, 8  # elements of deck and truth
NU = 0.3
STIFFNESS_SD, MASS_SD = 0.05, 0.02
_HERMITE = np.array([[1, 0, -3, 2], [0, 1, -2, 1], [0, 0, 3, -2], [0, 0, -1, 1]])  # powers of x/l


def integrals(l: float) -> list[np.ndarray]:
    """Integrals (4, 4) of products of derivatives of Hermite's polynomials over a length: 00, 11, 22 and 02."""
    scale = np.array([1, l, 1, l])
    f = [np.polynomial.Polynomial(row) for row in _HERMITE]
    whole = lambda a, b: np.array([[(p.deriv(a) * q.deriv(b)).integ()(1) for q in f] for p in f])
    return [whole(a, b) * np.outer(scale, scale) * l ** (1 - a - b) for a, b in ((0, 0), (1, 1), (2, 2), (0, 2))]


def element(a: float, b: float) -> tuple[np.ndarray, np.ndarray]:
    """K for D = 1 and M for mass per area 1, (16, 16), of an a x b element: 4 functions along x by 4 along y."""
    x0, x1, x2, x02 = integrals(a)
    y0, y1, y2, y02 = integrals(b)
    K = np.kron(x2, y0) + np.kron(x0, y2) + NU * (np.kron(x02.T, y02) + np.kron(x02, y02.T))
    K += 2 * (1 - NU) * np.kron(x1, y1)
    return K, np.kron(x0, y0)


def matrices(
    a: float, b: float, columns: int, rows: int, factors: np.ndarray | None = None, of: str = "plate"
) -> tuple[np.ndarray, np.ndarray]:
    """K and M of a plate, D = 1 and mass per area 1, times `factors` (columns, rows) of its elements, all 1 if None.

    of: slope for K of a unit force per width along x instead. Four degrees of freedom of point (i, j) from 4 (i (rows + 1) + j).
    """
    k, m = element(a / columns, b / rows)
    if of == "slope":
        k = np.kron(integrals(a / columns)[1], integrals(b / rows)[0])
    factors = np.ones((columns, rows)) if factors is None else factors
    n = 4 * (columns + 1) * (rows + 1)
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for i, j in np.ndindex(columns, rows):
        at = [4 * ((i + p // 2) * (rows + 1) + j + q // 2) + 2 * (q % 2) + p % 2 for p in range(4) for q in range(4)]
        K[np.ix_(at, at)] += factors[i, j] * k
        M[np.ix_(at, at)] += factors[i, j] * m
    return K, M


def clamped_edge(rows: int) -> list[int]:
    """Degrees of freedom of the edge x = 0."""
    return list(range(4 * (rows + 1)))


def plate(rng: np.random.Generator) -> Blank:
    """A plate clamped along one edge."""
    a = round(rng.uniform(0.3, 0.8), 3)
    b, h = round(a * rng.uniform(0.55, 0.85), 3), round(a / rng.uniform(90, 140), 5)
    E, density = (2.1e11, 7850.0) if rng.integers(2) else (7.0e10, 2700.0)
    D, area = E * h**3 / 12 / (1 - NU**2), density * h
    K, M = matrices(a, b, COLUMNS, ROWS)
    truth = Assembly(D * K, area * M)
    priors = {
        "stiffness": Prior(STIFFNESS_SD, lambda factor: np.multiply(truth.base[0], factor, out=truth.base[0])),
        "mass": Prior(MASS_SD, lambda factor: np.multiply(truth.base[1], factor, out=truth.base[1])),
    }
    truth.held = set(clamped_edge(ROWS))
    points = [(i, j) for i in range(1, COLUMNS + 1) for j in range(ROWS + 1)]
    where = {n: (a * i / COLUMNS, b * j / ROWS, 0.0) for n, (i, j) in enumerate(points, 1)}
    w = [4 * (i * (ROWS + 1) + j) for i, j in points]
    return Blank(
        family="plate",
        truth=truth,
        model=_DECK,
        sensors=[(f"{n}TZ", dof) for n, dof in enumerate(w, 1)],
        nodes={str(n): xyz for n, xyz in where.items()},
        span=a,
        weight=area * a * b,
        first=float(3.5 / a**2 * np.sqrt(D / area)),
        stiffness=float(D * b / a**3),
        places={dof: where[n][:2] for n, dof in enumerate(w, 1)},
        parameters=drawn(rng, priors),
        priors=priors,
        files=_files(D * K, area * M, w, where),
    )


_DECK = """\
model:
  stiffness: {file: NAME-K.mtx}
  mass: {file: NAME-M.mtx}
  dofs: {file: NAME-dofs.csv}
  nodes: {file: NAME-nodes.csv}

parameters:
  - {name: stiffness, nominal: 1, sd: 5 %, transform: log, stiffness: {file: NAME-K.mtx}}
  - {name: mass, nominal: 1, sd: 2 %, transform: log, mass: {file: NAME-M.mtx}}
"""


def _files(K: np.ndarray, M: np.ndarray, w: list[int], where: dict) -> dict[str, str]:
    """Files that the deck refers to, by the end of their names."""
    held = set(clamped_edge(ROWS)) | set(w)
    slopes = [i for i in range(len(K)) if i not in held]
    G = -np.linalg.solve(K[np.ix_(slopes, slopes)], K[np.ix_(slopes, w)])
    T = np.zeros((len(K), len(w)))
    T[w, range(len(w))], T[slopes] = 1.0, G
    dofs = "node,direction\n" + "".join(f"{i},TZ\n" for i in range(1, len(w) + 1))
    nodes = "node,x,y,z\n" + "".join(f"{n},{x:.9g},{y:.9g},{z:.9g}\n" for n, (x, y, z) in where.items())
    return {"K.mtx": _market(T.T @ K @ T), "M.mtx": _market(T.T @ M @ T), "dofs.csv": dofs, "nodes.csv": nodes}


def _market(A: np.ndarray) -> str:
    """A symmetric matrix as Matrix Market has it."""
    i, j = np.nonzero(np.tril(np.abs(A) > 1e-12 * np.abs(A).max()))
    rows = "".join(f"{r + 1} {c + 1} {A[r, c]:.12e}\n" for r, c in zip(i, j, strict=True))
    return f"%%MatrixMarket matrix coordinate real symmetric\n{len(A)} {len(A)} {len(i)}\n{rows}"
