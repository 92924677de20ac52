"""mouse import: supports, sets and materials of an input file, checked against CalculiX itself; what is refused, and where."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mouse_cli import DeckError, modes, read_deck, write_deck
from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.formats.matrix_files import read_matrix
from mouse_cli.importing.jobs import colours
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported as imports
from mouse_cli.terms.assembly import assembly
from mouse_cli.updating import forecast

TOP = Path(__file__).resolve().parents[2]
PLATE = TOP / "decks" / "plate_calculix" / "plate.inp"
solver = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")

BAR = """\
*HEADING
two solids in a row
*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
9, 0., 0., 2.
10, 1., 0., 2.
11, 1., 1., 2.
12, 0., 1., 2.
*ELEMENT, TYPE=C3D8, ELSET=LOW
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=HIGH
2, 5, 6, 7, 8, 9, 10, 11, 12
*NSET, NSET=FOOT
1, 2, 3, 4
*MATERIAL, NAME=STEEL
*ELASTIC
2.1e11, 0.3
*DENSITY
7850.
*SOLID SECTION, ELSET=LOW, MATERIAL=STEEL
*SOLID SECTION, ELSET=HIGH, MATERIAL=STEEL
*BOUNDARY
FOOT, 1, 3
"""


def written(folder: Path, text: str) -> str:
    """Path of an input file with this text."""
    (folder / "job.inp").write_text(text)
    return str(folder / "job.inp")


def imported(folder: Path, text: str, *options: str) -> tuple[Path, str]:
    """The deck that `mouse import` makes of a text, and what it says."""
    path = written(folder, text)
    command = [
        sys.executable,
        "-m",
        "mouse_cli",
        "import",
        path,
        "-o",
        str(folder / "deck.yaml"),
        "--no-cache",
        *options,
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return folder / "deck.yaml", done.stdout


@solver
def test_the_plate_of_the_decks_by_its_own_matrices(tmp_path):
    """The group matrices of decks/plate_calculix, which halved moduli told by hand, and the frequencies that CalculiX printed."""
    deck, said = imported(tmp_path, PLATE.read_text())
    problem = read_deck(deck)
    dense = lambda m: m.toarray() if hasattr(m, "toarray") else np.asarray(m)
    K, M = map(dense, assembly(problem).matrices(problem.prior.mean))
    reference = read_deck(TOP / "decks" / "plate_calculix.yaml")
    assert reference.structure.labels == problem.structure.labels
    assert np.allclose(K, dense(reference.structure.K), rtol=0, atol=1e-12 * np.abs(K).max())
    for name in ("alu", "cfrp"):
        expected = dense(read_matrix(str(TOP / "decks" / "plate_calculix" / f"{name}.mtx")))  # for each GPa
        j = [p.name for p in problem.parameters].index(f"E of {name.upper()}")
        own = np.zeros_like(K)
        stiff = ~problem.elements.is_mass
        row, col = problem.elements.row[stiff], problem.elements.col[stiff]
        own[row, col] = own[col, row] = dense(problem.A[:, [j]]).ravel()[stiff]
        assert np.allclose(own * 1e9, expected, rtol=0, atol=1e-10 * np.abs(expected).max())
    hz = np.sqrt(eigensolution(K, M, 6).eigenvalues[:6]) / (2 * np.pi)
    assert np.allclose(hz, [85.30, 469.01, 521.31, 762.12, 1403.39, 1482.79], atol=0.006)
    assert "supports: ROOT" in said


@solver
@pytest.mark.parametrize(
    ("element", "section", "nodes"),
    [
        ("S4", "*SHELL SECTION, ELSET=E, MATERIAL=M\n0.05\n", 4),
        ("B31", "*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n", 2),
    ],
)
def test_what_the_solver_makes_solids_of_keeps_its_supports(tmp_path, element, section, nodes):
    """Shells and beams become solids in CalculiX; its own frequencies come back all the same, which the import checks to 1e-6."""
    if nodes == 4:
        at = [(x, y, 0.1 * x) for x in range(5) for y in range(3)]
        made = [(3 * i + j, 3 * i + j + 3, 3 * i + j + 4, 3 * i + j + 1) for i in range(4) for j in range(2)]
    else:
        at, made = [(0.3 * x, 0.0, 0.0) for x in range(9)], [(i, i + 1) for i in range(8)]
        section += "0.02, 0.03\n0., 1., 0.\n"
    text = "*NODE\n" + "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in enumerate(at, 1))
    text += f"*ELEMENT, TYPE={element}, ELSET=E\n"
    text += "".join(f"{n}, {', '.join(str(i + 1) for i in each)}\n" for n, each in enumerate(made, 1))
    text += "*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n" + section
    text += f"*NSET, NSET=ENDS\n1, 2, {len(at) - 1}, {len(at)}\n*BOUNDARY\nENDS, 1, 3\n"
    deck, said = imported(tmp_path, text)
    assert "supports: ENDS (12)" in said
    assert float(re.search(r"solver's, to (\S+)", said)[1]) < 1e-6
    assert read_deck(deck).held.supports[0].name == "ENDS"


@solver
def test_springs_masses_and_sets_within_sets(tmp_path):
    """Two named halves of one section are two groups; a spring and a mass are groups of their own; one export tells LOW and DOT."""
    more = "*ELEMENT, TYPE=MASS, ELSET=DOT\n10, 9\n*MASS, ELSET=DOT\n100.\n"
    more += "*ELEMENT, TYPE=SPRING1, ELSET=TIE\n11, 10\n*SPRING, ELSET=TIE\n1\n1.0e8\n"
    deck, _ = imported(tmp_path, BAR + more)
    problem = read_deck(deck)
    assert {group.name for group in problem.groups} == {"LOW", "HIGH", "DOT", "TIE"}
    by = {group.name: group for group in problem.groups}
    tie = by["TIE"].K.toarray() if hasattr(by["TIE"].K, "toarray") else by["TIE"].K
    i = problem.held.structure.labels.index("10TX")
    assert tie[i, i] == pytest.approx(1e8, rel=1e-5)  # of a difference of files with 14 digits
    assert by["DOT"].M.sum() == pytest.approx(300.0, rel=1e-6)
    spring = next(p for p in problem.parameters if p.name == "stiffness of TIE")
    assert (spring.nominal, spring.unit, problem.title) == (1e8, "N/m", "two solids in a row")


@solver
def test_two_free_bodies(tmp_path):
    """Twelve motions of rigid bodies come before the modes that are compared with the solver's, and before those of a run."""
    at = [(x, y, z) for x0 in (0, 30) for x in range(x0, x0 + 25) for y in range(7) for z in (0.0, 0.7)]
    number = {x: i for i, x in enumerate(at, 1)}
    text, count = "*NODE\n" + "".join(f"{i}, {x}, {y}, {z}\n" for (x, y, z), i in number.items()), 0
    for name, x0, long in (("A", 0, 24), ("B", 30, 24)):
        text += f"*ELEMENT, TYPE=C3D8, ELSET={name}\n"
        for x, y in ((x, y) for x in range(x0, x0 + long) for y in range(6)):
            square, count = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)], count + 1
            text += f"{count}, {', '.join(str(number[*p, z]) for z in (0.0, 0.7) for p in square)}\n"
    text += "*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n"
    text += "*SOLID SECTION, ELSET=A, MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=M\n"
    deck, said = imported(tmp_path, text)
    assert re.search(r"^8 frequencies", said, re.M)
    problem = read_deck(deck)
    hz = forecast(problem, 20).frequencies_hz
    assert hz[11] < 1e-3 * hz[12] and hz[13] == pytest.approx(hz[12], rel=1e-6)


