"""Writes modes.txt and functions.csv: a simply supported, structurally damped bar with a crack (homework 4 of the lectures).

Either side of the crack w = a sin kx + b cos kx + c sinh kx + d cosh kx, k^4 = m omega^2 / (EI (1 + i eta)). At the crack the two
have one deflection, moment and shear force, and their slopes differ by the angle M c, c = 6 (1 - nu^2) h F1 / (EI (1 + i eta_c)), a
spring that loses energy by a loss factor of its own. F1 is the integral of pi s Y(s)^2 to the depth over the height, Y the stress
intensity factor of bending of Tada, Paris and Irwin. A force is a jump of the shear force where it acts, which makes a third piece.
Receptances solve those conditions; modes those without loss, where their determinant vanishes. Noise from a fixed seed: 0.1 % of
frequencies, 1 % of shapes and functions.
"""

from functools import cache
from pathlib import Path

import numpy as np

LENGTH, WIDTH, HEIGHT, E, NU, DENSITY = 1.0, 0.02, 0.025, 2.03e11, 0.3, 7850.0
EI, MASS = E * WIDTH * HEIGHT**3 / 12, DENSITY * WIDTH * HEIGHT
PLACE, DEPTH, LOSS, OWN_LOSS = 0.37, 0.35, 0.01, 0.15  # m, of the height, of the bar, of the crack
NODES, FORCE = tuple(range(3, 24, 2)), 9  # of the deck, 24 elements: where it is measured, where it is struck
MODES, BAND = 4, (20.0, 1100.0, 361)


def station(node: int) -> float:
    """Place of a node in m."""
    return (node - 1) * LENGTH / 24


@cache
def compliance(loss: float = OWN_LOSS) -> complex:
    """Angle of the crack for a unit moment, rad/(N m)."""
    s, step = (np.arange(20000) + 0.5) * DEPTH / 20000, DEPTH / 20000
    t = np.pi * s / 2
    Y = np.sqrt(np.tan(t) / t) * (0.923 + 0.199 * (1 - np.sin(t)) ** 4) / np.cos(t)
    return 6 * (1 - NU**2) * HEIGHT * float((np.pi * s * Y**2).sum() * step) / EI / (1 + 1j * loss)


def _state(x: float, k: complex, EI: complex) -> np.ndarray:
    """Deflection, slope, moment and shear force (4, 4) at x of sin, cos, sinh, cosh kx, of size 1 at the far end of the bar."""
    s, c, S, C = np.sin(k * x), np.cos(k * x), np.sinh(k * x), np.cosh(k * x)
    rows = [s, c, S, C], [c, -s, C, S], [-s, -c, S, C], [-c, s, C, S]
    units = 1, k, EI * k**2, EI * k**3
    scale = np.array([1, 1, np.exp(-k.real * LENGTH), np.exp(-k.real * LENGTH)])
    return np.array([unit * np.array(row) for unit, row in zip(units, rows, strict=True)]) * scale


def conditions(omega: float, joints: dict[float, complex], eta: float) -> tuple[np.ndarray, list[float], complex]:
    """Square matrix of the bar cut at `joints` {place: compliance}, in rows of units of their own; the cuts, and k."""
    stiff = EI * (1 + 1j * eta)
    k = (MASS * omega**2 / stiff) ** 0.25
    cuts = sorted(joints)
    A = np.zeros((4 * len(cuts) + 4, 4 * len(cuts) + 4), complex)
    A[:2, :4], A[-2:, -4:] = _state(0.0, k, stiff)[[0, 2]], _state(LENGTH, k, stiff)[[0, 2]]
    for i, x in enumerate(cuts):
        here = _state(x, k, stiff)
        before = here.copy()
        before[1] += joints[x] * here[2]
        A[4 * i + 2 : 4 * i + 6, 4 * i : 4 * i + 8] = np.hstack([-before, here])
    units = np.array([1, k, stiff * k**2, stiff * k**3])
    return A / np.concatenate([units[[0, 2]], *[units] * len(cuts), units[[0, 2]]])[:, None], cuts, k


def receptances(hz: np.ndarray, loss: float = OWN_LOSS, eta: float = LOSS) -> np.ndarray:
    """(f, s) at the nodes for a unit force at node FORCE."""
    x, struck, found = np.array([station(n) for n in NODES]), station(FORCE), []
    for omega in 2 * np.pi * hz:
        A, cuts, k = conditions(omega, {PLACE: compliance(loss), struck: 0.0}, eta)
        load = np.zeros(len(A), complex)
        load[4 * cuts.index(struck) + 5] = 1 / (EI * (1 + 1j * eta) * k**3)  # EI w''' jumps by the force
        pieces = np.linalg.solve(A, load).reshape(-1, 4)
        own = pieces[np.searchsorted(cuts, x)]
        found.append([_state(at, k, EI * (1 + 1j * eta))[0] @ piece for at, piece in zip(x, own, strict=True)])
    return np.array(found)


def modes(count: int = MODES) -> tuple[np.ndarray, np.ndarray]:
    """Hz (count,) and deflections (s, count) without loss, each of size 1."""
    from scipy.optimize import brentq

    matrix = lambda omega: conditions(omega, {PLACE: compliance(0.0).real}, 0.0)[0].real
    sign = lambda omega: np.linalg.det(matrix(omega))
    omegas = 2 * np.pi * np.linspace(10.0, 3000.0, 3000)
    values = [sign(omega) for omega in omegas]
    own = [
        brentq(sign, a, b, xtol=1e-10)
        for a, b, u, v in zip(omegas, omegas[1:], values, values[1:], strict=False)
        if u * v < 0
    ]
    shapes = []
    for omega in own[:count]:
        pieces, k = np.linalg.svd(matrix(omega))[2][-1].reshape(2, 4), (MASS * omega**2 / EI) ** 0.25
        w = np.array(
            [_state(station(n), np.complex128(k), EI)[0].real @ pieces[int(station(n) > PLACE)] for n in NODES]
        )
        shapes.append(w / w[np.argmax(np.abs(w))])
    return np.array(own[:count]) / (2 * np.pi), np.array(shapes).T


def main() -> None:
    """Write the files."""
    rng, folder = np.random.default_rng(4), Path(__file__).parent
    hz, shapes = modes()
    hz, shapes = hz * (1 + 1e-3 * rng.standard_normal(MODES)), shapes + 0.01 * rng.standard_normal(shapes.shape)
    rows = "\n".join(f"      - [{', '.join(f'{v:.4f}' for v in row)}]" for row in shapes)
    text = f"    frequency: [{', '.join(f'{f:.6g}' for f in hz)}]\n    shapes:\n{rows}\n"
    (folder / "modes.txt").write_text(text)
    lines = np.round(np.linspace(*BAND), 2)
    H = receptances(lines)
    H = H + 0.01 * np.abs(H) * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape)) / np.sqrt(2)
    head = "frequency (Hz)," + ",".join(f"{n}TY" for n in NODES)
    table = [
        f"{f:.2f}," + ",".join(f"{z.real:.5g}{z.imag:+.5g}j" for z in row) for f, row in zip(lines, H, strict=True)
    ]
    (folder / "functions.csv").write_text("\n".join([head, *table]) + "\n")


if __name__ == "__main__":
    main()
