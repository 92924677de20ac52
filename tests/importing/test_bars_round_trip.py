"""From bulk data of bars to a revised model and back to cards. Truth: OpenSees, of a model with other springs than the job."""

import re

import numpy as np
import pytest
from test_bars import BEAM
from test_bulk_data import HEAD, written

from mouse_cli import read_deck
from mouse_cli.cli.main import main
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.elements import Layout, registry

A, IZ, IY, J, E, RHO, TRUE = 1e-3, 1e-6, 2e-6, 1.5e-6, 2e11, 7800.0, 4e4
MAST = (
    HEAD + "".join(f"GRID,{n},,0.,0.,{0.5 * n}\n" for n in range(9)).replace("GRID,0", "GRID,20")
    + "".join(f"CBAR,{n},7,{n - 1 or 20},{n},0.,1.,0.\n" for n in range(1, 9)) + "$ Femap Property 7 : Mast\n"
    f"PBAR,7,3,{A},{IZ},{IY},{J},,,+\n+,,,,,,,,,+\n+,.5,.5\nMAT1,3,{E},,.3,{RHO}\nPARAM,WTMASS,.5\n"
    "CONM2,31,8,,24.,.1,.0,.2,,+\n+,1.,,1.2,,,.6\nCELAS2,41,8.+4,20,4\nCELAS2,42,8.+4,20,5\nSPC1,2,1236,20\nENDDATA\n"
)  # fmt: skip


def ran(words: list[str]) -> int:
    """Exit code of a command."""
    with pytest.raises(SystemExit) as ended:
        main(words)
    return ended.value.code


