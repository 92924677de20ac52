"""The truth solver on closed forms of one mass in free vibration: what must hold before any table is believed.

Each check starts at rest in the middle with a speed; all formulas follow from the first integral of the motion.
"""

from collections.abc import Callable

import numpy as np

from benchmarks.blind_records.chain import Chain
from benchmarks.blind_records.opensees import run

K, M, SPEED = 1e5, 1.0, 1.0
W = np.sqrt(K / M)
H = 1 / 16384
CROSSINGS = 8


def verify() -> str:
    """A line for each law: largest relative difference of its half periods or amplitudes."""
    lines = ["OpenSees beside closed forms of one mass: largest difference, %"]
    for law, check in CHECKS.items():
        found, exact = check()
        lines.append(f"  {law:22} {100 * np.abs(np.asarray(found) / exact - 1).max():8.4f}")
    return "\n".join(lines)


def motion(law: str, values: dict[str, float], seconds: float = 0.3) -> tuple[np.ndarray, np.ndarray]:
    """Velocity and displacement (t,) from a speed SPEED, by summing accelerations of the solver."""
    one = np.ones(1)
    chain = Chain("verify", K * one, 0 * one, M * one, K * one, 0 * one, 0, 0.0, law, 0, values)
    a = run(chain, np.zeros(int(seconds / H)), H, SPEED)[:, 0]
    a = np.concatenate([[0.0], a])
    v = SPEED + np.concatenate([[0.0], np.cumsum((a[1:] + a[:-1]) / 2 * H)])
    return v, np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * H)])


def half_periods(law: str, values: dict[str, float]) -> np.ndarray:
    """Times between passages through the middle."""
    _, x = motion(law, values)
    at = np.flatnonzero(x[1:-1] * x[2:] <= 0)[:CROSSINGS] + 1
    times = np.concatenate([[0.0], (at + x[at] / (x[at] - x[at + 1])) * H])
    return np.diff(times)


def cubic() -> tuple[np.ndarray, float]:
    """Duffing: T = 4 K(m) / sqrt(w^2 + b A^2), m = b A^2 / 2 (w^2 + b A^2)."""
    from scipy.special import ellipk

    k3 = 4 * K * W**2 / SPEED**2
    b = k3 / M
    A2 = (-(W**2) + np.sqrt(W**4 + 2 * b * SPEED**2)) / b
    w2 = W**2 + b * A2
    return half_periods("cubic", {"k3": k3}), 2 * ellipk(b * A2 / (2 * w2)) / np.sqrt(w2)


def gap() -> tuple[np.ndarray, float]:
    """A stop of three times the stiffness at 0.6 of the amplitude without it."""
    kc, g = 3 * K, 0.6 * SPEED / W
    return half_periods("gap", {"kc": kc, "g": g}), 2 * _quarter(kc, g)


def one_sided() -> tuple[np.ndarray, np.ndarray]:
    """The same on one side: half periods in turn."""
    kc, g = 3 * K, 0.6 * SPEED / W
    found = half_periods("one-sided-gap", {"kc": kc, "g": g})
    return found, np.where(np.arange(len(found)) % 2 == 0, 2 * _quarter(kc, g), np.pi / W)


def _quarter(kc: float, g: float) -> float:
    """Time from the middle to the turning point beyond a clearance."""
    first, speed = np.arcsin(g * W / SPEED) / W, np.sqrt(SPEED**2 - (W * g) ** 2)
    stiff, middle = np.sqrt((K + kc) / M), kc * g / (K + kc)
    return first + np.arctan2(speed, stiff * (g - middle)) / stiff


def bilinear() -> tuple[np.ndarray, np.ndarray]:
    """pi/w on either side; the stiffer side first."""
    found = half_periods("bilinear", {"dk": 0.5 * K})
    return found, np.where(np.arange(len(found)) % 2 == 0, np.pi / (W * np.sqrt(1.5)), np.pi / W)


def friction() -> tuple[np.ndarray, np.ndarray]:
    """Jenkins element that slips all the way: peaks fall by 2 (F - F^2/ (2 kt) ...) / k: for stiff kt by 2 F / k."""
    F = 0.02 * K * SPEED / W
    _, x = motion("friction", {"kt": 2e4 * K, "Fs": F})
    peaks = np.abs(x[1:-1][(np.diff(x)[:-1] * np.diff(x)[1:]) <= 0])[:CROSSINGS]
    first = (-F + np.sqrt(F**2 + K * M * SPEED**2)) / K
    return peaks, first - 2 * F / K * np.arange(len(peaks))


def quadratic_damping() -> tuple[np.ndarray, np.ndarray]:
    """Peaks from (1 + 2 a A) e^(-2 a A) = (1 - 2 a B) e^(2 a B), a = c2/m, B after A; the first from v^2 at the middle."""
    from scipy.optimize import brentq

    c2 = 0.1 * W / SPEED * M
    a = c2 / M
    _, x = motion("quadratic-damping", {"c2": c2})
    peaks = np.abs(x[1:-1][(np.diff(x)[:-1] * np.diff(x)[1:]) <= 0])[:CROSSINGS]
    top = 0.4999999 / a
    level = 1 - 2 * a**2 * SPEED**2 / W**2
    exact = [brentq(lambda B: (1 - 2 * a * B) * np.exp(2 * a * B) - level, 1e-12, top)]
    while len(exact) < len(peaks):
        A = exact[-1]
        exact.append(
            brentq(
                lambda B, A=A: (1 - 2 * a * B) * np.exp(2 * a * B) - (1 + 2 * a * A) * np.exp(-2 * a * A), 1e-12, top
            )
        )
    return peaks, np.array(exact)


def oscillator() -> tuple[float, float]:
    """Two masses: x = sum of modes; the displacement after 0.05 s."""
    m, f = 0.1, 40.0
    k = m * (2 * np.pi * f) ** 2
    _, x = motion("oscillator", {"m": m, "f": f, "zeta": 0.0}, 0.1)
    values, shapes = np.linalg.eigh(np.array([[(K + k) / M, -k / np.sqrt(M * m)], [-k / np.sqrt(M * m), k / m]]))
    w, i = np.sqrt(values), int(0.05 / H)
    return x[i], float((shapes[0] ** 2 * np.sin(w * i * H) / w).sum() * SPEED)


CHECKS: dict[str, Callable] = {
    "cubic": cubic,
    "gap": gap,
    "one-sided-gap": one_sided,
    "bilinear": bilinear,
    "friction": friction,
    "quadratic-damping": quadratic_damping,
    "oscillator": oscillator,
}
