"""Bulk data of bars as a deck of mouse's own elements. Truth: NASTRAN-95, OpenSees, closed forms, rotated copies of a model."""

import re
from pathlib import Path

import numpy as np
import pytest
from test_bulk_data import HEAD, written

from mouse_cli import DeckError, read_deck
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.importing.run import imported
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly

FRAME = (
    HEAD.replace("SPC = 2", "SPC = 1") + "GRID,1,,0.,0.,0.\nGRID,2,,.3,.2,1.\nGRID,3,,1.3,.1,1.2\nGRID,4,,1.4,0.,0.\n"
    "GRID,5,,.7,1.,1.1\nGRID,6,,.8,1.1,0.\nGRID,9,,5.,5.,5.\n"
    "CBAR,1,1,1,2,1.,.2,0.\nCBAR,2,1,2,3,0.,1.,.3,,+\n+,,,.02,-.03,.05,.02,.01,.04\nCBAR,3,1,3,4,9\n"
    "CBAR,4,2,2,5,0.,0.,1.\nCBAR,5,2,5,3,0.,0.,1.,,+\n+,56\nCBAR,6,1,5,6,1.,0.,0.\nCROD,7,3,1,5\n"
    "PBAR,1,1,2.-3,1.6-6,3.1-6,2.-6,1.5,,+\n+,,,,,,,,,+\n+,.4,.6\nPBAR,2,1,1.-3,1.2-6,.4-6,1.-6\nPROD,3,1,3.-4,1.-7\n"
    "MAT1,1,2.+11,,.3,7800.\nCONM2,10,3,0,8.,.05,.1,-.08,,+\n+,.2,.03,.3,-.02,.04,.25\n"
    "CELAS2,11,2.+5,5,1\nCELAS2,12,3.+4,5,5,3,5\nSPC1,1,123456,1,4\nSPC1,1,123,6\nENDDATA\n"
)
# NASTRAN-95 (wheel nastran95 0.3), rigid format 3, inverse power method, of FRAME with grid point 9 held
NASTRAN_95 = [31.96063, 56.2573, 128.5073, 294.6291, 334.2935, 496.2316, 556.8418, 560.2769, 644.3287]
NASTRAN_95_COUPLED = [36.50899, 61.30984, 134.1245]  # with PARAM,COUPMASS


def hertz(folder: Path, text: str, count: int | None = None) -> np.ndarray:
    """Frequencies of the deck that an import makes."""
    imported(written(folder, text), folder / "deck.yaml", None, False, str)
    problem = read_deck(folder / "deck.yaml")
    K, M = assembly(problem).matrices(problem.prior.mean)
    return np.sqrt(dense_solution(dense(K), dense(M)).eigenvalues[:count]) / (2 * np.pi)


def test_a_frame_has_the_frequencies_of_nastran(tmp_path):
    """Oblique bars, offsets, shear, a pin, torsion of a rod, a mass off its node with products of inertia, springs in rotation."""
    assert np.allclose(hertz(tmp_path, FRAME, 9), NASTRAN_95, rtol=2e-6)
    coupled = hertz(tmp_path, FRAME.replace("MAT1,1", "PARAM,COUPMASS,1\nMAT1,1"), 3)
    assert np.allclose(coupled, NASTRAN_95_COUPLED, rtol=4e-3)  # whose consistent mass has a mean of both along the bar


def test_what_is_named_is_a_parameter(tmp_path):
    found = imported(written(tmp_path, FRAME), tmp_path / "deck.yaml", None, False, str)
    problem = read_deck(tmp_path / "deck.yaml")
    names = ["E of MAT1_1", "density of MAT1_1", "stiffness of CELAS2_11", "stiffness of CELAS2_12"]
    assert [p.name for p in problem.parameters] == names and found.system == "SI"
    bars = np.array([2.0e-3, 2.0e-3, 2.0e-3, 1.0e-3, 1.0e-3, 2.0e-3, 3.0e-4]) * 7800 + [1.5, 1.5, 1.5, 0, 0, 1.5, 0]
    at = {1: (0, 0, 0), 2: (0.3, 0.2, 1), 3: (1.3, 0.1, 1.2), 4: (1.4, 0, 0), 5: (0.7, 1, 1.1), 6: (0.8, 1.1, 0)}
    at |= {"a": (0.32, 0.17, 1.05), "b": (1.32, 0.11, 1.24)}
    ends = [(1, 2), ("a", "b"), (3, 4), (2, 5), (5, 3), (5, 6), (1, 5)]
    lengths = [np.linalg.norm(np.subtract(at[a], at[b])) for a, b in ends]
    assert found.mass == pytest.approx(8 + bars @ lengths, rel=1e-9)