def truth(count: int, sensors: list[int]) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies and shapes (r, count), TX then TY of the sensors, with softer springs at the foot."""
    ops = pytest.importorskip("openseespy.opensees")
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for n in range(9):
        ops.node(n or 20, 0.0, 0.0, 0.5 * n)
    ops.node(99, 0.0, 0.0, 0.0)
    ops.fix(99, *[1] * 6)
    ops.fix(20, 1, 1, 1, 0, 0, 1)
    for d in (4, 5):
        ops.uniaxialMaterial("Elastic", d, TRUE)
        ops.element("zeroLength", 100 + d, 99, 20, "-mat", d, "-dir", d)
    ops.geomTransf("Linear", 1, -1.0, 0.0, 0.0)  # local z
    G = E / 2.6
    for n in range(1, 9):
        shear = "ElasticTimoshenkoBeam", n, n - 1 or 20, n, E, G, A, J, IY, IZ, A / 2, A / 2, 1
        ops.element(*shear, "-mass", 0.5 * RHO * A)
    ops.node(50, 0.1, 0.0, 4.2)
    ops.rigidLink("beam", 8, 50)
    ops.mass(50, 12.0, 12.0, 12.0, 0.5, 0.6, 0.3)
    ops.constraints("Transformation")
    hz = np.sqrt(ops.eigen("-fullGenLapack", count)) / (2 * np.pi)
    shapes = np.array([[ops.nodeEigenvector(n, m, d) for m in range(1, count + 1)] for d in (1, 2) for n in sensors])
    ops.wipe()
    return hz, shapes / np.abs(shapes).max(axis=0)


def test_revised_springs_go_back_under_the_numbers_of_the_job(tmp_path, capsys):
    sensors = [2, 4, 6, 8]
    hz, shapes = truth(5, sensors)
    job, deck = written(tmp_path, MAST), tmp_path / "mast.yaml"
    assert ran(["import", job, "-o", str(deck)]) == 0
    text = (
        deck.read_text()
        .partition("# The test")[0]
        .replace("CELAS2_41, elements: 41, property: RX, sd: 20 %", "CELAS2_41, elements: 41, property: RX, sd: 60 %")
    )
    text = text.replace(
        "CELAS2_42, elements: 42, property: RY, sd: 20 %", "CELAS2_42, elements: 42, property: RY, sd: 60 %"
    )
    rows = "".join(f"      - [{', '.join(f'{x:.6f}' for x in row)}]\n" for row in shapes)
    dofs = ", ".join(f"{n}T{d}" for d in "XY" for n in sensors)
    text += f"test:\n  modes:\n    frequency: [{', '.join(f'{f:.6f}' for f in hz)}]\n    frequency_sd: 0.1 %\n"
    deck.write_text(text + f"    dofs: [{dofs}]\n    shapes:\n{rows}    shape_sd: 0.01\n")
    answer = tmp_path / "answer.json"
    assert ran(["run", str(deck), "--json", "-o", str(answer)]) in (0, 1)
    capsys.readouterr()
    assert ran(["export", str(deck), "--result", str(answer), "--for", "nastran", "--job", job]) == 0
    made = capsys.readouterr().out
    cards = re.sub(r"\n\*", "", made)
    springs = {int(n): float(k) for n, k in re.findall(r"CELAS2\* +(\d+) +(\S+)", cards)}
    assert springs.keys() == {41, 42} and all(k == pytest.approx(TRUE, rel=0.02) for k in springs.values())
    material = re.search(r"MAT1\* +(\d+) +(\S+) +(\S+) +(\S+)", cards)
    assert int(material[1]) == 3 and float(material[2]) == pytest.approx(E, rel=0.02)
    assert float(material[4]) == pytest.approx(RHO, rel=0.02)  # as the job counts mass: PARAM,WTMASS
    words = re.search(r"CONM2\*([^$]*)", cards)[1].split()
    numbers = [float(word) for word in words]
    assert numbers[:7] == pytest.approx([31, 8, 0, 24, 0.1, 0.0, 0.2]) and numbers[7:] == pytest.approx([1.0, 1.2, 0.6])


def with_section(tmp_path, capsys, text: str) -> str:
    """Cards of a job whose deck has the section MAST revised."""
    job, deck = written(tmp_path, text), tmp_path / "mast.yaml"
    assert ran(["import", job, "-o", str(deck)]) == 0
    line = "  - {name: IZ, section: MAST, property: Iz, sd: 5 %}\n"
    deck.write_text(deck.read_text().replace("parameters:\n", "parameters:\n" + line))
    capsys.readouterr()
    assert ran(["export", str(deck), "--for", "nastran", "--job", job]) == 0
    return capsys.readouterr().out


def test_a_revised_section_is_a_pbar_of_the_job(tmp_path, capsys):
    """Number, material, and what mouse does not revise: shear and nonstructural mass."""
    made = with_section(tmp_path, capsys, MAST.replace(f"{J},,,+", f"{J},2.5,,+"))
    card = re.search(r"PBAR\*([^$C]*)", made)[1].replace("*", "").split()
    assert [float(word) for word in card] == pytest.approx([7, 3, A, IZ, IY, J, 2.5, 0.5, 0.5])


def test_a_section_whose_axes_are_not_principal_is_told_and_not_written(tmp_path, capsys):
    """The deck has it about principal axes, and the elements of the job are turned otherwise."""
    made = with_section(tmp_path, capsys, MAST.replace("+,.5,.5", "+,,,.5-6"))
    assert "PBAR*" not in made and "not written: PBAR 7 has a product of inertia I12" in made
    largest = np.linalg.eigvalsh([[IZ, 0.5e-6], [0.5e-6, IY]])[1]
    assert f"{largest:.6g}" in made


def test_a_mass_off_its_node_is_a_rigid_body():
    """M about the node by Huygens and Steiner; the products of inertia turn with the axes."""
    kind, r, m, Jc = registry()["mass"], np.array([0.3, -0.2, 0.5]), 4.0, np.diag([0.1, 0.2, 0.3])
    turn = np.linalg.qr(np.arange(9.0).reshape(3, 3) ** 1.5 + np.eye(3))[0]
    J = turn @ Jc @ turn.T
    values = {"mass": m, "Jx": J[0, 0], "Jy": J[1, 1], "Jz": J[2, 2], "Jxy": -J[0, 1], "Jxz": -J[0, 2], "Jyz": -J[1, 2]}
    layout = Layout(np.zeros((1, 1, 3)), {"offset": r.tolist()})
    M = kind.matrices(layout, {name: np.array([value]) for name, value in values.items()})["M"][0]
    about = J + m * (r @ r * np.eye(3) - np.outer(r, r))
    assert np.allclose(M[3:, 3:], about) and np.allclose(M[:3, :3], m * np.eye(3))
    w = np.array([0.7, 0.1, -0.4])
    assert np.allclose(M[:3, 3:] @ w, m * np.cross(w, r))


def test_bars_without_density_follow_the_masses(tmp_path, capsys):
    """A massless cantilever with a mass at its end and a point midway: sqrt(3 E I / m l^3), and a warning for what has no mass."""
    text = (
        BEAM.replace(",,.3,7800.", ",,.3")
        + "GRID,3,,2.,0.,0.\nCBAR,3,1,1,2,0.,1.,0.\nCBAR,4,1,2,3,0.,1.,0.\nCONM2,9,3,,5.\n"
    )
    job = written(tmp_path, text)
    assert ran(["import", job, "-o", str(tmp_path / "deck.yaml")]) == 0
    problem = read_deck(tmp_path / "deck.yaml")
    K, M = assembly(problem).matrices(problem.prior.mean)
    hz = np.sqrt(dense_solution(dense(K), dense(M)).eigenvalues) / (2 * np.pi)
    assert hz[:2] == pytest.approx(np.sqrt(3 * 2e11 * 1e-6 / (5 * 8)) / (2 * np.pi), rel=1e-9)
    assert [(each.code, each.severity) for each in problem.warnings] == [("MD304", "warning")]
    capsys.readouterr()
    assert ran(["modes", str(tmp_path / "deck.yaml")]) == 0 and f"{hz[0]:.2f}" in capsys.readouterr().out
