"""What mouse export writes, given back to CalculiX: the revised job has the frequencies that the revised deck has.

Truth: ccx itself, of the job with another Young's modulus, and with a spring and a mass added by hand.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.cli.main import main

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
X, Y = np.linspace(0, 0.6, 4), (0.0, 0.2)
STEEL = "*MATERIAL,NAME=STEEL\n*ELASTIC\n2.1E11,0.3\n*DENSITY\n7850\n"
MATERIALS = f"{STEEL}*MATERIAL,NAME=ALU\n*ELASTIC\n7.0E10,0.33\n*DENSITY\n2700\n"


def job(materials: str = MATERIALS, more: str = "") -> str:
    """A strip of three bricks, two of steel and one of aluminium, clamped at one end."""
    points = [(x, y, z) for z in (0.0, 0.02) for y in Y for x in X]
    nodes = "".join(f"{i},{x:g},{y:g},{z:g}\n" for i, (x, y, z) in enumerate(points, 1))
    bricks = [f"{e},{e},{e + 1},{e + 5},{e + 4},{e + 8},{e + 9},{e + 13},{e + 12}\n" for e in (1, 2, 3)]
    return (
        f"*NODE,NSET=NALL\n{nodes}*NSET,NSET=ROOT\n1,5,9,13\n*ELEMENT,TYPE=C3D8I,ELSET=A\n{bricks[0]}{bricks[1]}"
        f"*ELEMENT,TYPE=C3D8I,ELSET=B\n{bricks[2]}{materials}*SOLID SECTION,ELSET=A,MATERIAL=STEEL\n"
        f"*SOLID SECTION,ELSET=B,MATERIAL=ALU\n{more}*BOUNDARY\nROOT,1,3\n*STEP\n*FREQUENCY\n6\n*END STEP\n"
    )


def frequencies(folder: Path, text: str) -> np.ndarray:
    """The six lowest that ccx finds, Hz."""
    folder.mkdir(exist_ok=True)
    (folder / "job.inp").write_text(text)
    subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, timeout=60, check=True)
    rows = [line.split() for line in (folder / "job.dat").read_text().splitlines()]
    return np.array([float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()][:6])


def mouse(*words: str) -> int:
    with pytest.raises(SystemExit) as left:
        main([*words])
    return left.value.code


@pytest.fixture
def imported(tmp_path, monkeypatch):
    """The folder with the deck of the job."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "strip.inp").write_text(job())
    assert mouse("import", "strip.inp", "-q") == 0
    return tmp_path


def revised(folder: Path, hz: np.ndarray, more: str = "") -> dict:
    """`mouse run` of the deck with that test."""
    deck = (folder / "strip.yaml").read_text().split("# The test goes here")[0]
    if more:
        deck = deck.replace("\nparameters:\n", f"\nparameters:\n{more}")
    test = f"test:\n  modes: {{frequency: [{', '.join(f'{f:.8g}' for f in hz)}], frequency_sd: 0.05 %}}\n"
    (folder / "tested.yaml").write_text(deck + test)
    assert mouse("run", "tested.yaml", "--json", "-q", "-o", "result.json") == 0
    return json.loads((folder / "result.json").read_text())


@needs_ccx
def test_calculix_predicts_held_out_modes_with_the_include_file(imported):
    true = frequencies(imported / "true", job(MATERIALS.replace("2.1E11", "1.8E11")))
    before = frequencies(imported / "before", job())
    found = revised(imported, true[:4])
    words = [
        "export",
        "tested.yaml",
        "--for",
        "calculix",
        "--result",
        "result.json",
        "--job",
        "strip.inp",
        "-o",
        "revised.inc",
    ]
    assert mouse(*words) == 0
    text = (imported / "revised.inc").read_text()
    assert re.search(r"\*\* STEEL: E of STEEL: posterior 1\.\d+e\+11 Pa, sd \S+; before the test 2\.1e\+11", text)
    (imported / "after").mkdir()
    shutil.copy(imported / "revised.inc", imported / "after")
    after = frequencies(imported / "after", job("*INCLUDE,INPUT=revised.inc\n"))
    np.testing.assert_allclose(after[:4], [mode["revised_hz"] for mode in found["modes"]], rtol=1e-5)
    error = lambda hz: np.abs(hz[4:] / true[4:] - 1)
    assert (error(after) < 0.1 * error(before)).all()


