"""The truth solver on closed forms: what must hold before any table is believed.

Roots come from the exact solutions of Euler-Bernoulli and of Timoshenko beams (shear coefficient of a narrow rectangle) and
of members after Euler and Bernoulli joined at nodes, none of them from mouse.
"""

from collections.abc import Callable

import numpy as np

from benchmarks.blind import chains, frames
from benchmarks.blind.solids import Solid, modes

E, DENSITY, NU = 2.1e11, 7850.0, 0.3
THIN, THICK = 1 / 200, 1 / 10  # h/L; thinner solids lose digits: 1 % of mode 1 at 1/1000
MODES = 3  # of slender beams: shear takes 0.03 % off the third


def verify() -> str:
    """A line for each check: largest relative difference in frequency, and what of the theory is in it."""
    lines = ["CalculiX beside closed forms: largest difference of the frequencies, %"]
    for title, check in CHECKS.items():
        found, exact = check()
        lines.append(f"  {title:64} {100 * abs(found / exact - 1).max():8.4f}   modes {len(exact)}")
    return "\n".join(lines)


def roots(f: Callable[[float], float], low: float, high: float, count: int, step: float) -> np.ndarray:
    """The first `count` sign changes of a continuous `f` above `low`."""
    from scipy.optimize import brentq

    x = np.arange(low, high, step)
    y = np.array([f(one) for one in x])
    at = np.flatnonzero(y[:-1] * y[1:] < 0)[:count]
    return np.array([brentq(f, x[i], x[i + 1], xtol=1e-13) for i in at])


def unit(solid: Solid) -> float:
    """sqrt(EI/m)/(2 pi L^2) in Hz."""
    return float(np.sqrt(solid.EI / solid.line) / (2 * np.pi * solid.L**2))


