"""Gyroscopic coupling of a rotor's two lateral planes, in recordings: responses by the matrix exponential of scipy."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import lsim

from mouse_cli.cli.main import cli
from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.places import planes

M = np.diag([10.0, 8.0, 10.0, 8.0])  # two discs
C0 = np.diag([12.0, 10.0, 12.0, 10.0])  # degrees of freedom x1, x2, y1, y2
K = np.zeros((4, 4))
K[:2, :2] = [[9e4, -4e4], [-4e4, 6e4]]
K[2:, 2:] = [[9.4e4, -4e4], [-4e4, 6.5e4]]
RATE, FINER, SECONDS = 128, 32, 8
RIVALS = "--candidates", "gyroscopic,dashpot,spring,mass,cubic"


def rotor(folder, G: np.ndarray, measured: tuple[int, ...] = (1, 2, 3, 4)) -> str:
    """Two runs under forces at x1 and y1 of the rotor with G beside its dampings; the deck has none of it."""
    A = np.block([[np.zeros((4, 4)), np.eye(4)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C0 + G)]])
    B = np.vstack([np.zeros((4, 2)), np.linalg.inv(M)[:, [0, 2]]])
    t = np.arange(RATE * SECONDS * FINER) / (RATE * FINER)
    for run in ("one", "two"):
        rng, hz = np.random.default_rng(len(run) + ord(run[1])), np.fft.rfftfreq(len(t), t[1])
        lines = np.exp(2j * np.pi * rng.uniform(size=(len(hz), 2))) * ((hz > 2) & (hz < 35))[:, None]
        force = np.fft.irfft(lines, len(t), axis=0) * np.minimum(t, 1)[:, None]
        force *= 20 / force.std()
        motion = lsim((A, B, A[4:], B[4:]), force, t)[1]
        rows = np.column_stack([force, motion])[::FINER]
        rows += 0.005 * rows.std(axis=0) * rng.standard_normal(rows.shape)
        np.savez(folder / f"{run}.npz", **dict(zip(("f1", "f3", "a1", "a2", "a3", "a4"), rows.T, strict=True)))
    upper = lambda matrix: zip(*np.nonzero(np.triu(matrix)), strict=True)
    entries = lambda matrix: [[int(i) + 1, int(j) + 1, float(matrix[i, j])] for i, j in upper(matrix)]
    outputs = ", ".join(f"{i}: a{i}" for i in measured)
    channels = f"inputs: {{1: {{channel: f1, unit: N}}, 3: {{channel: f3, unit: N}}}}, outputs: {{{outputs}}}"
    recordings = "".join(
        f"    - {{title: {run}, file: {run}.npz, sample_rate: {RATE}, {channels}}}\n" for run in ("one", "two")
    )
    path = folder / "rotor.yaml"
    path.write_text(
        f"mouse: 1\nmodel:\n  stiffness: {{order: 4, entries: {entries(K)}}}\n  mass: {{diagonal: {np.diag(M).tolist()}}}\n"
        f"  damping: {{order: 4, entries: {entries(C0)}}}\ntest:\n  recordings:\n{recordings}"
        "  hold_out: {recordings: [two]}\n"
    )
    return str(path)


def answer(*command: str) -> dict:
    done = CliRunner().invoke(cli, [*command, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_a_rotor_at_speed_and_its_deck_with_the_coupling(tmp_path):
    """Without the law a play or an oscillator came nearest, at 1,400 times the variance of the noise."""
    G = np.zeros((4, 4))
    G[1, 3], G[3, 1] = 60.0, -60.0
    deck, revised = rotor(tmp_path, G), str(tmp_path / "revised.yaml")
    found = answer("diagnose", deck, *RIVALS)
    verdict, size = found["verdict"], found["candidates"][0]["parameters"][0]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "gyroscopic", [2, 4])
    assert size["value"] == pytest.approx(60.0, abs=4 * size["sd"] + 0.3)
    CliRunner().invoke(cli, ["diagnose", deck, "-q", "-o", revised, "--candidates", "gyroscopic"])
    again = answer("run", revised)
    assert again["laws"][0]["parameters"][0]["value"] == pytest.approx(60.0, abs=0.5)
    assert answer("diagnose", revised)["verdict"]["kind"] == "nothing-missing"


def test_the_tilts_of_a_disc_that_nobody_measures_are_coupled_too(tmp_path):
    """Lateral motions alone are measured, as probes at a shaft do: the coupling of what they do not see was no candidate, and
    that of a lateral motion with the other plane's tilt came nearest, at six times the noise.
    """
    G = np.zeros((4, 4))
    G[1, 3], G[3, 1] = 60.0, -60.0
    verdict = answer("diagnose", rotor(tmp_path, G, measured=(1, 3)), *RIVALS)["verdict"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "gyroscopic", [2, 4])


def test_of_a_shaft_the_disc_comes_first_and_few_tilts_are_looked_at(tmp_path):
    nodes, path = 16, tmp_path / "shaft.yaml"
    beam = "      - {{id: {0}, type: beam, nodes: [{0}, {1}], material: steel, section: round}}\n"
    path.write_text(
        "mouse: 1\nmodel:\n  structure:\n"
        f"    nodes: {{{', '.join(f'{i}: [{0.1 * i:.1f}, 0, 0]' for i in range(1, nodes + 1))}}}\n"
        "    materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}\n    sections: {round: {circle: 0.03}}\n"
        "    elements:\n"
        + "".join(beam.format(i, i + 1) for i in range(1, nodes))
        + "      - {id: 99, type: mass, nodes: 12, mass: 8, Jx: 0.06, Jy: 0.03, Jz: 0.03}\n"
        f"    supports: {{1: [TX, TY, TZ, RX], {nodes}: [TY, TZ]}}\n"
    )
    problem = read_deck(path)
    labels = problem.structure.labels
    sensed = np.isin(labels, ["6TY", "6TZ"])
    found = [(labels[i], labels[j]) for _, i, j in planes(problem, sensed)]
    assert ("6TY", "6TZ") in found and ("12RY", "12RZ") in found
    assert len(found) <= 10 + 3 and [pair for pair in found if "6TX" in pair]  # those of node 6, and ten more


def test_a_rotor_at_rest_lacks_nothing(tmp_path):
    assert answer("diagnose", rotor(tmp_path, np.zeros((4, 4))))["verdict"]["kind"] == "nothing-missing"


def test_a_dashpot_between_the_planes_is_no_spin(tmp_path):
    G = np.zeros((4, 4))
    G[np.ix_([1, 3], [1, 3])] = [[30.0, -30.0], [-30.0, 30.0]]
    verdict = answer("diagnose", rotor(tmp_path, G), *RIVALS)["verdict"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "dashpot", [2, 4])


def test_a_gyroscopic_law_of_a_deck_wants_two_directions(tmp_path):
    path = tmp_path / "one.yaml"
    path.write_text(
        "mouse: 1\nmodel: {stiffness: {order: 2, entries: [[1,1,1],[2,2,1]]}, mass: {diagonal: [1, 1]}}\n"
        "laws: [{law: gyroscopic, at: [1], values: {gyroscopic_coupling: 1.0}}]\n"
    )
    done = CliRunner().invoke(cli, ["check", str(path)], standalone_mode=False)
    assert done.return_value == 4 and "MD641" in done.output and "couples 2 degrees of freedom" in done.output
