"""Input files as users have them: what the solver would pass over without a word, what it stops at, and idioms of Abaqus."""

import shutil

import numpy as np
import pytest
from test_import import BAR, written

from mouse_cli import DeckError
from mouse_cli.importing.calculix import Solver
from mouse_cli.importing.jobs import frequencies
from mouse_cli.importing.material_units import told
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported

solver = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")


def remarks(folder, text: str) -> dict[str, int]:
    """Messages of an import, with their lines."""
    found = imported(written(folder, text), folder / "deck.yaml", "SI", False, str)
    return {each.message: each.span.line for each in found.remarks}


@solver
def test_a_clamp_of_solids_holds_their_translations(tmp_path):
    """ENCASTRE, as Abaqus/CAE writes it: solids have no rotations. Frequencies: CalculiX with 1 to 3 held."""
    model = read(written(tmp_path, BAR.replace("FOOT, 1, 3", "FOOT, ENCASTRE")))
    assert [(each.name, len(each.dofs)) for each in model.supports] == [("FOOT", 12)]
    with Solver("job.inp", None, str) as ccx:
        expected = ccx.eigenvalues(BAR + "*STEP\n*FREQUENCY\n4\n*END STEP\n", "by hand")
        found = ccx.eigenvalues(frequencies(model, 4), "as imported")
    assert np.allclose(found, expected, rtol=1e-9)


def test_rotations_of_shells_are_refused_and_those_of_points_kept(tmp_path):
    point = "*NODE\n20, 0., 0., 5.\n*ELEMENT, TYPE=MASS, ELSET=DOT\n10, 20\n*MASS, ELSET=DOT\n100.\n"
    model = read(written(tmp_path, BAR.replace("*BOUNDARY\n", f"{point}*BOUNDARY\n20, 1, 6\n")))
    assert len(model.supports[0].dofs) == 6


def test_nodes_of_an_element_set_as_a_node_set(tmp_path):
    """*NSET, ELSET=, which CalculiX passes over: the set would be empty, and the support nothing."""
    model = read(written(tmp_path, BAR.replace("*NSET, NSET=FOOT\n1, 2, 3, 4\n", "*NSET, NSET=FOOT, ELSET=LOW\n")))
    assert model.nsets["FOOT"] == list(range(1, 9)) and len(model.supports[0].dofs) == 24
    (card,) = (card for card in model.kept if card.options.get("NSET") == "FOOT" and card.keyword == "NSET")
    assert card.text()[:2] == ["*NSET, NSET=FOOT", "1,"]


def test_a_support_of_an_empty_set_is_refused(tmp_path):
    with pytest.raises(DeckError, match="has no nodes") as refused:
        read(written(tmp_path, BAR.replace("*NSET, NSET=FOOT\n1, 2, 3, 4\n", "*NSET, NSET=FOOT, GENERATE\n50, 60\n")))
    assert (refused.value.diagnostics[0].code, refused.value.diagnostics[0].span.line) == ("MD272", 30)


@solver
def test_what_the_solver_passes_over_is_told(tmp_path):
    """An option that CalculiX does not know, and a mass that nothing holds, each by its line."""
    mass = "*NODE\n20, 0., 0., 5.\n*ELEMENT, TYPE=MASS, ELSET=DOT\n10, 20\n*MASS, ELSET=DOT\n100.\n"
    said = remarks(tmp_path, BAR.replace("*ELASTIC\n", "*ELASTIC, DEPENDENCIES=1\n") + mass)
    assert said["CalculiX passed over DEPENDENCIES=1 of *ELASTIC, which it does not know"] == 23
    assert said["element set DOT gives nothing to K and M of CalculiX: nothing there holds its nodes"] == 35
    assert not any("passed over" in each for each in remarks(tmp_path, BAR))


@solver
def test_what_the_solver_stops_at_is_told_by_its_line_and_in_full(tmp_path):
    coupling = (
        "*SURFACE, NAME=TOP, TYPE=NODE\n9\n*COUPLING, CONSTRAINT NAME=C, REF NODE=20, SURFACE=TOP\n*KINEMATIC\n1, 6\n"
    )
    with pytest.raises(DeckError, match="cannot exceed 3") as refused:
        remarks(tmp_path, BAR + "*NODE\n20, 0., 0., 5.\n" + coupling)
    assert (refused.value.diagnostics[0].code, refused.value.diagnostics[0].span.line) == ("MD274", 36)