@solver
@pytest.mark.parametrize(
    ("node", "place"), [("33, 0.400, 0.120, 0.006", "33, 0.400, 1e200, 0.006"), ("47, 0.400,", "47, 1e8,")]
)
def test_matrices_without_frequencies_are_refused(tmp_path, node, place):
    """A node far out of all places: eigenvalues of CalculiX's matrices are below zero beyond rounding, or too few are finite."""
    text = PLATE.read_text()
    assert text.count(f"\n{node}") == 1
    far = text.replace(f"\n{node}", f"\n{place}")
    with pytest.raises(DeckError) as refused:
        imports(written(tmp_path, far), tmp_path / "deck.yaml", "SI", False, lambda said: None)
    assert refused.value.diagnostics[0].code == "MD275" and "no frequencies" in str(refused.value)
    assert not list(tmp_path.glob("*.yaml"))


@solver
def test_a_dashpot_is_listed_and_left_out(tmp_path):
    """It is of no effect on K and M; CalculiX refuses its element without it."""
    more = "*ELEMENT, TYPE=DASHPOTA, ELSET=DAMPER\n12, 9, 1\n*DASHPOT, ELSET=DAMPER\n\n10.\n"
    deck, said = imported(tmp_path, BAR + more)
    assert {group.name for group in read_deck(deck).groups} == {"LOW", "HIGH"}
    assert "*DASHPOT" in said