@needs_ccx
def test_a_spring_that_was_added_stands_in_the_job_as_a_spring(imported):
    spring = "*ELEMENT,TYPE=SPRING1,ELSET=K\n90,16\n*SPRING,ELSET=K\n3\n2.0E5\n"
    true = frequencies(imported / "true", job(more=spring))
    row = (imported / "strip_model" / "dofs.csv").read_text().splitlines().index("16,TZ")
    entry = f"  - {{name: foot, nominal: 0, sd: 3.0e5, unit: N/m, stiffness: [[{row}, {row}, 1]]}}\n"
    found = revised(imported, true, entry)
    words = [
        "export",
        "tested.yaml",
        "--for",
        "calculix",
        "--result",
        "result.json",
        "--job",
        "strip.inp",
        "-o",
        "revised.inc",
    ]
    assert mouse(*words) == 0
    (imported / "after").mkdir()
    shutil.copy(imported / "revised.inc", imported / "after")
    assert (
        "*ELEMENT,TYPE=SPRING1,ELSET=FOOT\n900001,16\n*SPRING,ELSET=FOOT\n3\n" in (imported / "revised.inc").read_text()
    )
    after = frequencies(imported / "after", job("*INCLUDE,INPUT=revised.inc\n"))
    np.testing.assert_allclose(after, true, rtol=1e-3)
    np.testing.assert_allclose(after, [mode["revised_hz"] for mode in found["modes"]], rtol=1e-5)


SPRINGS = (
    "*NODE\n30,0.7,0.1,0.3\n*NSET,NSET=WALL\n30\n*ELEMENT,TYPE=SPRING1,ELSET=PROP\n90,16\n*SPRING,ELSET=PROP\n3\n{}\n"
    "*ELEMENT,TYPE=SPRINGA,ELSET=STAY\n91,12,30\n*SPRING,ELSET=STAY\n\n{}\n*BOUNDARY\nWALL,1,3\n"
)