def test_a_frame_has_the_frequencies_of_opensees(tmp_path):
    ops = pytest.importorskip("openseespy.opensees")
    at = {1: (0, 0, 0), 2: (0.4, 0.1, 1.5), 3: (1.6, 0.3, 1.4), 4: (1.7, 0, 0)}
    bars = {1: (1, 2, (1, 0.2, 0), (0, 0, 0), (0, 0, 0)), 2: (2, 3, (0, 0.4, 1), (0.03, 0.02, -0.05), (-0.04, 0.01, 0.02)),
            3: (3, 4, (0, 1, 0), (0, 0, 0), (0, 0, 0))}  # fmt: skip
    A, I1, I2, J, E, G, rho = 2e-3, 3e-6, 5e-6, 2e-6, 2.1e11, 8e10, 7850.0
    text = HEAD + "".join(f"GRID,{n},,{x},{y},{z}\n" for n, (x, y, z) in at.items())
    for e, (a, b, v, wa, wb) in bars.items():
        text += f"CBAR,{e},1,{a},{b},{v[0]}.,{v[1]},{v[2]},,+\n+,,," + ",".join(map(str, (*wa, *wb))) + "\n"
    text += f"PBAR,1,1,{A},{I1},{I2},{J}\nMAT1,1,{E},{G},,{rho}\nCONM2,9,2,,30.,.1,.2,.15,,+\n+,1.5,,2.,,,2.5\nSPC1,2,123456,1,4\n"
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for n, x in at.items():
        ops.node(n, *map(float, x))
    for n in (1, 4):
        ops.fix(n, *[1] * 6)
    for e, (a, b, v, wa, wb) in bars.items():
        along = np.subtract(at[b], at[a]) + np.subtract(wb, wa)
        ops.geomTransf("Linear", e, *np.cross(along, v).tolist(), "-jntOffset", *map(float, (*wa, *wb)))
        ops.element(
            "elasticBeamColumn", e, a, b, A, E, G, J, I2, I1, e
        )  # a vector in its x-z plane; its Iy is of bending there
        for end, off in ((a, wa), (b, wb)):  # half of the mass at each end of the bar, which is off the node
            ops.node(10 * e + end, *(np.add(at[end], off).tolist()))
            ops.rigidLink("beam", end, 10 * e + end)
            ops.mass(10 * e + end, *[rho * A * float(np.linalg.norm(along)) / 2] * 3, 0.0, 0.0, 0.0)
    ops.node(50, *(np.add(at[2], (0.1, 0.2, 0.15)).tolist()))
    ops.rigidLink("beam", 2, 50)
    ops.mass(50, 30.0, 30.0, 30.0, 1.5, 2.0, 2.5)
    ops.constraints("Transformation")
    expected = np.sqrt(ops.eigen("-fullGenLapack", 8)) / (2 * np.pi)
    ops.wipe()
    assert np.allclose(hertz(tmp_path, text, 8), expected, rtol=1e-6)


def test_points_that_move_in_one_oblique_system_give_the_deck_its_directions(tmp_path):
    """The same frame stated in a system that is turned: a rotation changes no frequency; supports in single directions stay so."""
    plain = FRAME.replace("SPC1,1,123456,1,4\n", "SPC1,1,1235,1,4\n")
    turned = plain.replace("GRID,9", "CORD2R,7,,1.,2.,3.,2.,3.,5.,+\n+,4.,1.,3.\nGRID,9")
    turned = re.sub(r"GRID,(\d),,([^,]*),([^,]*),([^\n]*)", r"GRID,\1,7,\2,\3,\4,7", turned).replace(
        "CONM2,10,3,0", "CONM2,10,3,7"
    )
    assert np.allclose(hertz(tmp_path, turned), hertz(tmp_path, plain), rtol=1e-8)
    one = turned.replace("4,,0.,0.", "4,,0.,0.").replace("GRID,6,7,.8,1.1,0.,7", "GRID,6,7,.8,1.1,0.")
    with pytest.raises(DeckError, match="acts at grid point") as told:
        imported(written(tmp_path, one), tmp_path / "deck.yaml", None, False, str)
    assert {each.code for each in told.value.diagnostics} == {"MD268"}


def test_a_bush_between_points_apart_turns_its_arms(tmp_path):
    """A mass on a bush with stiffness k across it and kr against rotation, at share s of its length L: 1/k + (L (1 - s))^2 / kr."""
    k, kr, m, L, s = 2e5, 3e3, 4.0, 0.5, 0.3
    text = HEAD + f"GRID,1,,0.,0.,0.\nGRID,2,,{L},0.,0.\nCBUSH,5,6,1,2,0.,1.,0.,,+\n+,{s}\n"
    text += f"PBUSH,6,K,,{k},,,,{kr}\nCONM2,9,2,,{m}\nSPC1,2,123456,1\nSPC1,2,1345,2\n"
    flexibility = (
        1 / k + (L * (1 - s)) ** 2 / kr
    )
    assert hertz(tmp_path, text)[0] == pytest.approx(np.sqrt(1 / (m * flexibility)) / (2 * np.pi), rel=1e-9)