def slender(free: bool, slit: tuple[float, float] | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Euler-Bernoulli: cos z cosh z = -1 (cantilever), 1 (free)."""
    solid = Solid(1.0, THIN, E, DENSITY, free, slit=slit)
    z = roots(lambda z: np.cos(z) + (-1 if free else 1) / np.cosh(z), 1.0, 30.0, MODES, 0.1)
    return modes(solid)[0][:MODES], z**2 * unit(solid)


def tipped(share: float = 0.04) -> tuple[np.ndarray, np.ndarray]:
    """Cantilever with a mass at the tip: 1 + cos cosh = mu z (sin cosh - cos sinh), divided by cosh."""
    solid = Solid(1.0, THIN, E, DENSITY)
    solid = Solid(1.0, THIN, E, DENSITY, masses=[(1.0, share * solid.line)])
    f = lambda z: np.cos(z) + 1 / np.cosh(z) - share * z * (np.sin(z) - np.cos(z) * np.tanh(z))
    return modes(solid)[0][:MODES], roots(f, 1.0, 30.0, MODES, 0.1) ** 2 * unit(solid)


def tense(tau: float = 2.0) -> tuple[np.ndarray, np.ndarray]:
    """Cantilever under a dead pull T = tau EI/L^2: w'' = 0 and w''' = (T/EI) w' at the free end."""
    solid = Solid(1.0, THIN, E, DENSITY)
    solid = Solid(1.0, THIN, E, DENSITY, tension=tau * solid.EI)

    def f(omega: float) -> float:
        root = np.sqrt(tau**2 / 4 + omega**2)
        a, b = np.sqrt(root + tau / 2), np.sqrt(root - tau / 2)  # cosh and cos
        at = np.array(
            [
                [a**2 * np.cosh(a) + b**2 * np.cos(b), a**2 * np.sinh(a) + a * b * np.sin(b)],
                [
                    a**3 * np.sinh(a) - b**3 * np.sin(b) - tau * (a * np.sinh(a) + b * np.sin(b)),
                    a**3 * np.cosh(a) + a * b**2 * np.cos(b) - tau * (a * np.cosh(a) - a * np.cos(b)),
                ],
            ]
        )
        return float(np.linalg.det(at / np.cosh(a)))

    return modes(solid)[0][:MODES], roots(f, 1.0, 300.0, MODES, 0.5) * unit(solid)


def bedded(k: float = 20.0) -> tuple[np.ndarray, np.ndarray]:
    """Cantilever on a foundation k EI/L^4: omega^2 = z^4 + k."""
    solid = Solid(1.0, THIN, E, DENSITY)
    solid = Solid(1.0, THIN, E, DENSITY, foundation=(0.0, 1.0, k * solid.EI))
    z = roots(lambda z: np.cos(z) + 1 / np.cosh(z), 1.0, 30.0, MODES, 0.1)
    return modes(solid)[0][:MODES], np.sqrt(z**4 + k) * unit(solid)


def thick() -> tuple[np.ndarray, np.ndarray]:
    """Free beam after Timoshenko, plane stress: kappa = 5 (1 + nu)/(6 + 5 nu) (Timoshenko 1922, Hutchinson 2001)."""
    solid = Solid(1.0, THICK, E, DENSITY, True)
    r2, kappa = THICK**2 / 12, 5 * (1 + NU) / (6 + 5 * NU)
    s = 2 * (1 + NU) / kappa * r2  # EI/(kappa G A L^2)

    def f(omega: float) -> float:
        p, q = omega**2 * (r2 + s), omega**2 * (r2 * s * omega**2 - 1)
        root = np.sqrt(p**2 / 4 - q)
        a, b = np.sqrt(root - p / 2), np.sqrt(root + p / 2)  # w = cosh ax, cos bx; turning follows from equilibrium
        g, h = (
            (a**2 + s * omega**2) / a,
            (b**2 - s * omega**2) / b,
        )  # psi of sinh ax is g cosh ax, of cos bx is -h sin bx
        rows = [
            [g * a, 0, -h * b, 0],  # moment psi' at 0
            [0, a - g, 0, b - h],  # shear w' - psi at 0
            [g * a * np.cosh(a), g * a * np.sinh(a), -h * b * np.cos(b), -h * b * np.sin(b)],
            [(a - g) * np.sinh(a), (a - g) * np.cosh(a), -(b - h) * np.sin(b), (b - h) * np.cos(b)],
        ]
        return float(np.linalg.det(np.array(rows) / np.array([1, 1, np.cosh(a), np.cosh(a)])[:, None]))

    return modes(solid)[0][:4], roots(f, 5.0, 160.0, 4, 0.5) * unit(solid)


def chain(count: int = 9) -> tuple[np.ndarray, np.ndarray]:
    """Equal masses and springs, held at one end: omega = 2 sqrt(k/m) sin((2 i - 1) pi/(4 n + 2))."""
    k, m = 3.0e4, 2.0
    links = [[i, i + 1 if i < count else 0, k] for i in range(count)]
    given = {"count": count, "hung": 0, "links": links, "masses": [[i, m] for i in range(1, count + 1)], "added": 0.1}
    i = np.arange(1, count + 1)
    exact = 2 * np.sqrt(k / m) * np.sin((2 * i - 1) * np.pi / (4 * count + 2)) / (2 * np.pi)
    return chains.make(given | {"links": [[0, 1, k], *links[1:-1], [count - 1, count, k]]})["frequency"], exact


def portal() -> tuple[np.ndarray, np.ndarray]:
    """Slender portal after Euler and Bernoulli: sway by the exact stiffness of its members, one half with antisymmetry."""
    H, W, depth = 1.0, 1.5, 0.002
    members = [[0.0, 0.0, 0.0, H], [W, 0.0, W, H], [0.0, H, W, H]]
    inputs = {
        "members": members, "depth": depth, "E": E, "density": DENSITY, "heavy": 1.0, "first": 1.0, "gravity": False,
        "soft": [], "masses": [], "oscillators": [], "ground": [],
    }  # fmt: skip
    ratio = np.sqrt(E * depth**2 / (12 * DENSITY))  # sqrt(EI/m)

    def sway(z: float) -> float:  # z = beta in 1/m; corner: joint turning and sway of the beam as a rigid body
        post = dynamic(z, H)
        half = dynamic(z, W / 2)
        K = np.array([[post[3, 3] + _pinned(half), post[3, 2]], [post[2, 3], post[2, 2] - z**4 * W / 2]])
        return float(np.linalg.det(K))

    def nod(z: float) -> float:  # symmetric: corners turn, the middle of the beam does not
        return float(dynamic(z, H)[3, 3] + _guided(dynamic(z, W / 2)))

    both = np.sort(np.concatenate([_zeros(sway), _zeros(nod)]))[:6]
    return frames.modes(inputs)[0][:6], both**2 * ratio / (2 * np.pi)


def dynamic(z: float, L: float) -> np.ndarray:
    """Exact dynamic stiffness (4, 4) of a member on w1, turn1, w2, turn2 with EI = 1 and m omega^2 = z^4."""
    b = z * L
    c, s, C, S = np.cos(b), np.sin(b), np.cosh(b), np.sinh(b)
    shape = np.array([[1, 0, 1, 0], [0, z, 0, z], [c, s, C, S], [-z * s, z * c, z * S, z * C]])
    force = np.array(
        [
            [0, -(z**3), 0, z**3],
            [z**2, 0, -(z**2), 0],
            [-(z**3) * s, z**3 * c, -(z**3) * S, -(z**3) * C],
            [-(z**2) * c, -(z**2) * s, z**2 * C, z**2 * S],
        ]
    )
    return force @ np.linalg.pinv(shape, rcond=1e-30)  # it has poles, and a search may step on one


def _pinned(half: np.ndarray) -> float:
    """Stiffness of the near end against turning, the far end in the middle of a beam bent antisymmetrically: w = 0."""
    return float(half[1, 1] - half[1, 3] * half[3, 1] / half[3, 3])


def _guided(half: np.ndarray) -> float:
    """The same, the far end in the middle of a beam bent symmetrically: turn = 0."""
    return float(half[1, 1] - half[1, 2] * half[2, 1] / half[2, 2])


def _zeros(f: Callable[[float], float]) -> np.ndarray:
    """Sign changes that are no poles."""
    found = roots(f, 0.3, 12.0, 40, 0.003)
    return np.array([z for z in found if abs(f(z)) < 1e-3 * max(abs(f(z - 1e-3)), abs(f(z + 1e-3)))])


CHECKS: dict[str, Callable[[], tuple[np.ndarray, np.ndarray]]] = {
    "slender cantilever, Euler-Bernoulli": lambda: slender(False),
    "slender free beam, Euler-Bernoulli": lambda: slender(True),
    "the same on the mesh of a slit of no depth": lambda: slender(True, (0.437, 0.0)),
    "cantilever with a tip mass of 4 %": tipped,
    "cantilever under tension 2 EI/L^2": tense,
    "cantilever on a foundation of 20 EI/L^4": bedded,
    "thick free beam, L/h = 10, Timoshenko": thick,
    "chain of nine equal masses": chain,
    "slender portal, Euler-Bernoulli": portal,
}
