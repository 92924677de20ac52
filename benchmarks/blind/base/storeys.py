"""Storey buildings on a shake table with one concealed mechanism, and how their numbers are drawn."""

import zlib
from dataclasses import dataclass, replace

import numpy as np

KINDS = ("stiffness-loss", "hysteresis", "softening", "loose-brace", "pounding", "added-mass")
PHYSICS = dict(zip(KINDS, ("spring", "friction", "cubic", "gap", "one-sided-gap", "mass"), strict=True))
STIFFNESS_SD, MASS_SD = 0.05, 0.01  # of the deck, by which the structure departs from it too, up to twice as much
RATE, SECONDS = 200.0, 40.0
RUNS, CUBIC_TO = 2, 0.5  # of the table; motion to which a softening storey is cubic, by that at which k x = k3 x^3
BAND = 0.5, 30.0  # Hz, of the table
GROUND = 2 * np.pi * 2.5, 0.6  # rad/s and damping ratio of the ground of an earthquake (Kanai 1957, Tajimi 1960)


@dataclass(frozen=True)
class Storeys:
    """k (n,): storeys from the table on; m (n,): floors; zeta (n,): of each mode. kind of mechanism at storey or floor `place`.

    quake: an artificial earthquake, else a stationary random test; rms: of the acceleration of the table, m/s2; lvdt: sensors read
    displacements relative to the table, not absolute accelerations.
    """

    name: str
    k: np.ndarray
    m: np.ndarray
    zeta: np.ndarray
    nominal_k: np.ndarray
    nominal_m: np.ndarray
    quake: bool
    lvdt: bool
    rms: float
    kind: str = "none"
    place: int = 0
    values: dict[str, float] | None = None


def generator(*words: object) -> np.random.Generator:
    """Random numbers that depend on all `words`, and on nothing else."""
    return np.random.default_rng([zlib.crc32(str(word).encode()) for word in words])


def table(case: Storeys, run: int, rate: float) -> np.ndarray:
    """Acceleration of the table (t,) at `rate`, in m/s2: at rest to begin with."""
    rng, t = generator(case.name, "table", run), int(SECONDS * rate)
    hz = np.fft.rfftfreq(t, 1 / rate)
    own = (hz >= BAND[0]) & (hz <= BAND[1])
    spectrum = np.zeros(len(hz), complex)
    spectrum[own] = np.exp(2j * np.pi * rng.uniform(size=own.sum()))
    if case.quake:
        (w0, z), w = GROUND, 2 * np.pi * hz
        spectrum *= np.abs((w0**2 + 2j * z * w0 * w) / (w0**2 - w**2 + 2j * z * w0 * w))
    found, x = np.fft.irfft(spectrum, t), np.arange(t) / t
    rise = 0.5 - 0.5 * np.cos(np.pi * np.minimum(1.0, x / 0.05))
    found = found * rise * (np.minimum(1.0, np.exp(-4 * (x - 0.45))) if case.quake else 1.0)
    return case.rms * found / found.std()


def matrices(k: np.ndarray) -> np.ndarray:
    """K (n, n) of storeys k, the first on the table."""
    found = np.diag(k + np.append(k[1:], 0.0))
    i = np.arange(len(k) - 1)
    found[i, i + 1] = found[i + 1, i] = -k[1:]
    return found


def modes(case: Storeys) -> tuple[np.ndarray, np.ndarray]:
    """Circular frequencies (n,) and mass-normalised shapes (n, n)."""
    root = np.sqrt(case.m)
    values, shapes = np.linalg.eigh(matrices(case.k) / np.outer(root, root))
    return np.sqrt(values), shapes / root[:, None]


def buildings(seed: int, count: int, controls: int) -> list[Storeys]:
    """`count` buildings of each kind, and `controls` without a mechanism."""
    names = [(kind, i) for kind in KINDS for i in range(count)] + [("none", i) for i in range(controls)]
    return [_drawn(seed, kind, i) for kind, i in names]


def _drawn(seed: int, kind: str, i: int) -> Storeys:
    rng = generator("base", seed, kind, i)
    n = int(rng.integers(3, 6))
    m = rng.uniform(80, 150, n)
    k = rng.uniform(0.7, 1.4, n) * np.sort(rng.uniform(0.6, 1.4, n))[::-1]
    first = np.sqrt(np.linalg.eigvalsh(matrices(k) / np.sqrt(np.outer(m, m)))[0])
    k *= (2 * np.pi * rng.uniform(1.5, 3.5) / first) ** 2
    near = lambda sd: 1 + sd * np.clip(rng.standard_normal(n), -2, 2)
    zeta = np.full(n, 0.0144) if i % 2 else rng.uniform(0.008, 0.03, n)
    bare = Storeys(
        f"base-{seed}-{kind}-{i}", k * near(STIFFNESS_SD), m * near(MASS_SD), zeta, k, m, i % 2 == 1, i % 5 == 3, 1.0
    )
    if kind == "none":
        return bare
    place = int(rng.integers(n))
    bare = replace(bare, kind=kind, place=place)
    return replace(bare, values=_values(rng, bare))


def _drift(case: Storeys, run: int = 0) -> np.ndarray:
    """Drift (t,) of the storey, or of the floor against the table, without a mechanism, m."""
    from scipy.signal import lsim

    w, shapes = modes(case)
    a, t = table(case, run, 400.0), np.arange(int(SECONDS * 400.0)) / 400.0
    parts = [
        lsim(([-s @ case.m], [1, 2 * z * own, own**2]), a, t)[1]
        for own, z, s in zip(w, case.zeta, shapes.T, strict=True)
    ]
    u = shapes @ np.array(parts)
    return u[case.place] - (u[case.place - 1] if case.place and case.kind != "pounding" else 0)


def _softest(case: Storeys) -> float:
    """Cubic stiffness, N/m^3, with which no run leaves the curve that is cubic in truth; they may move twice as far as without."""
    most = max(np.abs(_drift(case, run)).max() for run in range(RUNS))
    return case.k[case.place] * (CUBIC_TO / (2 * most)) ** 2


def _values(rng: np.random.Generator, case: Storeys) -> dict[str, float]:
    """Sizes of the mechanism, by the motion at its place."""
    k, m, draw, x = case.k[case.place], case.m[case.place], rng.uniform, float(_drift(case).std())
    if case.kind == "stiffness-loss":
        return {"share": draw(0.2, 0.5)}
    if case.kind == "added-mass":
        return {"m": m * draw(0.1, 0.3)}
    if case.kind == "hysteresis":
        kt = k * draw(0.2, 1)
        return {"kt": kt, "Fs": kt * x * draw(0.2, 0.8)}
    if case.kind == "softening":
        return {"k3": min(k / x**2 * draw(0.004, 0.015), _softest(case))}
    return {"kc": k * draw(0.5, 3), "g": x * draw(0.8, 2.0), "side": 1.0}
