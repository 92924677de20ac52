"""Chains of masses with one concealed law, and how their numbers are drawn."""

import zlib
from dataclasses import dataclass

import numpy as np

SPLITS = ("development", "fresh")
LAWS = ("cubic", "gap", "one-sided-gap", "bilinear", "friction", "quadratic-damping", "oscillator")
STIFFNESS_SPREAD, DAMPING_SPREAD = 0.02, 0.10  # of the structure about its deck, largest
SAMPLE_RATE, SECONDS = 1024.0, 16.0
BAND = 4.0, 160.0  # Hz, of the force
TABLE_5_1 = ((85e3, 140e3, 115e3, 200e3), (1.0, 1.0, 1.0, 1.0))  # N/m, kg: J. H. Wiggins Company, NAS8-27331, 1972


@dataclass(frozen=True)
class Chain:
    """k (n,): springs from the ground on; c (n,): dashpots beside them; m (n,); law at spring `link`, or mass of an oscillator.

    driven: mass on which the force acts, from 0; force_rms: N.
    """

    name: str
    k: np.ndarray
    c: np.ndarray
    m: np.ndarray
    nominal_k: np.ndarray
    nominal_c: np.ndarray
    driven: int
    force_rms: float
    law: str
    place: int
    values: dict[str, float]


def generator(*words: object) -> np.random.Generator:
    """Random numbers that depend on all `words`, and on nothing else."""
    return np.random.default_rng([zlib.crc32(str(word).encode()) for word in words])


def force(chain: Chain, rate: float) -> np.ndarray:
    """Band-limited random force (t,) at `rate`, with zeros before and after, in N."""
    rng, t = generator(chain.name, "force"), int(SECONDS * rate)
    lines = np.fft.rfftfreq(t, 1 / rate)
    own = (lines >= BAND[0]) & (lines <= BAND[1])
    spectrum = np.zeros(len(lines), complex)
    spectrum[own] = np.exp(2j * np.pi * rng.uniform(size=own.sum()))
    found = np.fft.irfft(spectrum, t)
    ramp = np.minimum(1.0, np.arange(t) / rate / 0.25)
    return chain.force_rms * found / found.std() * (0.5 - 0.5 * np.cos(np.pi * ramp))


def matrices(k: np.ndarray) -> np.ndarray:
    """K (n, n) of springs k, the first to the ground."""
    found = np.diag(k + np.append(k[1:], 0.0))
    i = np.arange(len(k) - 1)
    found[i, i + 1] = found[i + 1, i] = -k[1:]
    return found


def chains(split: str, seed: int, count: int, controls: int) -> list[Chain]:
    """`count` chains of each law, and `controls` without one; every other chain is that of Table 5-1."""
    names = [(law, i) for law in LAWS for i in range(count)] + [("none", i) for i in range(controls)]
    return [_drawn(split, seed, law, i) for law, i in names]


def _drawn(split: str, seed: int, law: str, i: int) -> Chain:
    rng = generator(split, seed, law, i)
    if i % 2 == 0:
        k, m = (np.array(part) for part in TABLE_5_1)
    else:
        n = int(rng.integers(3, 6))
        k, m = rng.uniform(6e4, 2.2e5, n), rng.uniform(0.6, 1.6, n)
    w = np.sqrt(np.linalg.eigvalsh(matrices(k) / np.sqrt(np.outer(m, m))))
    c = k * 2 * rng.uniform(0.008, 0.015) / w[min(1, len(w) - 1)]
    spread = lambda size: 1 + rng.uniform(-size, size, len(k))
    true_k, true_c = k * spread(STIFFNESS_SPREAD), c * spread(DAMPING_SPREAD)
    place, driven = int(rng.integers(len(k))), int(rng.integers(len(k)))
    bare = Chain(f"{split}-{seed}-{law}-{i}", true_k, true_c, m, k, c, driven, 50.0, law, place, {})
    if law == "none":
        return bare
    return Chain(**{**vars(bare), "values": _values(rng, bare, *_rms(bare))})


def _rms(chain: Chain) -> tuple[float, float]:
    """rms of the stretch of the link and of its speed, without the law, by the receptance over the band."""
    w = 2 * np.pi * np.linspace(*BAND, 4000)
    K, C, M = matrices(chain.k), matrices(chain.c), np.diag(chain.m)
    Z = K + 1j * w[:, None, None] * C - w[:, None, None] ** 2 * M
    u = np.linalg.solve(Z, np.eye(len(chain.m))[:, [chain.driven]])[:, :, 0]
    x = u[:, chain.place] - (u[:, chain.place - 1] if chain.place else 0)
    return tuple(float(chain.force_rms * np.sqrt(np.mean(np.abs(x * w**order) ** 2))) for order in (0, 1))


def _values(rng: np.random.Generator, chain: Chain, x: float, v: float) -> dict[str, float]:
    """Sizes of the law, by the motion at its place."""
    k, m, draw = chain.k[chain.place], chain.m[chain.place], rng.uniform
    if chain.law == "cubic":
        return {"k3": k / x**2 * draw(0.05, 0.5)}
    if chain.law in ("gap", "one-sided-gap"):
        return {"kc": k * draw(0.5, 3), "g": x * draw(0.8, 2.0)}
    if chain.law == "bilinear":
        return {"dk": k * draw(0.05, 0.4)}
    if chain.law == "friction":
        kt = k * draw(0.2, 1)
        return {"kt": kt, "Fs": kt * x * draw(0.2, 0.8)}
    if chain.law == "quadratic-damping":
        return {"c2": 4 * draw(0.01, 0.04) * k * x / v**2}
    return {"m": m * draw(0.02, 0.1), "f": draw(12.0, 110.0), "zeta": draw(0.005, 0.03)}