@needs_ccx
def test_springs_of_the_job_go_back_with_their_revised_stiffness(tmp_path, monkeypatch):
    """Softer prop, stiffer stay, by 20 and 30 per cent; they were once written as the square of their stiffness."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "strip.inp").write_text(job(more=SPRINGS.format("2.0E6", "3.0E6")))
    assert mouse("import", "strip.inp", "-q") == 0
    true = frequencies(tmp_path / "true", job(more=SPRINGS.format("1.6E6", "3.9E6")))
    found = revised(tmp_path, true[:5])
    words = ["--result", "result.json", "--for", "calculix", "--job", "strip.inp", "--complete", "-o", "revised.inp"]
    assert mouse("export", "tested.yaml", *words) == 0
    after = frequencies(tmp_path / "after", (tmp_path / "revised.inp").read_text())
    np.testing.assert_allclose(after[:5], [mode["revised_hz"] for mode in found["modes"]], rtol=1e-5)
    np.testing.assert_allclose(after, true, rtol=2e-3)


PARTS = {  # mechanism, its site, and how much of it
    "set missing": ("member", "element set B", 1 - 1e-6),
    "set thinner": ("member", "element set A", 0.4),
    "set softer": ("stiffness-loss", "element set B", 0.3),
    "set stiffer": ("stiffness-gain", "element set A", 0.8),
    "set heavier": ("added-mass", "element set B", 0.5),
    "set lighter": ("lighter", "element set B", 0.3),
    "foot loose": ("support-translation", "the support ROOT, all directions", 3e7),
    "foot loose along an axis": ("support-translation", "the support ROOT, TY", 1e6),
    "foot on rubber": ("support-translation", "the support ROOT, along TX and across it", (3e7, 5e6)),
    "foot slides": ("support-translation", "the support ROOT, across TX", 5e6),
    "stiff foot on rubber": ("support-translation", "the support ROOT, along TX and across it", (3e7, 5e6)),
    "foot turns": ("support-rotation", "the support ROOT, RY", 2e4),
    "mass": ("mass", "node 16", 2.0),
}


def extended(folder: Path, what: str) -> None:
    """The deck with a mechanism in it, as `mouse diagnose -o` writes it, at the values of its prior."""
    from mouse_cli import read_deck, write_deck
    from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
    from mouse_cli.diagnosis.mechanisms import registry

    key, site, value = PARTS[what]
    hz = "100, 200, 300, 400, 500, 600"
    rows = "".join(f"      - [{', '.join(['1'] * 6)}]\n" for _ in range(6))
    test = (
        f"test:\n  modes:\n    frequency: [{hz}]\n    frequency_sd: 1 %\n    dofs: [8TY, 8TZ, 16TX, 16TY, 16TZ, 4TZ]\n"
    )
    deck = (folder / "strip.yaml").read_text().split("# The test goes here")[0]
    (folder / "tested.yaml").write_text(deck + test + f"    shapes:\n{rows}    shape_sd: 2 %\n")
    problem = read_deck(folder / "tested.yaml")
    model = reduced(problem, problem.prior.mean)
    found = [(each.site(np.atleast_1d(value)).text, each) for each in model.recipes(registry()[key])]
    assert site in dict(found), [text for text, _ in found]
    recipe = dict(found)[site]
    write_deck(recipe.extend(problem, np.atleast_1d(value)), folder / "extended.yaml")


@needs_ccx
@pytest.mark.parametrize("what", PARTS)
def test_calculix_runs_the_complete_job_with_what_a_diagnosis_added(imported, what, monkeypatch):
    from mouse_cli.diagnosis.effects import support_motions
    from mouse_cli.formats import read_deck
    from mouse_cli.updating import forecast

    if what.startswith("stiff"):
        monkeypatch.setattr(support_motions, "_FLEXIBLE", 0)  # a foot of many nodes moves as a rigid body
    extended(imported, what)
    words = ["export", "extended.yaml", "--for", "calculix", "--job", "strip.inp", "--complete", "-o", "revised.inp"]
    assert mouse(*words) == 0
    found = frequencies(imported / "after", (imported / "revised.inp").read_text())
    before = frequencies(imported / "before", job())
    assert np.abs(found / before - 1).max() > 0.01
    if what == "set missing":
        text = re.sub(r"\*ELEMENT,TYPE=C3D8I,ELSET=B\n.*\n|\*SOLID SECTION,ELSET=B.*\n", "", job())
        expected = frequencies(imported / "true", text)
    else:
        expected = forecast(read_deck("extended.yaml"), 6).frequencies_hz
    np.testing.assert_allclose(found, expected, rtol=1e-5)


@needs_ccx
def test_a_complete_job_of_another_deck_is_refused(imported, capsys):
    (imported / "strip.yaml").write_text((imported / "strip.yaml").read_text().replace("    B: {", "    OTHER: {"))
    words = ["export", "strip.yaml", "--for", "calculix", "--job", "strip.inp", "--complete", "-o", "revised.inp"]
    assert mouse(*words) == 4 and "error[MD483]" in capsys.readouterr().err
    assert not (imported / "revised.inp").exists()
    assert mouse(*words[:4], "--complete") == 2


BEAM = """mouse: 1
title: Cantilever
units: SI
model:
  structure:
    nodes: {line: {from: 1, to: 5, start: [0, 0, 0], end: [2, 0, 0]}}
    materials: {steel: {E: 2.0e+11, nu: 0.25, density: 8000}}
    sections: {bar: {rectangle: [0.02, 0.05]}}
    elements:
      - {id: 1-4, type: beam, nodes: 1-5, material: steel, section: bar}
      - {id: 7, type: spring, nodes: [5], stiffness: {TZ: 1.5e+4}}
      - {id: 8, type: mass, nodes: [3], mass: 0.75}
    supports: {1: all}
parameters:
  - {name: E, elements: 3-4, property: E, sd: 5 %}
  - {name: k, elements: 7, property: TZ, sd: 10 %}
