"""Decks that mouse reads, as a newcomer writes them, and answers that it never sees."""

from pathlib import Path

import numpy as np

from benchmarks.blind.drives.draws import MASS_SD, Case, generator, measured

_UNITS = {"position": ("displacement", "m"), "velocity": ("velocity", "m/s"), "acceleration": ("acceleration", "m/s2")}


def write(folder: Path, case: Case) -> Path:
    """The deck with its record."""
    name = f"{int(generator('name', case.name).integers(10**10)):010d}"
    rate, force, motion = measured(case)
    np.savez(folder / f"{name}.npz", f=force, **{f"y{i}": column for i, column in enumerate(motion.T, 1)})
    path = folder / f"{name}.yaml"
    path.write_text(_deck(case, name, rate))
    return path


def answer(case: Case) -> dict:
    """What is true."""
    if case.sound:
        return {"name": case.name, "physics": None, "ids": [], "force": 0.0}
    ids = [f"{case.drive.at + 1}TX"]
    return {"name": case.name, "physics": "friction", "ids": ids, "force": case.drive.friction}


def _deck(case: Case, name: str, rate: float) -> str:
    """Masses, dashpots to the ground and the shaft; nothing holds the drive."""
    n, (k, d, _) = case.drive.n, case.drive.shaft
    lines = ["mouse: 1", f"title: drive {name}", "units: SI", "model:", "  structure:"]
    lines += [f"    nodes: {{{', '.join(f'{i}: [{i}, 0, 0]' for i in range(1, n + 1))}}}", "    elements:"]
    for i, (m, c) in enumerate(zip(case.nominal_m, case.nominal_c, strict=True), 1):
        lines += [f"      - {{id: {i}, type: mass, nodes: {i}, mass: {m:.6g}}}"]
        lines += [f"      - {{id: {10 + i}, type: dashpot, nodes: {i}, TX: {c:.6g}}}"]
    if n == 2:
        lines += [f"      - {{id: 20, type: spring, nodes: [1, 2], TX: {k:.6g}}}"]
        lines += [f"      - {{id: 21, type: dashpot, nodes: [1, 2], TX: {d:.6g}}}"]
    lines += ["    directions: [TX]"]
    if case.stated:
        lines += ["parameters:"]
        lines += [
            f"  - {{name: m{i}, elements: {i}, property: mass, sd: {100 * MASS_SD:g} %}}" for i in range(1, n + 1)
        ]
    quantity, unit = _UNITS[case.quantity]
    output = lambda i: f"{{sensor: {i}TX, channel: y{i}, quantity: {quantity}, unit: {unit}}}"
    lines += ["test:", "  recordings:", f"    - file: {name}.npz", f"      sample_rate: {rate:g}"]
    lines += ["      inputs: [{sensor: 1TX, channel: f, quantity: force, unit: N}]"]
    lines += [f"      outputs: [{', '.join(output(i) for i in range(1, n + 1))}]"]
    return "\n".join(lines) + "\n"