@solver
def test_a_written_deck_reads_back_with_supports_and_sets(tmp_path):
    deck, _ = imported(tmp_path, BAR)
    problem = read_deck(deck)
    write_deck(problem, tmp_path / "again.yaml")
    again = read_deck(tmp_path / "again.yaml")
    assert again.structure.labels == problem.structure.labels
    for name in ("K", "M"):
        assert np.array_equal(getattr(again.structure, name), getattr(problem.structure, name))
        assert np.array_equal(getattr(again.groups[1], name), getattr(problem.groups[1], name))
        assert np.allclose(getattr(again.held.structure, name), getattr(problem.held.structure, name), rtol=1e-15)
    assert np.array_equal(again.held.supports[0].dofs, problem.held.supports[0].dofs)
    assert np.array_equal(again.A, problem.A) and np.array_equal(again.held.A.toarray(), problem.held.A.toarray())


@solver
def test_a_large_model_of_solids_is_checked_by_its_matrices(tmp_path, monkeypatch):
    """K and M with supports as CalculiX writes them; a support that the deck would not have is found out."""
    from mouse_cli.importing import checks
    from mouse_cli.importing.run import imported

    monkeypatch.setattr(checks, "_LARGE", 10)
    found = imported(written(tmp_path, BAR), tmp_path / "deck.yaml", "SI", False, str)
    assert "K and M with supports as the solver's, to" in found.text() and found.checked.matrices < 1e-12
    assert "The test goes here.\n" in (tmp_path / "deck.yaml").read_text()
    kept = checks._kept
    monkeypatch.setattr(checks, "_kept", lambda model, whole: np.union1d(kept(model, whole), [0]))
    with pytest.raises(DeckError, match="MD275"):
        imported(written(tmp_path, BAR), tmp_path / "deck.yaml", "SI", False, str)


def test_groups_that_do_not_touch_share_an_export(tmp_path):
    """Feet on a plate: two exports tell any number of them."""
    text = BAR.replace("*ELEMENT, TYPE=C3D8, ELSET=HIGH", "*NODE\n" + "".join(
        f"{n}, {x}, {y}, 3.\n" for n, (x, y) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1)], 13)
    ) + "*ELEMENT, TYPE=C3D8, ELSET=TOP\n3, 9, 10, 11, 12, 13, 14, 15, 16\n*ELEMENT, TYPE=C3D8, ELSET=HIGH")  # fmt: skip
    model = read(written(tmp_path, text + "*SOLID SECTION, ELSET=TOP, MATERIAL=STEEL\n"))
    assert sorted(sorted(model.groups[i].name for i in each) for each in colours(model)) == [["HIGH"], ["LOW", "TOP"]]


_TWO = """#!/bin/sh
# a solver that begins when another one has
touch "$MEET/$$"
for i in $(seq 200); do
    [ $(ls "$MEET" | wc -l) -ge 2 ] && exec {solver} "$@"
    sleep 0.05
done
echo "*ERROR alone"
"""


@solver
def test_exports_run_beside_one_another(tmp_path, monkeypatch):
    """The whole and the scaled groups: none waits for another."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "meet").mkdir()
    program = tmp_path / "bin" / "ccx"
    program.write_text(_TWO.format(solver=shutil.which("ccx")))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{program.parent}:{os.environ['PATH']}")
    monkeypatch.setenv("MEET", str(tmp_path / "meet"))
    assert "sets sum to the whole" in imported(tmp_path, BAR)[1]


TURNED = BAR + "*TRANSFORM, NSET=FOOT\n1, 1, 0, -1, 1, 0\n"


@solver
def test_a_clamp_in_directions_of_its_own(tmp_path):
    """*TRANSFORM of nodes that are held in all directions: the solver's own frequencies of the file as it is."""
    from mouse_cli.importing.calculix import Solver

    found = imports(written(tmp_path, TURNED), tmp_path / "deck.yaml", "SI", False, str)
    with Solver("job.inp", None, str) as ccx:
        expected = ccx.eigenvalues(TURNED + "*STEP\n*FREQUENCY\n4\n*END STEP\n", "by hand")
    np.testing.assert_allclose(
        found.checked.hz[:4], np.sqrt(np.sort(expected)[: len(found.checked.hz)][:4]) / (2 * np.pi), rtol=1e-6
    )


_FREE = BAR[: BAR.index("*BOUNDARY")] + "*NSET, NSET=TOP\n9, 10\n"
_SKEW = "1, 2, 0, -2, 1, 0\n"