PART = """\
*Heading
*Part, name=Brick
*Node
      1,  0., 0., 0.
      2,  1., 0., 0.
      3,  1., 1., 0.
      4,  0., 1., 0.
      5,  0., 0., 1.
      6,  1., 0., 1.
      7,  1., 1., 1.
      8,  0., 1., 1.
*Element, type=C3D8
1, 1, 2, 3, 4, 5,
 6, 7, 8
*Elset, elset=Set-1
 1,
*Nset, nset=Low, generate
 1, 4, 1
** Section: Section-1
*Solid Section, elset=Set-1, material=Steel
,
*End Part
*Assembly, name=Assembly
*Instance, name=A-1, part=Brick
*End Instance
{more}*Nset, nset=Set-1, instance=A-1
 1, 2, 3, 4
*End Assembly
*Material, name=Steel
*Density
7850.,
*Elastic
 2.1e+11, 0.3
*Boundary
Set-1, ENCASTRE
*Step, name=Step-1, nlgeom=NO, perturbation
*Frequency, eigensolver=Lanczos, normalization=displacement
4, , , , ,
*Output, field, variable=PRESELECT
*End Step
"""


@solver
def test_parts_and_instances(tmp_path):
    """Two instances, one moved, then turned by a quarter about z; one alone has the frequencies of a solid that is written flat."""
    second = "*Instance, name=B-1, part=Brick\n 1., 0., 1.\n 0., 0., 0., 0., 0., 1., 90.\n*End Instance\n"
    tie = "*Nset, nset=Other, instance=B-1\n Low,\n"
    model = read(written(tmp_path, PART.format(more=second + tie)))
    at = np.array([model.nodes[n] for n in range(9, 17)])
    assert np.allclose(at[[0, 1, 2, 3]], [[0, 1, 1], [0, 2, 1], [-1, 2, 1], [-1, 1, 1]])
    first, last = model.elements.values()
    assert (first[1], last[1]) == (tuple(range(1, 9)), tuple(range(9, 17))) and model.nsets["OTHER"] == [9, 10, 11, 12]
    assert [group.name for group in model.groups] == ["A-1_SET-1", "B-1_SET-1"]
    assert [(each.name, len(each.dofs)) for each in model.supports] == [("SET-1", 12)]
    (tmp_path / "one").mkdir()
    found = imported(written(tmp_path / "one", PART.format(more="")), tmp_path / "one" / "deck.yaml", "SI", False, str)
    with Solver("job.inp", None, str) as ccx:
        high = BAR[BAR.index("*ELEMENT, TYPE=C3D8, ELSET=HIGH") : BAR.index("*NSET")]
        text = BAR.replace(high, "").replace("*SOLID SECTION, ELSET=HIGH, MATERIAL=STEEL\n", "")
        expected = ccx.eigenvalues(text + "*STEP\n*FREQUENCY\n2\n*END STEP\n", "by hand")
    assert np.allclose(found.checked.hz[:2], np.sqrt(np.sort(expected)) / (2 * np.pi), rtol=1e-6)


@pytest.mark.parametrize(
    ("more", "code", "line"),
    [
        ("*Instance, name=B-1, part=Absent\n*End Instance\n", "MD272", 26),
        ("*Instance, name=B-1, part=Brick\n 1., zero, 1.\n*End Instance\n", "MD265", 27),
        ("*Equation\n2\n1, 1, 1., 2, 1, -1.\n", "MD268", 26),
    ],
)
def test_what_is_not_read_of_an_assembly(tmp_path, more, code, line):
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, PART.format(more=more)))
    assert (refused.value.diagnostics[0].code, refused.value.diagnostics[0].span.line) == (code, line)


def test_an_input_file_of_another_program_is_told_its_way(tmp_path):
    """ANSYS: its matrices are read, not its input."""
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, "/PREP7\nET,1,181\n"))
    assert refused.value.diagnostics[0].code == "MD265" and "HBMAT" in refused.value.diagnostics[0].help


@pytest.mark.parametrize("text", ["SOL 103\nCEND\nBEGIN BULK\n", "$ plate\nGRID,1,,0.,0.,0.\n"])
def test_bulk_data_without_elements(tmp_path, text):
    with pytest.raises(DeckError, match="no elements") as refused:
        read(written(tmp_path, text))
    assert refused.value.diagnostics[0].code == "MD265"


