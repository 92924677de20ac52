"""Which planar frame has the five frequencies of lecture 21-1? All connected ones on three by three lines, midlines at half.

Sides, torsion constant (from that of the thin wall to somewhat more than Iy + Iz) and scale are free; the scale is profiled,
since without rotary inertia frequencies go with 1/length^2. Prints the root mean square misfit in parts of a thousand, long by
short side, torsion constant by that of the thin wall, and the bars, best first. A few minutes; needs numpy and scipy.

    python decks/tube_frame/search.py
"""

from itertools import combinations

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import minimize

PRINTED = np.array([255.8, 277.5, 581.3, 911.3, 1049.4])
OUTER, WALL, E, NU, DENSITY = 0.0254, 0.00238, 70e9, 0.33, 2700.0
AREA = OUTER**2 - (OUTER - 2 * WALL) ** 2
I = (OUTER**4 - (OUTER - 2 * WALL) ** 4) / 12
GJ_THIN = E / (2 * (1 + NU)) * (OUTER - WALL) ** 3 * WALL
LINES = [((i, j), (i + 1, j)) for j in range(3) for i in range(2)] + [
    ((i, j), (i, j + 1)) for j in range(2) for i in range(3)
]


def turned(bars) -> tuple:
    """The same frame for all eight symmetries of the grid."""
    ways = [
        lambda x, y, a=a, b=b, s=s: (*(abs(a - x), abs(b - y)),)[::s] for a in (0, 2) for b in (0, 2) for s in (1, -1)
    ]
    return min(tuple(sorted(tuple(sorted((way(*p), way(*q)))) for p, q in bars)) for way in ways)


def frames() -> list:
    """Every connected set of bars that spans the grid both ways, once."""
    found = {turned(bars) for count in range(3, 13) for bars in combinations(LINES, count)}
    return sorted(bars for bars in found if _whole(bars))


def _whole(bars) -> bool:
    points = {p for bar in bars for p in bar}
    spans = all({0, 2} <= {p[axis] for p in points} for axis in (0, 1))
    seen, todo = set(), [next(iter(points))]
    while todo:
        here = todo.pop()
        seen.add(here)
        todo += [p for bar in bars if here in bar for p in bar if p not in seen]
    return spans and seen == points


def element(length: float, torsion: float) -> tuple[np.ndarray, np.ndarray]:
    """K and M over deflection, slope and twist of both ends."""
    l, K, M = length, np.zeros((6, 6)), np.zeros((6, 6))
    bend, m = np.ix_([0, 1, 3, 4], [0, 1, 3, 4]), DENSITY * AREA * length / 420
    s, a = np.array([0, -1, 0, 1.0]), np.array([1, l / 2, -1, l / 2])
    K[bend] = E * I / l * np.outer(s, s) + 12 * E * I / l**3 * np.outer(a, a)
    upper = {(0, 0): 156, (0, 1): 22 * l, (0, 2): 54, (0, 3): -13 * l, (1, 1): 4 * l * l, (1, 2): 13 * l}
    upper |= {(1, 3): -3 * l * l, (2, 2): 156, (2, 3): -22 * l, (3, 3): 4 * l * l}
    for (i, j), value in upper.items():
        M[bend[0][i], bend[1][0][j]] = M[bend[0][j], bend[1][0][i]] = m * value
    twist = np.ix_([2, 5], [2, 5])
    K[twist] = torsion * GJ_THIN / l * np.array([[1, -1], [-1, 1]])
    M[twist] = 1e-3 * DENSITY * 2 * I * l / 6 * np.array([[2, 1], [1, 2]])
    return K, M


def frequencies(bars, ratio: float, torsion: float, parts: int) -> np.ndarray:
    """The lowest five elastic ones in Hz, for sides of 0.3 `ratio` and 0.3 m."""
    corners = sorted({p for bar in bars for p in bar})
    place = [np.array([0.15 * ratio * x, 0.15 * y]) for x, y in corners]
    ends = []
    for p, q in ((corners.index(p), corners.index(q)) for p, q in bars):
        inner = list(range(len(place), len(place) + parts - 1))
        place += [place[p] + (place[q] - place[p]) * k / parts for k in range(1, parts)]
        ends += list(zip([p, *inner], [*inner, q], strict=True))
    K, M = np.zeros((2, 3 * len(place), 3 * len(place)))
    for p, q in ends:
        along = place[q] - place[p]
        length = float(np.hypot(*along))
        c, s = along / length
        T = np.kron(np.eye(2), np.array([[1, 0, 0], [0, c, s], [0, -s, c]]))
        at = np.ix_(*2 * [[3 * p, 3 * p + 1, 3 * p + 2, 3 * q, 3 * q + 1, 3 * q + 2]])
        for matrix, own in zip((K, M), element(length, torsion), strict=True):
            matrix[at] += T.T @ own @ T
    return np.sqrt(np.abs(eigh(K, M, eigvals_only=True, subset_by_index=[3, 7]))) / (2 * np.pi)


def misfit(bars, at: np.ndarray, parts: int = 3) -> float:
    """Root mean square of ln(computed/printed) in parts of a thousand, the best scale taken out."""
    outside = 1e3 * (max(0.0, at[1] - 1.36) + max(0.0, 0.95 - at[1]))
    return outside + 1e3 * float(np.std(np.log(frequencies(bars, np.exp(at[0]), at[1], parts) / PRINTED)))


def main() -> None:
    every = frames()
    starts = [np.array([ratio, torsion]) for ratio in np.linspace(-1.6, 1.6, 17) for torsion in (1.0, 1.3)]
    coarse = sorted((min((misfit(bars, at, 2), tuple(at)) for at in starts), bars) for bars in every)
    options = {"maxfev": 80, "xatol": 1e-4, "fatol": 0.01}
    fine = [
        (minimize(lambda at, bars=bars: misfit(bars, at), at, method="Nelder-Mead", options=options), bars)
        for (_, at), bars in coarse[:60]
    ]
    print(f"{len(every)} frames; misfit in 1/1000, sides, torsion, bars")
    for found, bars in sorted(fine, key=lambda pair: pair[0].fun)[:5]:
        print(f"{found.fun:8.2f} {np.exp(abs(found.x[0])):6.3f} {found.x[1]:6.3f}  {bars}")


if __name__ == "__main__":
    main()