@solver
@pytest.mark.parametrize(
    "rest",
    [f"*TRANSFORM, NSET=FOOT\n{_SKEW}*BOUNDARY\nFOOT, 1, 1\nFOOT, 3, 3\n",
     "*TRANSFORM, NSET=FOOT, TYPE=C\n.5, .4, 0, .5, .4, 1\n*BOUNDARY\nFOOT, 2, 3\n",
     f"*EQUATION\n2\n9, 1, 1., 10, 2, -1.\n*TRANSFORM, NSET=TOP\n{_SKEW}*BOUNDARY\nFOOT, 1, 3\n"],
    ids=["rectangular", "cylindrical", "equation"],
)  # fmt: skip
def test_directions_of_their_own_are_those_of_the_solver(tmp_path, rest):
    """Supports in some of the directions of *TRANSFORM, and equations in them: ccx by the file as it is."""
    from mouse_cli.importing.calculix import Solver

    found = imports(written(tmp_path, _FREE + rest), tmp_path / "deck.yaml", "SI", False, str)
    with Solver("job.inp", None, str) as ccx:
        expected = np.sort(ccx.eigenvalues(_FREE + rest + "*STEP\n*FREQUENCY\n4\n*END STEP\n", "by hand"))
    problem = read_deck(tmp_path / "deck.yaml")
    K, M = assembly(problem).matrices(problem.prior.mean)
    np.testing.assert_allclose(eigensolution(K, M, 4).eigenvalues[1:4], expected[1:4], rtol=1e-5)
    assert [each.code for each in found.remarks if "TRANSFORM" in each.message] == ([] if "EQUATION" in rest else ["MD273"])


REFUSED = {
    "contact": (BAR + "*CONTACT PAIR, INTERACTION=A\nX, Y\n", "MD268", 37),
    "unknown keyword": (BAR.replace("*NSET", "*FANCY\n*NSET"), "MD268", 20),
    "user element": (BAR.replace("C3D8, ELSET=LOW", "U1, ELSET=LOW"), "MD269", 16),
    "overlap": (BAR.replace("ELSET=HIGH, MATERIAL", "ELSET=LOW, MATERIAL"), "MD270", 28),
    "no section": (BAR.replace("*SOLID SECTION, ELSET=HIGH, MATERIAL=STEEL\n", ""), "MD271", None),
    "no material": (BAR.replace("HIGH, MATERIAL=STEEL", "HIGH, MATERIAL=STEAL"), "MD271", 28),
    "no density": (BAR.replace("*DENSITY\n7850.\n", ""), "MD271", 22),
    "missing set": (BAR.replace("FOOT, 1, 3", "FEET, 1, 3"), "MD272", 30),
    "missing node": (BAR.replace("6, 7, 8, 9, 10, 11, 12", "6, 7, 8, 9, 10, 11, 99"), "MD272", 19),
    "no number": (BAR.replace("2.1e11", "2.1f11"), "MD265", 24),
    "short element": (BAR.replace("9, 10, 11, 12\n*NSET", "9, 10, 11\n*NSET"), "MD265", 19),
    "missing include": (BAR + "*INCLUDE, INPUT=absent.inc\n", "MD266", 31),
    "cyclic include": (BAR + "*INCLUDE, INPUT=job.inp\n", "MD267", 31),
    "prestress": (BAR + "*STEP\n*STATIC\n*END STEP\n*STEP, PERTURBATION\n*FREQUENCY\n5\n*END STEP\n", "MD268", 34),
    "transform without directions": (BAR + "*TRANSFORM, NSET=FOOT, TYPE=C\n0, 0, 0, 0, 0, 1\n", "MD265", 31),
    "transform beside a constraint": (
        BAR + "*MPC\nPLANE, 9, 10, 11, 12\n*TRANSFORM, NSET=FOOT\n1, 1, 0, 0, 1, 0\n",
        "MD268",
        33,
    ),
}


