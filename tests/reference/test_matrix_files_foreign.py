"""Files of other programs, typed from the description of each format: matrices, DOF maps, nodes; and their faults."""

import numpy as np
import pytest
from scipy.io import savemat
from scipy.sparse import csc_array

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.formats.dof_files import read_dofs
from mouse_cli.formats.matrix_files import read_contents, read_matrix, read_table
from mouse_cli.formats.node_files import read_nodes

K = np.array([[2.5e5, -1.5e5, 0], [-1.5e5, 2.65e5, -1.15e5], [0, -1.15e5, 1.15e5]])

ABAQUS = """\
** Assembled nodes
3,1, 3,1,  2.500000000000000e+05
12,2, 3,1, -1.500000000000000e+05
12,2, 12,2,  2.650000000000000e+05
40,6, 12,2, -1.150000000000000e+05
40,6, 40,6,  1.150000000000000e+05
"""
COORDINATE = "1 1 2.5e+05\n1 2 -1.5e+05\n2 2  2.65e+05\n1 3 0.\n2 3 -1.15D+05\n3 3  1.15D+05\n"
DMIG = """\
$ small field, then large field with continuations, then free field; as punched by EXTSEOUT and as typed by hand
GRID    3               0.      1.5     -2.-1
DMIG    K2GG    0       6       2       0                       3
DMIG    K2GG    3       1               3       1       2.5+5
+       12      2       -1.5+5
DMIG*   K2GG                          12               2
*                     12               2 2.650000000D+05
*                     40               0-1.150000000D+05
DMIG,K2GG,40,0,,40,0,1.15E5
DMIG,MASS,0,1,2,0
DMIG,MASS,3,1,,3,1,2.0
"""
HEADER = "{:<72}{:<8}\n{:14d}{:14d}{:14d}{:14d}{:14d}\n{:<14}{:14d}{:14d}{:14d}{:14d}\n{:<16}{:<16}{:<20}{:<20}\n"
HB = (
    HEADER.format("stiffness", "KEY", 4, 1, 1, 2, 0, "RSA", 3, 3, 5, 0, "(4I4)", "(5I3)", "(1P,3D16.8)", "")
    + "   1   3   5   6\n"
    + "  1  2  2  3  3\n"
    + "  2.50000000D+05 -1.50000000D+05  2.65000000D+05\n"
    + " -1.15000000D+05  1.15000000D+05\n"
)
OP4 = """\
       3       3       6       2K       1P,3E23.16
       1       1       2
 2.5000000000000000E+05-1.5000000000000000E+05
       2       1       3
-1.5000000000000000E+05 2.6500000000000000E+05-1.1500000000000000E+05
       3       2       2
-1.1500000000000000E+05 1.1500000000000000E+05
       4       1       1
 1.0000000000000000E+00
       3      -3       6       2M       1P,3E23.16
       2       0       4
       3       2
 4.0000000000000000E+00
       4       1       1
 1.0000000000000000E+00
"""
FILES = {
    "k.mtx": ABAQUS,
    "k.sti": COORDINATE,
    "c.mtx": COORDINATE,
    "k.matrix": HB,
    "k.rsa": HB,
    "k.op4": OP4,
    "k.pch": DMIG,
}


def kept(folder, name: str, text: str | None = None) -> str:
    (folder / name).write_text(FILES[name] if text is None else text)
    return str(folder / name)


@pytest.mark.parametrize("name", FILES)
def test_each_format_gives_the_matrix(name, tmp_path):
    variable = {"k.op4": "k", "k.pch": "K2GG"}.get(name)
    np.testing.assert_array_equal(read_matrix(kept(tmp_path, name), variable=variable), K)


def test_files_name_their_degrees_of_freedom(tmp_path):
    assert read_contents(kept(tmp_path, "k.mtx")).dofs.labels() == ("3TX", "12TY", "40RZ")
    assert read_contents(kept(tmp_path, "k.pch"), variable="K2GG").dofs.labels() == ("3TX", "12TY", "40S")


