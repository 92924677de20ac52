"""Chains of masses: as bare matrices, and as storeys, which are springs and masses with numbers of their own."""

from functools import partial

import numpy as np

from benchmarks.trials.assembly import Assembly
from benchmarks.trials.case import Blank, Prior, drawn

STIFFNESS_SD, MASS_SD = 0.07, 0.02
GROUPS = 3  # of springs that share a parameter


def chain(rng: np.random.Generator, storeys: bool = False) -> Blank:
    """Seven to eleven masses on springs that stand on the ground; `storeys`: a structure, else a matrix model."""
    n = int(rng.integers(7, 12))
    k0, m0 = float(np.exp(rng.uniform(np.log(1e4), np.log(1e6)))), float(np.exp(rng.uniform(np.log(0.5), np.log(20))))
    k = [float(f"{k0 * rng.uniform(0.7, 1.3):.5g}") for _ in range(n)]
    m = [float(f"{m0 * rng.uniform(0.7, 1.3):.5g}") for _ in range(n)]
    groups = [[int(i) for i in one] for one in np.array_split(np.arange(n), GROUPS)]
    truth = Assembly(np.zeros((n, n)), np.diag(m))
    for i in range(n):
        truth.spring(link(i, i + 1), k[i])
    priors = {f"k{g}": Prior(STIFFNESS_SD, partial(truth.stiffen, own)) for g, own in enumerate(groups, 1)}
    priors["m"] = Prior(MASS_SD, lambda factor: np.multiply(truth.base[1], factor, out=truth.base[1]))
    return Blank(
        family="storeys" if storeys else "chain",
        truth=truth,
        model=(_structure if storeys else _matrices)(k, m, groups),
        sensors=[(f"{i}TX" if storeys else str(i), i - 1) for i in range(1, n + 1)],
        nodes={str(i): _place(i, storeys) for i in range(n + 1)},
        elements={str(i): _place(i - 0.5, storeys) for i in range(1, n + 1)}
        | {str(100 + i): _place(i, storeys) for i in range(1, n + 1)},
        span=float(n),
        weight=float(sum(m)),
        first=float(np.sqrt(k0 / m0)),
        stiffness=k0,
        masses=[(i, m[i]) for i in range(n)] if storeys else [],
        places={i: _place(i + 1, storeys)[:2] for i in range(n)},
        parameters=drawn(rng, priors),
        priors=priors,
    )


def link(below: int, above: int) -> dict[int, float]:
    """What a spring between masses feels, counted from 1; 0 is the ground."""
    return {i - 1: sign for i, sign in ((below, -1.0), (above, 1.0)) if i}


def _place(i: float, storeys: bool) -> tuple[float, float, float]:
    return (0.0, float(i), 0.0) if storeys else (float(i), 0.0, 0.0)


def _structure(k: list[float], m: list[float], groups: list[list[int]]) -> str:
    n = len(k)
    return "\n".join(
        [
            *("model:", "  structure:"),
            f"    nodes: {{line: {{from: 0, to: {n}, start: [0, 0, 0], end: [0, {n}, 0]}}}}",
            "    elements:",
            f"      - {{id: 1-{n}, type: spring, nodes: 0-{n}, TX: {k}}}",
            f"      - {{id: 101-{100 + n}, type: mass, nodes: 1-{n}, mass: {m}}}",
            *("    supports: {0: all}", "    directions: [TX]", "", "parameters:"),
            *(
                f"  - {{name: k{g}, elements: {own[0] + 1}-{own[-1] + 1}, property: TX, factor: true, sd: 7 %, transform: log}}"
                for g, own in enumerate(groups, 1)
            ),
            f"  - {{name: m, elements: 101-{100 + n}, property: mass, factor: true, sd: 2 %, transform: log}}",
            "",
        ]
    )


def _matrices(k: list[float], m: list[float], groups: list[list[int]]) -> str:
    n = len(k)
    parts = []
    for g, own in enumerate(groups, 1):
        entries = _entries(n, [k[i] if i in own else 0.0 for i in range(n)])
        parts.append(f"  - {{name: k{g}, nominal: 1, sd: 7 %, transform: log, stiffness: {entries}}}")
    masses = [[i, i, one] for i, one in enumerate(m, 1)]
    return "\n".join(
        [
            "model:",
            f"  stiffness: {{order: {n}, entries: {_entries(n, k)}}}",
            f"  mass: {{diagonal: {m}}}",
            *("", "parameters:", *parts),
            f"  - {{name: m, nominal: 1, sd: 2 %, transform: log, mass: {masses}}}",
            "",
        ]
    )


def _entries(n: int, k: list[float]) -> list[list[float]]:
    """Upper triangle of K of a chain that stands on the ground."""
    K = np.zeros((n, n))
    for i, one in enumerate(k):
        b = np.zeros(n)
        b[i] = 1.0
        if i:
            b[i - 1] = -1.0
        K += one * np.outer(b, b)
    return [[i + 1, j + 1, float(K[i, j])] for i in range(n) for j in range(i, n) if K[i, j]]