@pytest.mark.parametrize("job", ["absent.inp", "."])
def test_a_job_that_is_no_file(tmp_path, monkeypatch, job):
    """It is a fault of what was given, not of writing the answer."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DeckError) as refused:
        read(job)
    assert refused.value.diagnostics[0].code == "MD250"


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused_by_file_and_line(tmp_path, name):
    text, code, line = REFUSED[name]
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, text))
    found = refused.value.diagnostics[0]
    assert found.code == code and found.span.file.endswith("job.inp") and found.help
    assert line is None or name == "contact" or found.span.line == line


def test_included_files_tell_their_own_name_and_line(tmp_path):
    (tmp_path / "part.inc").write_text("*NSET, NSET=MORE\n1, 77\n")
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, BAR + "*INCLUDE, INPUT=part.inc\n"))
    span = refused.value.diagnostics[0].span
    assert (Path(span.file).name, span.line) == ("part.inc", 2)


@pytest.mark.parametrize("way", ["up", "absolute", "link", "nested"])
def test_no_include_leads_out_of_the_folder_of_the_job(tmp_path, way):
    """Unless it is allowed; what a file in a folder below includes from the folder of the job is within."""
    (tmp_path / "job" / "sub").mkdir(parents=True)
    outside = tmp_path / "part.inc"
    outside.write_text("*NSET, NSET=MORE\n1, 77\n")
    (tmp_path / "job" / "link.inc").symlink_to(outside)
    (tmp_path / "job" / "sub" / "sub.inc").write_text("*INCLUDE, INPUT=../../part.inc\n")
    name = {"up": "../part.inc", "absolute": str(outside), "link": "link.inc", "nested": "sub/sub.inc"}[way]
    job = written(tmp_path / "job", BAR + f"*INCLUDE, INPUT={name}\n")
    with pytest.raises(DeckError, match="MD231") as refused:
        read(job)
    assert "--allow-outside" in refused.value.diagnostics[0].help
    with pytest.raises(DeckError, match="77"):  # of the file itself, which names a node that is not there
        read(job, outside=True)
    (tmp_path / "job" / "part.inc").write_text("*NSET, NSET=MORE\n1, 77\n")
    (tmp_path / "job" / "sub" / "sub.inc").write_text("*INCLUDE, INPUT=../part.inc\n")
    with pytest.raises(DeckError, match="77"):
        read(written(tmp_path / "job", BAR + "*INCLUDE, INPUT=sub/sub.inc\n"))


def test_motions_of_the_ground_and_sensitivities_leave_K_and_M_as_they_are(tmp_path):
    step = "*STEP\n*SENSITIVITY\n*BASE MOTION, DOF=1, AMPLITUDE=A\n*DESIGN RESPONSE, NAME=D\nMASS\n*END STEP\n"
    assert {"SENSITIVITY", "BASE MOTION", "DESIGN RESPONSE"} < set(read(written(tmp_path, BAR + step)).ignored)


def test_sets_may_overlap_that_have_no_section(tmp_path):
    """A group bears the name of the first of the smallest sets that are all of it; larger sets divide nothing."""
    sets = "*ELSET, ELSET=ALL\n1, 2\n*ELSET, ELSET=TIP\n2\n*MATERIAL"
    model = read(written(tmp_path, BAR.replace("*MATERIAL", sets)))
    assert [group.name for group in model.groups] == ["LOW", "HIGH"] and not model.remarks


def test_a_material_of_no_section_is_a_remark_with_its_line(tmp_path):
    model = read(written(tmp_path, BAR + "*MATERIAL, NAME=SPARE\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n"))
    (remark,) = model.remarks
    assert (remark.code, remark.span.line) == ("MD271", 31) and "SPARE" in remark.message


def test_keywords_without_effect_are_listed(tmp_path):
    model = read(written(tmp_path, BAR + "*STEP\n*FREQUENCY\n5\n*NODE FILE\nU\n*END STEP\n"))
    assert model.ignored == {"HEADING": 1, "FREQUENCY": 1, "NODE FILE": 1}


@solver
@pytest.mark.parametrize("kind", ["S4", "S8R"])
def test_shells_that_nothing_holds_have_six_rigid_modes(tmp_path, kind):
    """Digits that the mean over the thickness loses move their eigenvalues off zero, below and above."""
    corners = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))[: 8 if kind == "S8R" else 4]
    text = "*NODE\n" + "".join(f"{1 + x + 17 * y}, {0.05 * x}, {0.05 * y}, 0.\n" for y in range(13) for x in range(17))
    text += f"*ELEMENT, TYPE={kind}, ELSET=PLATE\n"
    for e, (x, y) in enumerate(((x, y) for y in range(0, 12, 2) for x in range(0, 16, 2)), 1):
        text += f"{e}, {', '.join(str(1 + x + i + 17 * (y + j)) for i, j in corners)}\n"
    text += "*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n*SHELL SECTION, ELSET=PLATE, MATERIAL=M\n0.003\n"
    imports(written(tmp_path, text), tmp_path / "deck.yaml", "SI", False, str)
    found = modes(read_deck(tmp_path / "deck.yaml"))
    assert found.rigid_modes == 6
    assert found.frequencies_hz[6] > 10