def test_bigmat_columns_of_output4(tmp_path):
    np.testing.assert_array_equal(read_matrix(kept(tmp_path, "k.op4"), variable="M"), np.diag([0, 4.0, 0]))


def test_the_other_triangle_and_both_give_the_same(tmp_path):
    lines = [line.split() for line in COORDINATE.replace("D", "e").splitlines()]
    lower = "".join(f"{j} {i} {v}\n" for i, j, v in lines)
    both = lower + "".join(f"{i} {j} {v}\n" for i, j, v in lines if i != j)
    for name, text in (("lower.mas", lower), ("both.sti", both)):
        np.testing.assert_array_equal(read_matrix(kept(tmp_path, name, text)), K)


def test_abaqus_degrees_of_freedom_held_by_a_penalty_are_left_out(tmp_path):
    found = read_contents(kept(tmp_path, "k.mtx", ABAQUS + "7,1, 7,1, 1.000000000000000e+36\n"))
    np.testing.assert_array_equal(found.matrix, K)
    assert found.removed == {"7TX"}


def test_matlab_structs_and_tables(tmp_path):
    path = str(tmp_path / "model.mat")
    savemat(
        path, {"K": K, "M": csc_array(np.diag([1.0, 2, 3])), "beam": {"K": 2 * K}, "phi": K[:, :2], "name": "plate"}
    )
    np.testing.assert_array_equal(read_matrix(path, variable="beam.K"), 2 * K)
    np.testing.assert_array_equal(read_matrix(path, variable="M"), np.diag([1.0, 2, 3]))
    np.testing.assert_array_equal(read_table(path, "phi"), K[:, :2])


def test_maps_of_degrees_of_freedom(tmp_path):
    calculix = read_dofs(kept(tmp_path, "job.dof", "3.1\n12.2\n40.6\n"))
    table = read_dofs(kept(tmp_path, "map.csv", "node,direction\n3,TX\n12,2\n40,RZ\n"))
    ansys = "    Matrix Eqn        Node       DOF\n         2        12       UY\n         1  3  UX\n 3 40 ROTZ\n"
    mapping = read_dofs(kept(tmp_path, "k.mapping", ansys))
    assert calculix.labels() == table.labels() == mapping.labels() == ("3TX", "12TY", "40RZ")


UNIVERSAL = """\
    -1
   164
         1  SI: Meter (newton)         2
    -1
    -1
    15
         3         0         0        11 -1.00000E+00  1.50000E+00 -1.00000E+00
    -1
    -1
  2411
        12         1         1        11
   2.5000000000000000D-01   0.0000000000000000D+00  -1.0000000000000000D+00
    -1
"""
NODES = {
    "n.unv": UNIVERSAL,
    "padded.unv": "\n".join(f"{line:<80}" for line in UNIVERSAL.splitlines()) + "\n",
    "n.inp": "*HEADING\nplate\n** a remark\n*NODE, NSET=ALL\n3, -1., 1.5, -1.\n12, .25, 0, -1.,\n*ELEMENT, TYPE=S4\n1,2,3,4,5\n",
    "n.csv": "node;x;y;z\n3;-1;1.5;-1\n12;0.25;0;-1\n",
    "n.bdf": "GRID    3               -1.     1.5     -1.+0\n"
    + f"GRID*   {12:16}{'':16}{'.25':>16}{0:16}\n*       {'-1.':>16}\nCBAR,1,1,3,12\n",
}  # fmt: skip


@pytest.mark.parametrize("name", NODES)
def test_nodes(name, tmp_path):
    ids, coordinates = read_nodes(kept(tmp_path, name, NODES[name]))
    assert ids.tolist() == [3, 12]
    np.testing.assert_array_equal(coordinates, [[-1, 1.5, -1], [0.25, 0, -1]])


