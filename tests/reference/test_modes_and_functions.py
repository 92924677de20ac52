"""Diagnosis by few modes and one function together: truths are frames of Hermite elements written here."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import NAMED, NOTHING, Choices

YOUNG, DENSITY, ETA, FINE = 2.1e11, 7850.0, 0.01, 3  # FINE: elements of the truth in each of the deck
OF_FREQUENCY, OF_SHAPE, OF_FUNCTION = 0.003, 0.03, 0.05
DIRECTIONS = ("TX", "TY", "RZ")
KNOWN = Choices(candidates=("mass", "crack", "ground-spring", "support-rotation", "oscillator"), causes=1)


@dataclass(frozen=True)
class Structure:
    """Bars in a row through `nodes`, m; clamped: nodes from 0; A, I of all bars. Sensors, force and response: (node, direction).

    Truth: `added` = (node, kg), `turning` = (node, N m/rad), stiffness and density over those of the deck.
    """

    nodes: tuple[tuple[float, float], ...]
    clamped: tuple[int, ...]
    A: float
    I: float
    sensors: tuple[tuple[int, int], ...]
    force: tuple[int, int]
    response: tuple[int, int]
    band: tuple[float, float]
    added: tuple[int, float] | None = None
    turning: tuple[int, float] | None = None
    stiffness: float = 1.02
    density: float = 0.995

    def matrices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K, M of the truth, and which of three directions of each node is free."""
        ends, parts = np.array(self.nodes), np.arange(FINE) / FINE
        nodes = np.concatenate([a + (b - a) * parts[:, None] for a, b in pairwise(ends)])
        nodes = np.vstack([nodes, ends[-1:]])
        K, M = np.zeros((2, 3 * len(nodes), 3 * len(nodes)))
        for e, (a, b) in enumerate(pairwise(nodes)):
            at = slice(3 * e, 3 * e + 6)
            k, m = self._bar(b - a)
            K[at, at] += k
            M[at, at] += m
        held = {3 * FINE * node + d for node in self.clamped for d in range(3)}
        if self.added:
            node, kg = self.added
            M[[3 * FINE * node, 3 * FINE * node + 1], [3 * FINE * node, 3 * FINE * node + 1]] += kg
        if self.turning:
            node, spring = self.turning
            K[3 * FINE * node + 2, 3 * FINE * node + 2] += spring
            held.remove(3 * FINE * node + 2)
        free = np.setdiff1d(np.arange(len(K)), sorted(held))
        return K[np.ix_(free, free)], M[np.ix_(free, free)], free

    def _bar(self, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness and mass (6, 6) of a bar of Hermite's cubics, in the directions of the frame."""
        l = float(np.hypot(*along))
        (c, s), EI, mass = along / l, self.stiffness * YOUNG * self.I, self.density * DENSITY * self.A
        k, m = np.zeros((2, 6, 6))
        axial, bent, unit = (
            np.ix_([0, 3], [0, 3]),
            np.ix_([1, 2, 4, 5], [1, 2, 4, 5]),
            np.outer([1, l, 1, l], [1, l, 1, l]),
        )
        k[axial] = self.stiffness * YOUNG * self.A / l * np.array([[1, -1], [-1, 1]])
        m[axial] = mass * l / 6 * np.array([[2, 1], [1, 2]])
        k[bent] = EI / l**3 * unit * [[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]
        m[bent] = mass * l / 420 * unit * [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
        T = np.kron(np.eye(2), [[c, s, 0], [-s, c, 0], [0, 0, 1]])
        return T.T @ k @ T, T.T @ m @ T

    def measured(self, rng: np.random.Generator) -> tuple[np.ndarray, ...]:
        """Two frequencies, Hz, and shapes (s, 2); lines (f,), Hz, H (f,), accelerance, and its variance (f,); all with noise."""
        K, M, free = self.matrices()
        row = lambda place: int(np.flatnonzero(free == 3 * FINE * place[0] + place[1])[0])
        eigenvalues, X = eigh(K, M, subset_by_index=[0, 1])
        shapes = X[[row(place) for place in self.sensors]]
        shapes = shapes / np.abs(shapes).max(axis=0) + OF_SHAPE * rng.standard_normal(shapes.shape)
        hz = np.sqrt(eigenvalues) / (2 * np.pi) * (1 + OF_FREQUENCY * rng.standard_normal(2))
        lines, load = np.linspace(*self.band, 150), np.eye(len(K))[row(self.force)]
        solved = lambda w: np.linalg.solve((1 + 1j * ETA) * K - w * w * M, load)[row(self.response)]
        H = np.array([-w * w * solved(w) for w in 2 * np.pi * lines])
        variance = (OF_FUNCTION * np.abs(H)) ** 2 + (0.2 * OF_FUNCTION) ** 2 * (np.abs(H) ** 2).mean()
        noise = rng.standard_normal(len(H)) + 1j * rng.standard_normal(len(H))
        return hz, shapes, lines, H + np.sqrt(variance / 2) * noise, variance

    def deck(self, folder, modes: bool, function: bool):
        """The deck of a test of it, its truth left out."""
        hz, shapes, lines, H, variance = self.measured(np.random.default_rng(3))
        label, column = lambda place: f"{place[0] + 1}{DIRECTIONS[place[1]]}", lambda values: values[:, None, None]
        names = {"output_names": [label(self.response)], "input_names": [label(self.force)], "kind": "accelerance"}
        np.savez(folder / "run.npz", frequency_hz=lines, H=column(H), variance=column(variance), **names)
        n = len(self.nodes)
        nodes = ", ".join(f"{i + 1}: [{x:.6g}, {y:.6g}]" for i, (x, y) in enumerate(self.nodes))
        rows = "\n".join(f"      - [{a:.5f}, {b:.5f}]" for a, b in shapes)
        text = f"""mouse: 1
title: bars in a row
model:
  structure:
    nodes: {{{nodes}}}
    materials: {{steel: {{E: {YOUNG}, nu: 0.3, density: {DENSITY}, loss_factor: {ETA}}}}}
    sections: {{bar: {{A: {self.A}, Iz: {self.I}}}}}
    elements:
      - {{id: 1-{n - 1}, type: beam, nodes: 1-{n}, material: steel, section: bar}}
    supports: {{{", ".join(f"{node + 1}: all" for node in self.clamped)}}}
    plane: XY
parameters:
  - {{name: E, elements: 1-{n - 1}, property: E, sd: 3 %}}
  - {{name: density, elements: 1-{n - 1}, property: density, sd: 1 %}}
test:
"""
        if modes:
            text += f"""  modes:
    frequency: [{hz[0]:.6g}, {hz[1]:.6g}]
    frequency_sd: {100 * OF_FREQUENCY} %
    dofs: [{", ".join(map(label, self.sensors))}]
    shapes:
{rows}
    shape_sd: {100 * OF_SHAPE} %
"""
        text += "  frf: [{file: run.npz}]\n" if function else ""
        (folder / "deck.yaml").write_text(text)
        return read_deck(folder / "deck.yaml")


BEAM = Structure(
    tuple((i / 8, 0.0) for i in range(9)), (0,), 1.2e-4, 3.6e-10, ((3, 1), (8, 1)), (3, 1), (6, 1), (20, 45)
)
_RISE = [(0.0, 0.5 * i) for i in range(5)]
PORTAL = Structure(
    (*_RISE, *((0.75 * i, 2.0) for i in range(1, 5)), *((3.0, 2 - 0.5 * i) for i in range(1, 5))),
    (0, 12), 2e-3, 4.1667e-7, ((2, 0), (4, 0)), (3, 0), (6, 1), (3, 60), stiffness=0.98,
)  # fmt: skip
FOOT = 2 * YOUNG * PORTAL.I  # N m/rad
CASES = {  # truth, group and size of what it has
    "beam with a mass": (replace(BEAM, added=(5, 0.06 * DENSITY * BEAM.A)), "mass", 0.06 * DENSITY * BEAM.A),
    "portal with a foot that turns": (replace(PORTAL, turning=(0, FOOT)), "support", FOOT),
}


def determined(found, group: str, size: float) -> bool:
    """Whether a diagnosis names something and knows how much to 5 %; whatever it names has to be true."""
    if found.kind != NAMED:
        return False
    own = found.best.causes[0].sizes[0]
    assert found.best.group == group and abs(own.value - size) < 3 * own.sd
    return own.sd < 0.05 * size


@pytest.mark.parametrize("name", proofs(CASES))
def test_both_determine_what_neither_alone_does(name, tmp_path):
    truth, group, size = CASES[name]
    found = lambda **data: diagnose(truth.deck(tmp_path, **data), choices=KNOWN)
    assert not determined(found(modes=True, function=False), group, size)
    assert not determined(found(modes=False, function=True), group, size)
    assert determined(found(modes=True, function=True), group, size)


@pytest.mark.parametrize("control", proofs([BEAM, PORTAL], BEAM), ids=["beam", "portal"])
def test_both_leave_a_control_alone(control, tmp_path):
    assert diagnose(control.deck(tmp_path, modes=True, function=True), choices=KNOWN).kind == NOTHING