"""
CARDS = {
    "abaqus": ("*ELSET,ELSET=OF_STEEL_2\n", "*SPRING,ELSET=SPRING_7_TZ\n3\n15000.\n", "*MASS,ELSET=MASS_8\n0.75\n"),
    "calculix": ("*ELASTIC\n2.E+11,0.25\n*DENSITY\n8000.\n", "*ELEMENT,TYPE=SPRING1,ELSET=SPRING_7_TZ\n900001,5\n"),
    "ansys": ("MP,EX,1,2.E+11\n", "KEYOPT,900,2,3\nR,900,15000.\n", "R,901,0.75,0.75,0.75,0.,0.,0.\n"),
    "nastran": (
        "MAT1*                  1 2.000000000E+11                 2.500000000E-01\n*        8.000000000E+03\n",
        "CELAS2*           900001 1.500000000E+04               5               3\n*\n",
        "CONM2*            900002               3               0 7.500000000E-01\n*\n",
    ),
}


@pytest.mark.parametrize("program", CARDS)
def test_the_cards_of_a_structure(program, tmp_path):
    deck = BEAM.replace("elements: 3-4, property: E", "material: steel, property: E") if program != "abaqus" else BEAM
    deck = deck.replace(
        "{name: E, elements: 3-4, property: E, sd: 5 %}",
        "{name: E, elements: 3-4, property: E, nominal: 1.9e+11, sd: 1.0e+10}",
    )
    (tmp_path / "deck.yaml").write_text(deck)
    out = tmp_path / "cards.txt"
    assert mouse("export", str(tmp_path / "deck.yaml"), "--for", program, "-o", str(out)) == 0
    text = out.read_text()
    for card in CARDS[program]:
        assert card in text, text
    assert "k: prior 15000 N/m, sd 1.5e+03" in text and "posterior" not in text  # nothing was revised


def test_what_stands_in_place_of_a_support_says_so(tmp_path):
    """A spring at what the model goes on to hold does nothing."""
    for name in ("k", "stiffness of the support of node 5, TZ"):
        (tmp_path / "deck.yaml").write_text(BEAM.replace("{name: k,", f"{{name: '{name}',"))
        assert mouse("export", str(tmp_path / "deck.yaml"), "--for", "nastran", "-o", str(tmp_path / "cards.txt")) == 0
        assert ("where the model holds 5TZ" in (tmp_path / "cards.txt").read_text()) == (name != "k")


def test_shapes_for_other_programs(tmp_path):
    """What is written is read back by mouse's reader of data sets 55 and by pyuff; the file for VTK has a vector at each node."""
    (tmp_path / "deck.yaml").write_text(BEAM)
    for name in ("s.unv", "s.vtk"):
        assert mouse("export", str(tmp_path / "deck.yaml"), "--shapes", str(tmp_path / name), "--modes", "3") == 0
    from mouse_cli.formats import read_deck
    from mouse_cli.formats.mode_files import read_modes
    from mouse_cli.updating import forecast

    expected, found = forecast(read_deck(str(tmp_path / "deck.yaml")), 3), read_modes(str(tmp_path / "s.unv"))
    np.testing.assert_allclose(found.frequency_hz, expected.frequencies_hz, rtol=1e-5)
    labels = list(expected.problem.structure.labels)
    for name, row in zip(found.names, found.shapes, strict=True):
        np.testing.assert_allclose(row, expected.shapes[labels.index(name)], rtol=1e-4, atol=1e-6)
    text = (tmp_path / "s.vtk").read_text()
    assert "POINTS 5 double" in text and text.count("VECTORS mode_") == 3
    pyuff = pytest.importorskip("pyuff", reason="needs pyuff")
    assert sorted(pyuff.UFF(str(tmp_path / "s.unv")).get_set_types()) == [15, 55, 55, 55, 82]


def test_what_cannot_be_written_is_refused(tmp_path, capsys, monkeypatch):
    (tmp_path / "deck.yaml").write_text(
        "mouse: 1\nmodel: {stiffness: {order: 1, entries: [[1, 1, 4]]}, mass: {diagonal: [1]}}\n"
        "parameters: [{name: E of STEEL, nominal: 4, unit: Pa, sd: 1, stiffness: [[1, 1, 1]]}]\n"
    )
    monkeypatch.chdir(tmp_path)
    assert mouse("export", "deck.yaml", "--for", "calculix", "-o", "x.inc") == 4 and not (tmp_path / "x.inc").exists()
    assert "error[MD480]" in capsys.readouterr().err
    assert mouse("export", "deck.yaml", "--shapes", "x.vtk") == 4 and "error[MD482]" in capsys.readouterr().err
    text = (tmp_path / "deck.yaml").read_text().replace("E of STEEL", "a").replace("[[1, 1, 1]]", "[[1, 1, 1]]")
    (tmp_path / "deck.yaml").write_text(text)
    assert mouse("export", "deck.yaml", "--for", "ansys") == 4 and "error[MD481]" in capsys.readouterr().err
    assert mouse("export", "deck.yaml") == 2


@needs_ccx
def test_results_of_calculix_are_modes(tmp_path):
    """Frequencies as the table in .dat prints them; shapes of a brick model, which ccx scales to a modal mass of 1."""
    from mouse_cli.formats.mode_files import read_modes

    hz = frequencies(tmp_path, job().replace("*FREQUENCY\n6\n", "*FREQUENCY\n6\n*NODE FILE\nU\n"))
    found = read_modes(str(tmp_path / "job.frd"))
    np.testing.assert_allclose(found.frequency_hz, hz, rtol=1e-6)
    assert len(found.names) == 36 and "1TX" not in found.names and np.isnan(found.damping).all()
    rows = [line for line in (tmp_path / "job.frd").read_text().splitlines() if line.startswith(" -1        16")]
    tip = [float(row[37:49]) for row in rows[-6:]]
    np.testing.assert_allclose(found.shapes[found.names.index("16TZ")], tip)