# name, contents, variable, code, line, a word of message or help
FAULTS = [
    ("k.sti", "1 1 1\n1 2\n", None, "MD252", 2, "row, column, value"),
    ("k.sti", "1 1 1\n2 2 x\n", None, "MD252", 2, "row, column, value"),
    ("k.sti", "1 1 1\n0 2 1\n", None, "MD252", 2, "from 1"),
    ("k.sti", "1 1 1\n9000000 9000000 1\n", None, "MD258", 1, "9000000"),
    ("k.sti", "1 1 1\n1 1 2\n", None, "MD252", 2, "given twice"),
    ("k.sti", "1 1 1\n1 2 1\n2 1 1\n1 3 2\n", None, "MD255", 4, "mirror image"),
    ("k.sti", "\n", None, "MD252", 1, "no numbers"),
    ("k.sti", "<!DOCTYPE html>\n<html>", None, "MD252", 1, "HTML"),
    ("k.mtx", "PK\x03\x04abc", None, "MD252", 1, "zip"),
    ("k.mat", "\x1f\x8babc", None, "MD252", 1, "gzip"),
    ("k.mtx", "version https://git-lfs.github.com/spec/v1\n", None, "MD252", 1, "git lfs pull"),
    ("k.mtx", "1,1, 1,1, 5.\n-1,1, 1,1, 5.\n", None, "MD252", 2, "Lagrange"),
    ("k.mtx", "1,1, 1,1, 5.\n1,11, 1,11, 5.\n", None, "MD252", 2, "directions are 1 to 6"),
    ("k.sti", "1 1 1\n2 2 nan\n", None, "MD256", 1, "(2,2)"),
    ("k.pch", DMIG, None, "MD259", 1, "K2GG, MASS"),
    ("k.pch", DMIG, "KAAX", "MD260", 1, "K2GG, MASS"),
    ("k.pch", DMIG.replace("2.5+5", "2.5+x"), "K2GG", "MD252", 4, "'2.5+X'"),
    ("k.pch", DMIG.replace("0       6       2 ", "0       6       4 "), "K2GG", "MD253", 3, "complex"),
    ("k.pch", DMIG.replace("0       6       2 ", "0       9       2 "), "K2GG", "MD254", 3, "form 9"),
    ("k.pch", DMIG.replace("40,0,1.15E5", "40,8,1.15E5"), "K2GG", "MD252", 9, "component 8"),
    ("k.pch", DMIG + "DMIG,K2GG,3,1,,3,1,1.,,12,2,5.\n", "K2GG", "MD252", 12, "eight fields"),
    ("k.op4", OP4[: OP4.index("       3       2")], "K", "MD252", 5, "ends within"),
    ("k.op4", OP4.replace("2K ", "4K "), "K", "MD253", 1, "complex"),
    ("k.op4", OP4.replace("       4       1       1\n", "       4       1       x\n", 1), "K", "MD252", 8, "whole numbers"),
    ("k.op4", OP4.replace("       3       2       2\n", "       3       3       2\n", 1), "K", "MD252", 1, "outside"),
    ("k.op4", "nothing", None, "MD252", 1, "2 whole numbers of 8 characters"),
    ("k.op4", "\0\0\0\x08nothing", None, "MD252", 1, "record"),
    ("k.mtx", "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", None, "MD252", 1, "a picture"),
    ("k.pch", "$ no matrix\n", None, "MD259", 1, "no matrix"),
    ("k.hb", HB.replace("RSA", "CSA"), None, "MD253", 3, "complex"),
    ("k.hb", HB.replace("RSA", "RZA"), None, "MD255", 3, "skew"),
    ("k.hb", HB.replace("(5I3)", "(5X3)"), None, "MD252", 4, "format"),
    ("k.hb", HB.replace("  1  2  2  3  3", "  1  2  2  3  7"), None, "MD252", 1, "outside 1 to 3"),
    ("k.hb", HB.replace("-1.50000000D+05", "-1.5000x000D+05"), None, "MD252", 7, "16 characters"),
    ("k.hb", "\n".join(HB.splitlines()[:6]), None, "MD252", 6, "sooner"),
    ("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 1\n", "K", "MD260", 1, "one matrix"),
    ("k.h5", "no HDF5", None, "MD252", 1, "not an HDF5 file"),
    ("k.mat", "no MATLAB file, but a text long enough to hold a header of 128 bytes" * 3, None, "MD252", 1, "MATLAB"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "text", "variable", "code", "line", "word"), FAULTS, ids=range(len(FAULTS)))
