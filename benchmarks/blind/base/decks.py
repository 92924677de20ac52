"""Decks of shake table tests that mouse reads, and answers that it never sees."""

from pathlib import Path

import numpy as np

from benchmarks.blind.base.storeys import MASS_SD, PHYSICS, RATE, STIFFNESS_SD, Storeys, generator, matrices

NOISE = 0.01  # of the rms of each channel


def write(folder: Path, case: Storeys, runs: list[tuple[np.ndarray, np.ndarray]]) -> Path:
    """The deck with two runs of the table, the second held out; damping left out of the deck."""
    name = f"{int(generator('name', case.name).integers(10**10)):010d}"
    rng = generator(case.name, "noise")
    heads = ["ag", *(f"f{i + 1}" for i in range(len(case.m)))]
    for i, (given, found) in enumerate(runs, 1):
        whole = np.column_stack([given, found])
        whole = whole + NOISE * whole.std(axis=0) * rng.standard_normal(whole.shape)
        text = ",".join(heads)
        np.savetxt(folder / f"{name}-{i}.csv", whole, "%.8e", ",", header=text, comments="")
    path = folder / f"{name}.yaml"
    path.write_text(_deck(case, name, len(runs)))
    return path


def answer(case: Storeys) -> dict:
    """What is true: physics and the place as the tool names it."""
    if case.kind == "none":
        return {"name": case.name, "physics": None, "ids": []}
    first = case.place + 1
    single = case.kind in ("added-mass", "pounding") or case.place == 0
    return {"name": case.name, "physics": PHYSICS[case.kind], "ids": [first] if single else [first - 1, first]}


def _deck(case: Storeys, name: str, runs: int) -> str:
    n, k, m = len(case.m), case.nominal_k, case.nominal_m
    K = matrices(k)
    rows = [[i + 1, j + 1, float(K[i, j])] for i in range(n) for j in range(i, n) if K[i, j]]
    lines = ["mouse: 1", f"title: building of {n} storeys on a table, {name}", "model:"]
    lines += [f"  stiffness: {{order: {n}, entries: {rows}}}", f"  mass: {{diagonal: {m.tolist()}}}", "parameters:"]
    for i in range(n):
        entries = [[1, 1, 1]] if i == 0 else [[i, i, 1], [i, i + 1, -1], [i + 1, i + 1, 1]]
        lines.append(f"  - {{name: k{i + 1}, nominal: {k[i]}, sd: {100 * STIFFNESS_SD:g} %, stiffness: {entries}}}")
    for i in range(n):
        lines.append(f"  - {{name: m{i + 1}, nominal: {m[i]}, sd: {100 * MASS_SD:g} %, mass: [[{i + 1}, {i + 1}, 1]]}}")
    unit = "m" if case.lvdt else "m/s2"
    outputs = ", ".join(f"{{sensor: {i + 1}, channel: f{i + 1}, unit: {unit}}}" for i in range(n))
    lines += ["test:", "  recordings:"]
    for run in range(1, runs + 1):
        lines += [f"    - file: {name}-{run}.csv", f"      sample_rate: {RATE:g}"]
        lines += ["      inputs: [{sensor: ground, channel: ag, unit: m/s2}]", f"      outputs: [{outputs}]"]
        lines += ["      frame: relative"] if case.lvdt else []
    return "\n".join([*lines, f"  hold_out: {{recordings: [{name}-{runs}]}}"]) + "\n"
