"""Decks that mouse reads, and answers that it never sees."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.blind_records.chain import SAMPLE_RATE, Chain, force, generator, matrices

STIFFNESS_SD = 5  # %, of the springs of the deck
UNITS = {"acceleration": "m/s2", "velocity": "m/s", "displacement": "m"}


@dataclass(frozen=True)
class Setup:
    """How chains are recorded. half: every other mass alone; noise: of the rms of a sensor; undamped: the deck has no damping."""

    half: bool = False
    noise: float = 0.01
    undamped: bool = False


def write(folder: Path, chain: Chain, motion: np.ndarray, setup: Setup, quantity: str = "acceleration") -> Path:
    """The deck with its record, `motion` (t, n) of the masses in a quantity."""
    n, name = len(chain.m), f"{abs(hash_of(chain.name, setup, quantity)):010d}"
    rng = generator(chain.name, "noise", setup.half)
    sensors = np.sort(rng.permutation(n)[: (n + 1) // 2]) if setup.half else np.arange(n)
    a = motion[:, sensors]
    a = a + setup.noise * a.std(axis=0) * rng.standard_normal(a.shape)
    given = force(chain, SAMPLE_RATE * 16)[::16]
    np.savez(folder / f"{name}.npz", f=given, **{f"a{i + 1}": column for i, column in zip(sensors, a.T, strict=True)})
    path = folder / f"{name}.yaml"
    path.write_text(_deck(chain, name, sensors, setup.undamped, quantity))
    return path


def hash_of(*words: object) -> int:
    """A number that tells nothing of the answer."""
    return int(generator("name", *words).integers(10**10))


def answer(chain: Chain) -> dict:
    """What is true: physics and the place as the tool names it."""
    if chain.law == "none":
        return {"name": chain.name, "physics": None, "ids": []}
    first = chain.place + 1
    ids = [first] if chain.law == "oscillator" or chain.place == 0 else [first - 1, first]
    return {"name": chain.name, "physics": chain.law, "ids": ids, "values": chain.values}


def _deck(chain: Chain, name: str, sensors: np.ndarray, undamped: bool, quantity: str) -> str:
    n, k = len(chain.m), chain.nominal_k
    rows = lambda K: [[i + 1, j + 1, float(K[i, j])] for i in range(n) for j in range(i, n) if K[i, j]]
    lines = ["mouse: 1", f"title: chain of {n} masses, record {name}", "model:"]
    lines += [f"  stiffness: {{order: {n}, entries: {rows(matrices(k))}}}"]
    lines += [f"  mass: {{diagonal: {chain.m.tolist()}}}"]
    lines += [] if undamped else [f"  damping: {{order: {n}, entries: {rows(matrices(chain.nominal_c))}}}"]
    lines += ["parameters:"]
    for i in range(n):
        entries = [[1, 1, 1]] if i == 0 else [[i, i, 1], [i, i + 1, -1], [i + 1, i + 1, 1]]
        lines.append(f"  - {{name: k{i + 1}, nominal: {k[i]}, sd: {STIFFNESS_SD} %, stiffness: {entries}}}")
    outputs = [
        f"{{sensor: {i + 1}, channel: a{i + 1}, quantity: {quantity}, unit: {UNITS[quantity]}}}" for i in sensors
    ]
    inputs = f"{{sensor: {chain.driven + 1}, channel: f, quantity: force, unit: N}}"
    lines += ["test:", "  recordings:", f"    - file: {name}.npz", f"      sample_rate: {SAMPLE_RATE:g}"]
    lines += [f"      inputs: [{inputs}]", f"      outputs: [{', '.join(outputs)}]"]
    return "\n".join(lines) + "\n"