def test_each_fault_is_named(name, text, variable, code, line, word, tmp_path):
    path = tmp_path / name
    path.write_bytes(text.encode("latin-1"))
    with pytest.raises(DeckError) as caught:
        read_matrix(str(path), variable=variable)
    (found,) = caught.value.diagnostics
    assert (found.code, found.span.file, found.span.line) == (code, str(path), line), found
    assert word in f"{found.message} {found.help}" and found.help


FAULTS_BESIDE = [
    (read_dofs, "a.dof", "1.1\n1.x\n", 2, "'x'"),
    (read_dofs, "a.dof", "1.1\n2.1\n1.1\n", 3, "line 1"),
    (read_dofs, "a.dof", "", 1, "empty"),
    (read_dofs, "a.dof", "\n", 1, "no degree of freedom"),
    (read_dofs, "a.csv", "node,direction\n1,TX,3\n", 2, "node number"),
    (read_dofs, "a.mapping", "head\n1 4 UX\n3 4 UY\n", 1, "equations 1 to 3"),
    (read_dofs, "a.mapping", "head\n1 4 TEMP\n", 2, "TEMP"),
    (read_nodes, "a.csv", "1,0,0,0\n1,0,0,1\n", 2, "before"),
    (read_nodes, "a.csv", "1,0,0\n", 1, "three coordinates"),
    (read_nodes, "a.unv", "    -1\n  2411\n 1 1 1 11\n", 1, "does not end"),
    (read_nodes, "a.unv", "    -1\n  2411\n 1 1 1 11\n    -1\n", 3, "without coordinates"),
    (read_nodes, "a.unv", "nothing", 1, "no node"),
    (read_nodes, "a.inp", "*NODE, SYSTEM=C\n1,1,0,0\n", 1, "another system"),
    (read_nodes, "a.bdf", "GRID,1,7,0.,0.,0.\n", 1, "local system"),
]


@pytest.mark.parametrize(("read", "name", "text", "line", "word"), FAULTS_BESIDE, ids=range(len(FAULTS_BESIDE)))
def test_faults_of_maps_and_nodes(read, name, text, line, word, tmp_path):
    with pytest.raises(DeckError) as caught:
        read(kept(tmp_path, name, text))
    (found,) = caught.value.diagnostics
    assert (found.code, found.span.line) == ("MD252", line) and word in found.message


DECK = """\
mouse: 1
title: imported
model:
  stiffness: {file: k.mtx}
  mass: {file: m.pch, variable: M}
  nodes: {file: n.csv}
parameters:
  - {name: spring, sd: 1, stiffness: {file: g.mtx}}
test:
  modes: {frequency: [50], frequency_sd: 1 %, dofs: [12TY, 3TX], shapes: [[1], [0.5]], shape_sd: 2 %}
"""
MASS = "DMIG,M,0,6,2,0\nDMIG,M,40,6,,40,6,3.\nDMIG,M,12,2,,12,2,2.,\n,3,1,0.5\nDMIG,M,3,1,,3,1,1.\n"
PLACES = "3,0,0,0\n12,1,0,0\n40,2,0,0\n"


def deck(folder, text: str = DECK, mass: str = MASS, group: str = "40,6, 40,6, 7.\n12,2, 40,6, -7.\n12,2, 12,2, 7.\n"):
    for name, content in (("m.pch", mass), ("g.mtx", group), ("n.csv", PLACES), ("map.csv", "40,RZ\n12,TY\n3,TX\n")):
        kept(folder, name, content)
    kept(folder, "k.mtx")
    return read_deck(kept(folder, "deck.yaml", text))