def test_principal_axes_and_materials_without_shear(tmp_path):
    """I12 turns the planes of bending of a cantilever; a MAT1 with E alone has no stiffness in torsion, as in Nastran."""
    base = (
        HEAD
        + "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\nMAT1,1,2.+11,,.3\nCONM2,9,2,,50.\nSPC1,2,123456,1\n"
    )
    I1, I2, I12 = 3e-6, 1e-6, 0.8e-6
    own = hertz(tmp_path, base + f"PBAR,1,1,1.-3,{I1},{I2},1.-6,,,+\n+,,,,,,,,,+\n+,,,{I12}\n")
    expected = np.sqrt(3 * 2e11 * np.linalg.eigvalsh([[I1, I12], [I12, I2]]) / 50) / (2 * np.pi)
    assert np.allclose(own[:2], expected, rtol=1e-9)
    weak = base.replace(",,.3", "") + "PBAR,1,1,1.-3,1.-6,1.-6,1.-6\n"
    imported(written(tmp_path, weak), tmp_path / "deck.yaml", None, False, str)
    assert "2RX" not in read_deck(tmp_path / "deck.yaml").structure.labels


BEAM = (
    HEAD + "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nSPC1,2,123456,1\nMAT1,1,2.+11,,.3,7800.\nPBAR,1,1,1.-3,1.-6,1.-6,1.-6\n"
)
REFUSED = {
    "a taper": ("CBEAM,3,4,1,2,0.,1.,0.\nPBEAM,4,1,1.-3,1.-6,1.-6,,1.-6,,+\n+,,,,,,,,,+\n+,YES,1.,2.-3\n",
                "MD268", "changes its section"),
    "no property": ("CBAR,3,4,1,2,0.,1.,0.\n", "MD271", "no property"),
    "no material": ("CBAR,3,4,1,2,0.,1.,0.\nPBAR,4,9,1.-3,1.-6\n", "MD271", "material 9"),
    "along it": ("CBAR,3,1,1,2,1.,0.,0.\n", "MD265", "no orientation"),
    "axes of its own": ("CBAR,3,1,1,2,0.,1.,0.,GOO,+\n+,,,.1\n", "MD268", "along its own axes"),
    "no point": ("CBAR,3,1,1,7,0.,1.,0.\n", "MD272", "grid point 7"),
    "a section": ("CBAR,3,4,1,2,0.,1.,0.\nPBARL,4,1,,HEXA,,,,,+\n+,.1,.1,.1\n", "MD268", "HEXA"),
    "a scalar point": ("CBAR,3,1,1,2,0.,1.,0.\nSPOINT,8\nCELAS2,9,1.+3,8\n", "MD268", "scalar point"),
    "two directions": ("CBAR,3,1,1,2,0.,1.,0.\nCELAS2,9,1.+3,1,1,2,2\n", "MD268", "two directions"),
    "RBE3": ("CBAR,3,1,1,2,0.,1.,0.\nRBE3,9,,1,123,1.,123,2\n", "MD268", "RBE3 has no counterpart"),
    "no mass": ("CBAR,3,4,1,2,0.,1.,0.\nPBAR,4,5,1.-3,1.-6,1.-6,1.-6\nMAT1,5,2.+11,,.3\n", "MD263", "no mass"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_bar_of_mouse_is_refused_by_its_line(name, tmp_path):
    text, code, words = REFUSED[name]
    with pytest.raises(DeckError, match=words) as told:
        imported(written(tmp_path, BEAM + text), tmp_path / "deck.yaml", None, False, str)
    found = told.value.diagnostics[0]
    assert found.code == code and found.help and found.span.file.endswith("job.bdf")
    assert not (tmp_path / "deck.yaml").exists()


def test_defaults_and_tabs(tmp_path):
    """GRDSET, BAROR and tabs between fields: the same beam as with everything in its place; planar by GRDSET."""
    plain = BEAM + "CBAR,3,1,1,2,0.,1.,0.\nSPC1,2,345,2\n"
    headless = "PARAM,GRDPNT,0\n" + plain.partition("BEGIN BULK\n")[2]
    assert np.allclose(hertz(tmp_path, headless), hertz(tmp_path, plain), rtol=1e-12)
    short = BEAM.replace("GRID,1", "GRDSET,,,,,,,345\nBAROR,,1,,,0.,1.,0.\nGRID,1") + "CBAR\t3\t\t1\t2\n"
    assert np.allclose(hertz(tmp_path, short), hertz(tmp_path, plain), rtol=1e-12)