@solver
def test_blanks_in_keywords_and_options_mean_nothing(tmp_path):
    """CalculiX reads *SHELLSECTION, REFNODE= and TYPE=ENGINEERINGCONSTANTS: Poisson's ratios are then no moduli.

    Frequencies: ccx of the job as it is written, which an import compares.
    """
    constants = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n2.1e11, 2.1e11, 2.1e11, .3, .3, .3, 8e10, 8e10,\n8e10\n"
    rigid = "*NODE\n20, .5, .5, 3.\n*NSET, NSET=TOP\n9, 10, 11, 12\n*RIGID BODY, NSET=TOP, REF NODE=20\n"
    text = BAR.replace("*ELASTIC\n2.1e11, 0.3\n", constants) + rigid
    joined = text
    for words in ("SOLID SECTION", "RIGID BODY", "REF NODE", "ENGINEERING CONSTANTS"):
        joined = joined.replace(words, words.title().replace(" ", ""))
    one, other = (imported(written(tmp_path, each), tmp_path / "deck.yaml", "SI", False, str) for each in (text, joined))
    assert other.checked.frequency < 1e-6 and len(one.parts.K) == len(other.parts.K) == 2
    assert all(abs(a - b).max() < 1e-9 * abs(a).max() for a, b in zip(one.parts.K, other.parts.K, strict=True))


@pytest.mark.parametrize(
    ("before", "after", "near"),
    [
        ("*BOUNDARY", "*BOUNDRY", "BOUNDARY"),
        ("ELSET=HIGH, MATERIAL", "ELSET=HIHG, MATERIAL", "HIGH"),
        ("MATERIAL=STEEL", "MATERIAL=STEAL", "STEEL"),
        ("FOOT, 1, 3", "FOTO, 1, 3", "FOOT"),
    ],
)
def test_a_name_that_is_none_is_told_with_the_one_that_is_most_like_it(tmp_path, before, after, near):
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, BAR.replace(before, after)))
    assert f"did you mean {near}?" in refused.value.diagnostics[0].help


def test_what_is_wrong_with_a_material_is_told_once(tmp_path):
    """Two sections name it."""
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, BAR.replace("*DENSITY\n7850.\n", "")))
    assert [each.message for each in refused.value.diagnostics] == ["material STEEL has no *DENSITY"]


@pytest.mark.parametrize(
    ("E", "rho", "system"),
    [
        ("2.1e11", "7850.", "SI"), ("2.1e5", "7.85e-9", "mm-t-N"), ("2.1e8", "7.85", "m-t-kN"), ("3.0e7", "7.3e-4", "in-lbf"),
        ("2.1e8", "7.85e-6", "mm-kg-mN"), ("4.4e9", "15.2", "ft-lbf"), ("9e7", "80.", "SI"), ("90.", "8e-11", "mm-t-N"),
        ("2.1e11", "7.85e-9", ""), ("210.", "7850.", ""),
    ],
)  # fmt: skip
def test_units_of_a_job_by_its_materials(tmp_path, E, rho, system):
    """Steel and foam of handbooks; steel with a modulus in one system and a density in another is told, by its line."""
    model = read(written(tmp_path, BAR.replace("2.1e11, 0.3", f"{E}, 0.3").replace("7850.", rho)))
    named, remarks = told(model, None)
    assert named == system and (len(remarks) == 1) == bool(system)
    if not system:
        assert remarks[1].span.line == 22 and "of STEEL" in remarks[1].message and "2.1e5" in remarks[1].help


def test_one_material_in_other_units_than_the_rest_is_told(tmp_path):
    """GPa among Pa: the job is in SI by the other material."""
    other = "*MATERIAL, NAME=ALU\n*ELASTIC\n70., 0.33\n*DENSITY\n2700.\n"
    other += "*MATERIAL, NAME=TITAN\n*ELASTIC\n1.1e11, .3\n*DENSITY\n4500.\n"
    more = "*ELEMENT, TYPE=C3D8, ELSET=TOP\n3, 5, 6, 7, 8, 9, 10, 11, 12\n*SOLID SECTION, ELSET=TOP, MATERIAL=TITAN\n"
    model = read(written(tmp_path, BAR.replace("ELSET=HIGH, MATERIAL=STEEL", "ELSET=HIGH, MATERIAL=ALU") + other + more))
    named, remarks = told(model, None)
    assert named == "SI" and ["of ALU" in each.message for each in remarks] == [False, True]