def test_labels_bring_matrices_of_any_order_together(tmp_path):
    problem = deck(tmp_path)
    assert problem.structure.labels == ("3TX", "12TY", "40RZ")
    np.testing.assert_array_equal(problem.structure.M, [[1, 0.5, 0], [0.5, 2, 0], [0, 0, 3]])
    np.testing.assert_array_equal(problem.structure.geometry.coordinates[:, 0], [0, 1, 2])
    assert problem.test.dofs.tolist() == [1, 0]
    rows, cols = problem.elements.row.tolist(), problem.elements.col.tolist()
    assert (rows, cols) == ([1, 1, 2], [1, 2, 2])
    np.testing.assert_array_equal(np.ravel(problem.A), [7, -7, 7])


def test_a_map_decides_the_order(tmp_path):
    problem = deck(tmp_path, DECK.replace("  nodes:", "  dofs: {file: map.csv}\n  nodes:"))
    assert problem.structure.labels == ("40RZ", "12TY", "3TX")
    np.testing.assert_array_equal(problem.structure.K, K[::-1, ::-1])


def test_a_mass_may_be_zero_where_a_stiffness_is(tmp_path):
    problem = deck(tmp_path, mass="DMIG,M,0,6,2,0\nDMIG,M,12,2,,12,2,2.\nDMIG,M,3,1,,3,1,1.\n")
    assert problem.structure.M.diagonal().tolist() == [1, 2, 0]


@pytest.mark.parametrize(
    ("changes", "code", "word"),
    [
        ({"mass": MASS.replace("40,6,3.", "40,6,-3.")}, "MD304", "40RZ is -3"),
        ({"mass": MASS.replace("40,6,,40,6,3.", "40,6,,12,2,0.1")}, "MD263", "40RZ has no mass of its own"),
        ({"mass": MASS.replace("M,3,1,,3,1", "M,3,4,,3,4")}, "MD262", "3RX, which the model has not"),
        ({"text": DECK.replace("k.mtx", "m.pch, variable: N")}, "MD260", "holds no 'N'"),
        ({"text": DECK.replace("{file: k.mtx}", "{diagonal: [1, 2, 3]}")}, "MD262", "nothing names"),
        (
            {"text": DECK.replace("  nodes", "  labels: [a, b, c]\n  dofs: {file: map.csv}\n  nodes")},
            "MD262",
            "both name",
        ),
        ({"text": DECK.replace("{file: k.mtx}", "{variable: K}")}, "MD211", "file is missing"),
        ({"group": "1,1, 1,1, 7.\n"}, "MD262", "1TX"),
    ],
    ids=range(8),
)
def test_what_does_not_fit_is_refused(changes, code, word, tmp_path):
    with pytest.raises(DeckError) as caught:
        deck(tmp_path, **changes)
    assert any(d.code == code and word in d.message for d in caught.value.diagnostics), caught.value.diagnostics


def test_a_degree_of_freedom_with_nothing_is_named(tmp_path):
    text = DECK.replace("  nodes:", "  dofs: {file: more.csv}\n  nodes:")
    kept(tmp_path, "more.csv", "40,RZ\n12,TY\n3,TX\n3,RX\n")
    with pytest.raises(DeckError, match=r"MD263.*3RX has neither stiffness nor mass"):
        deck(tmp_path, text)


def test_nodes_without_coordinates_are_told(tmp_path):
    text = DECK.replace("n.csv", "few.csv")
    kept(tmp_path, "few.csv", "3,0,0,0\n12,1,0,0\n")
    (warning,) = deck(tmp_path, text).warnings
    assert warning.code == "MD264" and "node 40" in warning.message


def test_an_imported_model_survives_being_written(tmp_path):
    """Places, labels and the zero mass, which no inline matrix may hold."""
    problem = deck(tmp_path, mass="DMIG,M,0,6,2,0\nDMIG,M,12,2,,12,2,2.\nDMIG,M,3,1,,3,1,1.\n")
    write_deck(problem, tmp_path / "again.yaml")
    again = read_deck(tmp_path / "again.yaml")
    for name in ("K", "M"):
        np.testing.assert_array_equal(getattr(again.structure, name), getattr(problem.structure, name))
    assert again.structure.labels == problem.structure.labels
    for name in ("node_ids", "coordinates", "node", "direction"):
        np.testing.assert_array_equal(
            getattr(again.structure.geometry, name), getattr(problem.structure.geometry, name)
        )
