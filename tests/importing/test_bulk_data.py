"""mouse import of Nastran bulk data: cards of CalculiX made of them, against input written by hand and the manuals of both."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from test_import import BAR

from mouse_cli import DeckError, read_deck
from mouse_cli.importing.calculix import Solver
from mouse_cli.importing.jobs import frequencies
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported

solver = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")

HEAD = "SOL 103\nCEND\nSPC = 2\nBEGIN BULK\n"
BRICKS = (
    HEAD + "PARAM,POST,-1\nEIGRL,1,,,4\n"
    '$HMNAME PROP                   1"low part"\n$ Femap Property 2 : High\n$ Femap Material 1 : S235\n'
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "GRID           5              0.      0.     1.0\n"
    "GRID*                  6                             1.0             0.0\n*                    1.0\n"
    "GRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\nGRID,9,,0.,0.,2.\nGRID,10,,1.,0.,2.\nGRID,11,,1.,1.,2.\nGRID,12,,0.,1.,2.\n"
    "CHEXA          1       1       1       2       3       4       5       6+\n+              7       8\n"
    "CHEXA,2,2,5,6,7,8,9,10,\n,11,12\n"
    "PSOLID,1,1\nPSOLID,2,1\nMAT1,1,2.1+11,,.3,7850.\n"
    "SPC1,1,123,9,THRU,12\nSPC1,2,123456,1,THRU,4\nENDDATA\n"
)


def written(folder: Path, text: str) -> str:
    (folder / "job.bdf").write_text(text)
    return str(folder / "job.bdf")


def hertz(text: str) -> np.ndarray:
    with Solver("job.inp", None, str) as ccx:
        return np.sqrt(np.sort(ccx.eigenvalues(text, "by hand"))) / (2 * np.pi)


@solver
def test_bricks_have_the_frequencies_of_an_input_written_by_hand(tmp_path):
    """Fields of all three widths, continuations, a choice of supports; C3D8I by hand. The whole import checks itself."""
    expected = hertz(BAR.replace("C3D8,", "C3D8I,") + "*STEP\n*FREQUENCY\n4\n*END STEP\n")
    model = read(written(tmp_path, BRICKS))
    assert np.allclose(hertz(frequencies(model, 4)), expected, rtol=1e-9)
    found = imported(written(tmp_path, BRICKS), tmp_path / "deck.yaml", None, False, str)
    problem = read_deck(tmp_path / "deck.yaml")
    assert [group.name for group in problem.groups] == ["LOW_PART", "HIGH"] and found.system == "SI"
    assert [p.name for p in problem.parameters] == ["E of S235", "density of S235"]
    assert [each.name for each in problem.held.supports] == ["SPC1_2_1"]


@solver
def test_shells_masses_springs_and_rigid_elements(tmp_path):
    """Against the same in keywords of CalculiX, PARAM,WTMASS too."""
    grids = [(0.1 * i, 0.1 * j) for i in range(5) for j in range(3)]
    quads = [(3 * i + j + 1, 3 * i + j + 4, 3 * i + j + 5, 3 * i + j + 2) for i in range(4) for j in range(2)]
    bulk = HEAD + "PARAM,WTMASS,.5\n" + "".join(f"GRID,{n},,{x},{y},0.\n" for n, (x, y) in enumerate(grids, 1))
    bulk += "".join(f"CQUAD4,{e},3,{','.join(map(str, q))}\n" for e, q in enumerate(quads, 1))
    bulk += "PSHELL,3,7,.004,7\nMAT1,7,7.+10,2.7+10,,5400.\nCONM2,20,13,,2.\nCELAS2,21,1.+4,15,3\nPELAS,8,2.+4\n"
    bulk += "CELAS1,22,8,13,3,15,3\nSPC,2,1,123,0.,2,123\nSPC,2,3,123,0.\nSPC,2,4,3\nSPC1,2,3,6\n"
    keywords = "*NODE\n" + "".join(f"{n}, {x}, {y}, 0.\n" for n, (x, y) in enumerate(grids, 1))
    keywords += "*ELEMENT, TYPE=S4, ELSET=E\n" + "".join(
        f"{e}, {', '.join(map(str, q))}\n" for e, q in enumerate(quads, 1)
    )
    keywords += f"*MATERIAL, NAME=M\n*ELASTIC\n7e10, {7 / 5.4 - 1!r}\n*DENSITY\n2700.\n*SHELL SECTION, ELSET=E, MATERIAL=M\n0.004\n"
    keywords += "*ELEMENT, TYPE=MASS, ELSET=A\n20, 13\n*MASS, ELSET=A\n1.\n"
    keywords += "*ELEMENT, TYPE=SPRING1, ELSET=B\n21, 15\n*SPRING, ELSET=B\n3\n1.0e4\n"
    keywords += "*ELEMENT, TYPE=SPRING2, ELSET=C\n22, 13, 15\n*SPRING, ELSET=C\n3, 3\n2.0e4\n"
    keywords += "*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 3\n4, 3, 3\n6, 3, 3\n"
    model = read(written(tmp_path, bulk))
    assert [group.name for group in model.groups] == ["PSHELL_3", "CONM2_20", "CELAS1_22", "CELAS2_21"]
    step = "*STEP\n*FREQUENCY\n6\n*END STEP\n"
    assert np.allclose(hertz(frequencies(model, 6)), hertz(keywords + step), rtol=1e-6)
    rigid = read(
        written(
            tmp_path, BRICKS.replace("ENDDATA", "GRID,20,,.5,.5,4.\nRBE2,90,20,123456,9,THRU,12\nCONM2,91,20,,1.+5\n")
        )
    )
    by_hand = BAR.replace("C3D8,", "C3D8I,").replace("12, 0., 1., 2.\n", "12, 0., 1., 2.\n20, .5, .5, 4.\n")
    by_hand += "*NSET, NSET=TOP\n9, 10, 11, 12\n*RIGID BODY, NSET=TOP, REF NODE=20\n"
    by_hand += "*ELEMENT, TYPE=MASS, ELSET=D\n91, 20\n*MASS, ELSET=D\n1.0e5\n"
    assert np.allclose(hertz(frequencies(rigid, 4)), hertz(by_hand + step.replace("6", "4")), rtol=1e-6)


EDGES = {  # pairs of corners that mid-side nodes lie between: in the order of Nastran, and in that of CalculiX
    "CHEXA": (8, "12 23 34 41 15 26 37 48 56 67 78 85", "12 23 34 41 56 67 78 85 15 26 37 48"),
    "CPENTA": (6, "12 23 31 14 25 36 45 56 64", "12 23 31 45 56 64 14 25 36"),
    "CTETRA": (4, "12 23 31 14 24 34", "12 23 31 14 24 34"),
    "CQUAD8": (4, "12 23 34 41", "12 23 34 41"),
    "CTRIA6": (3, "12 23 31", "12 23 31"),
}


@pytest.mark.parametrize("name", EDGES)
def test_mid_side_nodes_are_in_the_order_of_the_solver(name, tmp_path):
    """MSC Nastran Quick Reference Guide; CalculiX manual, element types."""
    corners, own, theirs = EDGES[name]
    at = np.random.default_rng(1).uniform(0, 1, (corners, 3))
    middle = lambda edges: [(at[int(e[0]) - 1] + at[int(e[1]) - 1]) / 2 for e in edges.split()]
    points = [*at, *middle(own)]
    text = "".join(f"GRID,{n},,{x:.9f},{y:.9f},{z:.9f}\n" for n, (x, y, z) in enumerate(points, 1))
    fields = [name, "1", "1", *(str(n) for n in range(1, len(points) + 1))]
    text += "\n".join(
        ",".join(["", *fields[1:][k : k + 8]]) if k else ",".join(fields[:9]) for k in range(0, len(fields) - 1, 8)
    )
    shell = name in ("CQUAD8", "CTRIA6")
    text += f"\n{'PSHELL,1,1,.1,1' if shell else 'PSOLID,1,1'}\nMAT1,1,2.1+11,,.3,7850.\n"
    model = read(written(tmp_path, text))
    nodes = np.array([model.nodes[n] for n in model.elements[1][1]])
    assert np.allclose(nodes, [*at, *middle(theirs)], atol=1e-8)


MORE = BRICKS.replace("ENDDATA\n", "")
REFUSED = {
    "a beam": (MORE + "CBAR,9,9,1,2,0.,0.,1.\n", "MD268", "stands among shells or solids"),
    "a layered shell": (MORE + "PCOMP,9\n", "MD268", "PCOMP"),
    "a local system that is not there": (MORE.replace("GRID,12,,", "GRID,12,5,"), "MD272", "5 is not defined"),
    "an offset": (MORE + "CQUAD4,9,9,9,10,11,12,,.1\nPSHELL,9,1,.1,1\n", "MD268", "offset"),
    "nonstructural mass": (MORE + "CQUAD4,9,9,9,10,11,12\nPSHELL,9,1,.1,1,,,,3.\n", "MD268", "nonstructural"),
    "a membrane": (MORE + "CQUAD4,9,9,9,10,11,12\nPSHELL,9,1,.1\n", "MD268", "bends otherwise"),
    "a part of a rigid element": (MORE + "RBE2,9,9,123,10,11\n", "MD268", "directions 123 alone"),
    "a mass off its node": (MORE + "CONM2,9,9,,1.,.1\n", "MD268", "off its node"),
    "rotary inertia": (MORE + "CONM2,9,9,,1.\n,3.\n", "MD268", "rotary inertia"),
    "several sets of supports": (MORE.replace("SPC = 2\n", ""), "MD273", "sets 1, 2"),
    "supports of another set": (MORE.replace("SPC = 2", "SPC = 7"), "MD273", "SPC = 7, and the bulk data have the sets 1, 2"),
    "a node too few": (MORE + "CTRIA3,9,9,9,10\n", "MD265", "2 nodes"),
    "a node that is not there": (MORE + "CTETRA,9,2,9,10,11,77\n", "MD272", "node 77"),
    "no density": (MORE.replace(",7850.", ""), "MD271", "DENSITY"),
    "no number": (MORE.replace("2.1+11", "2.1x11"), "MD252", "expected a number"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_counterpart_is_refused_by_its_line(name, tmp_path):
    text, code, words = REFUSED[name]
    with pytest.raises(DeckError) as told:
        read(written(tmp_path, text))
    found = told.value.diagnostics[0]
    assert found.code == code and re.search(words, found.message) and found.help, told.value
    assert found.span.file.endswith("job.bdf") and found.span.line > 1


def test_the_line_that_is_shown_is_that_of_the_file(tmp_path):
    with pytest.raises(DeckError) as told:
        read(written(tmp_path, MORE + "CTETRA,9,2,9,10,11,77\n"))
    span = told.value.diagnostics[0].span
    assert span.text == "CTETRA,9,2,9,10,11,77" and span.line == len(MORE.splitlines()) + 1


def test_supports_of_grids_and_of_added_sets(tmp_path):
    """SPCADD joins sets; what GRID itself holds is a support too."""
    text = BRICKS.replace("SPC = 2", "SPC = 9").replace("ENDDATA", "SPCADD,9,1,2\nENDDATA")
    text = text.replace("GRID,7,,1.,1.,1.", "GRID,7,,1.,1.,1.,,12")
    model = read(written(tmp_path, text))
    assert [(each.name, len(each.dofs)) for each in model.supports] == [("SPC1_1_1", 12), ("SPC1_2_1", 12), ("GRID", 2)]


@solver
def test_a_mass_with_inertia_off_its_node_is_spread_over_its_rigid_body(tmp_path):
    """A cube of 2e4 kg, 2 by 1 by 0.5 m, turned, its centre 0.3 above the node; by hand: 8 masses at corners with such moments."""
    size, heavy, centre = np.array([2.0, 1.0, 0.5]), 2e4, np.array([0.5, 0.5, 4.3])
    axes = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * size / np.sqrt(12) @ axes.T
    tensor = heavy * (np.trace(corners.T @ corners / 8) * np.eye(3) - corners.T @ corners / 8)
    moments = [tensor[0, 0], -tensor[1, 0], tensor[1, 1], -tensor[2, 0], -tensor[2, 1], tensor[2, 2]]
    more = f"CONM2,91,20,,{heavy},0.,0.,.3\n,{','.join(f'{each:.9g}' for each in moments)}\n"
    bulk = BRICKS.replace("ENDDATA", "GRID,20,,.5,.5,4.\nRBE2,90,20,123456,9,THRU,12\n" + more)
    by_hand = BAR.replace("C3D8,", "C3D8I,").replace("12, 0., 1., 2.\n", "12, 0., 1., 2.\n20, .5, .5, 4.\n")
    points = enumerate((centre + corners).tolist(), 31)
    by_hand += "*NODE, NSET=TOP\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in points)
    by_hand += "*NSET, NSET=TOP\n9, 10, 11, 12\n*RIGID BODY, NSET=TOP, REF NODE=20\n*ELEMENT, TYPE=MASS, ELSET=D\n"
    by_hand += "".join(f"{91 + i}, {31 + i}\n" for i in range(8)) + f"*MASS, ELSET=D\n{heavy / 8}\n"
    model = read(written(tmp_path, bulk))
    expected = hertz(by_hand + "*STEP\n*FREQUENCY\n6\n*END STEP\n")
    assert np.allclose(hertz(frequencies(model, 6)), expected, rtol=1e-6)
    assert [group.name for group in model.groups if group.owner.keyword == "MASS"] == ["CONM2_91"]


def test_an_inertia_that_no_body_has_is_refused(tmp_path):
    more = "GRID,20,,.5,.5,4.\nRBE2,90,20,123456,9,THRU,12\nCONM2,91,20,,1.\n,3.\n"
    with pytest.raises(DeckError, match="no body has") as refused:
        read(written(tmp_path, BRICKS.replace("ENDDATA", more)))
    assert refused.value.diagnostics[0].code == "MD268"


@solver
def test_a_plate_that_nothing_holds_with_a_box_on_a_rigid_element(tmp_path):
    """Rounding of K was once taken for the lowest elastic mode, with a shift so near zero that nothing converged: MD275."""
    grids = [(i, j, 0) for j in range(9) for i in range(13)] + [(i, 4, 1) for i in range(13)]
    number = {each: n for n, each in enumerate(grids, 1)}
    bulk = HEAD.replace("SPC = 2\n", "") + "".join(f"GRID,{number[i, j, k]},,{i / 20},{j / 20},{0.03 * k}\n" for i, j, k in grids)
    quads = [[(i, j, 0), (i + 1, j, 0), (i + 1, j + 1, 0), (i, j + 1, 0)] for i in range(12) for j in range(8)]
    quads += [[(i, 4, 0), (i + 1, 4, 0), (i + 1, 4, 1), (i, 4, 1)] for i in range(12)]
    bulk += "".join(f"CQUAD4,{e},1,{','.join(str(number[at]) for at in each)}\n" for e, each in enumerate(quads, 1))
    bulk += "PSHELL,1,1,.003,1,,1\nMAT1,1,7.+10,,.33,2700.\nGRID,900,,.3,.1,.05\n"
    hub = ",".join(str(number[at]) for at in ((5, 2, 0), (6, 1, 0), (6, 2, 0), (6, 3, 0), (7, 2, 0)))
    found = imported(written(tmp_path, f"{bulk}RBE2,901,900,123456,{hub}\n"), tmp_path / "deck.yaml", None, False, str)
    assert len(found.checked.hz) == 8 and found.checked.frequency < 1e-6
