"""Thickness of shells of an imported model: K and M by its powers; a parameter, what is missing, and the job. Truth: CalculiX."""

import re
import subprocess
import sys

import numpy as np
import pytest
from test_import import imported, solver, written

from mouse_cli import DeckError, read_deck, run, write_deck
from mouse_cli.cli.main import main
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.importing.calculix import Solver
from mouse_cli.importing.jobs import frequencies
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported as imports
from mouse_cli.terms.assembly import assembly


def folded(thickness: float) -> str:
    """A plate with a web of another thickness below its middle line: CalculiX lets both turn there as one body."""
    at = {(x, y, 0.0): 0 for x in range(6) for y in range(-2, 3)} | {(x, 0, -1.0): 0 for x in range(6)}
    number = {place: n for n, place in enumerate(at, 1)}
    text = "*NODE\n" + "".join(f"{n}, {0.1 * x}, {0.1 * y}, {0.1 * z}\n" for (x, y, z), n in number.items())
    square = lambda a, b: [number[each] for each in (a[0], a[1], b[1], b[0])]
    row = lambda x, y, z: ((x, y, z), (x + 1, y, z))
    skin = [square(row(x, y, 0.0), row(x, y + 1, 0.0)) for x in range(5) for y in range(-2, 2)]
    web = [square(row(x, 0, -1.0), row(x, 0, 0.0)) for x in range(5)]
    for name, first, each in (("SKIN", 1, skin), ("WEB", 101, web)):
        text += f"*ELEMENT, TYPE=S4, ELSET={name}\n"
        text += "".join(f"{n}, {', '.join(map(str, nodes))}\n" for n, nodes in enumerate(each, first))
    text += "*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n"
    text += f"*SHELL SECTION, ELSET=SKIN, MATERIAL=M\n{thickness!r}\n*SHELL SECTION, ELSET=WEB, MATERIAL=M\n0.006\n"
    return (
        text
        + f"*NSET, NSET=ENDS\n{number[0, -2, 0.0]}, {number[0, 2, 0.0]}, {number[5, 0, 0.0]}\n*BOUNDARY\nENDS, 1, 3\n"
    )


@pytest.mark.proof
@solver
def test_a_thickness_by_its_powers_is_that_of_the_solver(tmp_path):
    """K and M at a thickness that no export had, and a run by frequencies there, against CalculiX at that thickness."""
    true = 0.01 * 1.13
    for name in ("job", "other"):
        (tmp_path / name).mkdir()
    deck, said = imported(tmp_path / "job", folded(0.01), "--thickness", "SKIN")
    assert "thickness of shells by its powers: SKIN, WEB" in said
    problem, other = read_deck(deck), read_deck(imported(tmp_path / "other", folded(true))[0])
    names = [p.name for p in problem.parameters]
    i = names.index("thickness of SKIN")
    theta = problem.prior.mean.copy()
    theta[i : i + 3] = true ** np.array([1.0, 3.0, 5.0])
    found, expected = assembly(problem).matrices(theta), assembly(other).matrices(other.prior.mean)
    hz, ours = (np.sqrt(eigensolution(*each, 12).eigenvalues[:12]) / (2 * np.pi) for each in (expected, found))
    assert np.allclose(ours, hz, rtol=1e-8)
    hz = hz[:5]
    test = f"test:\n  modes:\n    frequency: [{', '.join(f'{f:.7g}' for f in hz)}]\n    frequency_sd: 0.01 %\n"
    deck.write_text(re.sub(r"(E of M|density of M)(.*?)sd: \d+ %", r"\1\2sd: 0.001 %", deck.read_text()) + test)
    theta = run(read_deck(deck)).revised.theta
    assert theta[i] == pytest.approx(true, rel=1e-3)
    assert np.allclose(theta[i : i + 3], theta[i] ** np.array([1.0, 3.0, 5.0]), rtol=1e-9)
    mouse, job, back = [sys.executable, "-m", "mouse_cli"], tmp_path / "job" / "job.inp", tmp_path / "back.inp"
    job.write_text(folded(0.01))
    subprocess.run([*mouse, "run", deck, "--json", "-q", "-o", tmp_path / "r.json"])
    command = [
        "export",
        deck,
        "--for",
        "calculix",
        "--job",
        job,
        "--result",
        tmp_path / "r.json",
        "-o",
        back,
        "--complete",
    ]
    subprocess.run([*mouse, *command, "-q"], check=True)
    (skin,) = re.findall(r"ELSET=SKIN, MATERIAL=M\n(\S+)", back.read_text())
    assert float(skin) == pytest.approx(theta[i], rel=1e-9)


@solver
@pytest.mark.parametrize("name", ["ENDS", "NOTHING"])
def test_a_thickness_of_what_is_no_shell_is_refused(tmp_path, name):
    with pytest.raises(subprocess.CalledProcessError) as refused:
        imported(tmp_path, folded(0.01), "--thickness", name)
    assert "MD272" in refused.value.stderr and "give one of SKIN, WEB" in refused.value.stderr


@solver
def test_a_support_on_springs_leaves_the_thickness_of_sets_in_its_deck(tmp_path):
    """What sets give by powers of their thickness sums to the set in the degrees of freedom of the extended deck too."""
    deck, _ = imported(tmp_path, folded(0.01))
    deck.write_text(deck.read_text() + "test:\n  modes:\n    frequency: [20, 30]\n    frequency_sd: 0.1 %\n")
    problem = read_deck(deck)
    recipes = reduced(problem, problem.prior.mean).recipes(registry()["support-translation"])
    for words in ("the support ENDS, TZ", "the support ENDS, all directions"):
        recipe = next(each for each in recipes if each.site(np.ones(1)).text == words)
        extended = recipe.extend(problem, np.array([1e6]))
        write_deck(extended, tmp_path / "extended.yaml")
        again = read_deck(tmp_path / "extended.yaml")
        assert all(each.thickness is not None for each in again.groups)
        there = [hz(*assembly(each).matrices(each.prior.mean)) for each in (extended, again)]
        assert np.allclose(*there, rtol=1e-8)


def hz(K, M, count: int = 8) -> np.ndarray:
    return np.sqrt(eigensolution(K, M, count).eigenvalues[:count]) / (2 * np.pi)


def solved(folder, text: str) -> np.ndarray:
    """Frequencies that CalculiX itself finds, without an import."""
    folder.mkdir()
    with Solver("job.inp", None, str) as ccx:
        found = ccx.eigenvalues(frequencies(read(written(folder, text)), 8), "frequencies")
    return np.sqrt(found[:8]) / (2 * np.pi)


@solver
@pytest.mark.parametrize(("key", "size"), [("thinner", 0.6), ("stiffness-gain", 1.5)])
def test_another_thickness_is_that_of_the_solver_in_a_diagnosis_its_deck_and_the_job(tmp_path, key, size):
    """In few coordinates, in the extended deck, in that deck read back, and in the job that is exported of it, which ccx runs."""
    (tmp_path / "job").mkdir()
    deck, _ = imported(tmp_path / "job", folded(0.01))
    expected = solved(tmp_path / "other", folded(0.01 * size))
    with deck.open("a") as file:
        file.write("test:\n  modes:\n    frequency: [50, 150, 250, 350]\n    frequency_sd: 0.1 %\n")
    problem = read_deck(deck)
    model = reduced(problem, problem.prior.mean)
    (recipe,) = (each for each in model.recipes(registry()[key])
                 if "thickness" in each.unknowns[0].name and "element set SKIN" in each.site(np.ones(1)).text)  # fmt: skip
    places = [each.site(each.grid[0]).text for each in model.recipes(registry()[key])]
    assert len(set(places)) == len(places)  # two of one name, thicker and stiffer, ended a diagnosis in an IndexError
    values = np.array([abs(size - 1)])
    change = recipe.change(values)
    K, M = np.diag(model.eigenvalues) + change.K, np.eye(model.r) + change.M
    assert np.allclose(hz(K, M, 4), expected[:4], rtol=2e-3)
    extended = recipe.extend(problem, values)
    write_deck(extended, tmp_path / "extended.yaml")
    for each in (extended, read_deck(tmp_path / "extended.yaml")):
        assert np.allclose(hz(*assembly(each).matrices(each.prior.mean)), expected, rtol=1e-6)
        assert each.groups[0].thickness.powers == (1.0, 3.0, 5.0)
    with pytest.raises(SystemExit) as left:
        main(["export", str(tmp_path / "extended.yaml"), "--for", "calculix", "--job", str(tmp_path / "job" / "job.inp"),
              "--complete", "-o", str(tmp_path / "back.inp")])  # fmt: skip
    assert left.value.code == 0
    assert np.allclose(solved(tmp_path / "after", (tmp_path / "back.inp").read_text()), expected, rtol=1e-9)


@solver
def test_a_set_within_a_section_gets_a_section_of_its_thickness(tmp_path):
    """One thickness of a section that has two sets, changed in one of them: in the job it has a section of its own."""
    from mouse_cli.importing.revised import revised_job
    from mouse_cli.model.revision import RevisedThickness, Revision

    within = folded(0.01).replace("*MATERIAL", "*ELSET, ELSET=EDGE\n1, 2, 3, 4\n*MATERIAL", 1)
    deck, _ = imported(tmp_path, within)
    revision = Revision("", "", "SI", thicknesses=(RevisedThickness("EDGE", 0.008),))
    text = revised_job(read(str(tmp_path / "job.inp")), read_deck(deck), revision, False)
    assert sorted(re.findall(r"\*SHELL SECTION.*\n(\S+)", text)) == ["0.006", "0.008", "0.01"]


def square(thickness: float, kind: str) -> str:
    """A plate of shells with nodes on their edges, S8 or S6."""
    at = [(i, j) for i in range(7) for j in range(5) if kind == "S6" or not (i % 2 and j % 2)]
    number = {place: n for n, place in enumerate(at, 1)}
    text = "*NODE\n" + "".join(f"{n}, {0.05 * i}, {0.05 * j}, 0.\n" for (i, j), n in number.items())
    eight = [[(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]]
    six = [[(0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)], [(0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)]]
    cells = [(i, j, each) for i in range(0, 6, 2) for j in (0, 2) for each in (six if kind == "S6" else eight)]
    made = [[number[i + p, j + q] for p, q in each] for i, j, each in cells]
    text += f"*ELEMENT, TYPE={kind}, ELSET=P\n" + "".join(
        f"{n}, {', '.join(map(str, e))}\n" for n, e in enumerate(made, 1)
    )
    text += (
        f"*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n*SHELL SECTION, ELSET=P, MATERIAL=M\n{thickness}\n"
    )
    return text + f"*NSET, NSET=ENDS\n1, 5, {len(at)}\n*BOUNDARY\nENDS, 1, 3\n"


@solver
@pytest.mark.parametrize("kind", ["S6", "S8"])
def test_shells_with_nodes_on_their_edges(tmp_path, kind):
    """Quadratic motions through their thickness go by its square: frequencies at 0.6 of it are those of CalculiX there."""
    deck, _ = imported(tmp_path, square(0.004, kind))
    problem = read_deck(deck)
    one, held = problem.groups[0].thickness, problem.held
    K, M = (A + sum((0.6**n - 1) * each for n, each in by.items())
            for A, by in ((held.structure.K, one.K), (held.structure.M, one.M)))  # fmt: skip
    found = hz(K[held.kept][:, held.kept], M[held.kept][:, held.kept])
    assert np.allclose(found, solved(tmp_path / "other", square(0.0024, kind)), rtol=1e-4)


@solver
def test_curved_shells_go_by_no_powers(tmp_path):
    """It is said, and they have none; where it was asked for it is refused. A quarter of a cylinder, R = 10 t."""
    angles = np.linspace(0, np.pi / 2, 7)
    at = [(0.1 * np.cos(a), 0.1 * np.sin(a), z) for a in angles for z in (0.0, 0.03, 0.06)]
    text = "*NODE\n" + "".join(f"{n}, {x:.12g}, {y:.12g}, {z:.12g}\n" for n, (x, y, z) in enumerate(at, 1))
    text += "*ELEMENT, TYPE=S4, ELSET=ARCH\n" + "".join(
        f"{2 * i + j + 1}, {3 * i + j + 1}, {3 * i + j + 4}, {3 * i + j + 5}, {3 * i + j + 2}\n" for i in range(6) for j in range(2)
    )  # fmt: skip
    text += "*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n*SHELL SECTION, ELSET=ARCH, MATERIAL=M\n0.01\n"
    text += "*NSET, NSET=ENDS\n1, 3, 19, 21\n*BOUNDARY\nENDS, 1, 3\n"
    deck, said = imported(tmp_path, text)
    assert "powers" not in said and read_deck(deck).groups[0].thickness is None
    with pytest.raises(subprocess.CalledProcessError) as refused:
        imported(tmp_path, text, "--thickness", "ARCH")
    assert "MD275" in refused.value.stderr and "leave out --thickness" in refused.value.stderr


@pytest.mark.parametrize(
    ("given", "what"),
    [
        ("{nominal: 0.01, powers: {1: {stiffness: {file: half.csv}}}}", "does not sum"),
        ("{nominal: -1, powers: {1: {stiffness: {file: K.csv}}}}", "nominal is -1"),
        ("{nominal: 1, powers: {thick: {stiffness: {file: K.csv}}}}", "no power"),
        ("{powers: {1: {stiffness: {file: K.csv}}}}", "nominal"),
    ],
)
def test_a_thickness_by_hand_is_checked(tmp_path, given, what):
    (tmp_path / "K.csv").write_text("2,-1\n-1,2\n")
    (tmp_path / "half.csv").write_text("1,-0.5\n-0.5,1\n")
    (tmp_path / "M.csv").write_text("1,0\n0,1\n")
    deck = tmp_path / "deck.yaml"
    text = "mouse: 1\nmodel:\n  stiffness: {file: K.csv}\n  mass: {file: M.csv}\n  sets:\n    SKIN: {stiffness: {file: K.csv}, "
    deck.write_text(text + f"thickness: {given}}}\ntest:\n  modes: {{frequency: [1], frequency_sd: 0.1}}\n")
    with pytest.raises(DeckError, match=what):
        read_deck(deck)


@solver
def test_shells_keep_their_thickness_where_springs_act_and_supports_hold_what_they_hold(tmp_path):
    """A spring at an edge node that is held across it: CalculiX keeps the mean of the node as a row, and leaves one face out.

    The mean of that row and a face was once taken for the node's motion: the import was refused, 1 % off the solver.
    """
    spring = "*ELEMENT, TYPE=SPRING1, ELSET=PROP\n900, 20\n*SPRING, ELSET=PROP\n3\n1.0e5\n*BOUNDARY\n20, 1, 2\n"
    found = imports(written(tmp_path, folded(0.01) + spring), tmp_path / "deck.yaml", "SI", False, str)
    assert found.checked.frequency < 1e-6
    assert [found.model.groups[i].name for i in found.thick] == ["SKIN", "WEB"]


def tied(kind: str, tie: str, thickness: float) -> str:
    """A plate of two sets whose nodes constraints move: one as another in one direction, or four as a body with a mass."""
    quadratic = kind == "S8R"
    at = {(x, y): 0 for y in range(9) for x in range(13) if quadratic * (x % 2) * (y % 2) == 0}
    number = {place: n for n, place in enumerate(at, 1)}
    text = "*NODE\n" + "".join(f"{n}, {0.05 * x}, {0.05 * y}, 0.\n" for (x, y), n in number.items())
    corners = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)) if quadratic else ((0, 0), (1, 0), (1, 1), (0, 1))
    step, first = (2, 1) if quadratic else (1, 1)
    for name, rows in (("LOW", range(0, 4, step)), ("HIGH", range(4, 8, step))):
        text += f"*ELEMENT, TYPE={kind}, ELSET={name}\n"
        for x, y in ((x, y) for y in rows for x in range(0, 12, step)):
            text += f"{first}, {', '.join(str(number[x + i, y + j]) for i, j in corners)}\n"
            first += 1
    text += "*MATERIAL, NAME=M\n*ELASTIC\n7.0e10, 0.3\n*DENSITY\n2700.\n"
    text += f"*SHELL SECTION, ELSET=LOW, MATERIAL=M\n{thickness!r}\n*SHELL SECTION, ELSET=HIGH, MATERIAL=M\n{thickness!r}\n"
    inner = [number[each] for each in ((4, 2), (6, 2), (4, 4), (6, 4))]
    if tie == "EQUATION":
        text += f"*EQUATION\n3\n{inner[0]}, 3, 1., {number[8, 6]}, 3, -0.5, {inner[1]}, 3, -0.5\n"
    else:
        ref = len(number) + 1
        text += f"*NODE\n{ref}, 0.25, 0.15, 0.1\n*NSET, NSET=BODY\n{', '.join(map(str, inner))}\n"
        text += f"*RIGID BODY, NSET=BODY, REF NODE={ref}\n*ELEMENT, TYPE=MASS, ELSET=BOX\n{first}, {ref}\n*MASS, ELSET=BOX\n3.\n"
    held = ", ".join(str(number[each]) for each in ((0, 0), (12, 0), (0, 8), (12, 8)))
    return text + f"*NSET, NSET=ENDS\n{held}\n*BOUNDARY\nENDS, 1, 3\n"


@solver
@pytest.mark.parametrize("tie", ["EQUATION", "RIGID BODY"])
@pytest.mark.parametrize("kind", ["S4", "S8R"])
def test_a_thickness_beside_constraints_is_that_of_the_solver(tmp_path, kind, tie):
    """Both sets at another thickness by their powers, against ccx."""
    (tmp_path / "job").mkdir()
    deck, said = imported(tmp_path / "job", tied(kind, tie, 0.01))
    assert "thickness of shells by its powers: LOW, HIGH" in said
    problem, size = read_deck(deck), 1.13
    moved = assembly(problem).matrices(problem.prior.mean)
    for k, x in enumerate("KM"):
        for group in problem.groups:
            for n, each in getattr(group.thickness, x).items() if group.thickness else ():
                kept = problem.held.kept
                moved = [a + (size**n - 1) * each[kept][:, kept] if i == k else a for i, a in enumerate(moved)]
    assert np.allclose(hz(*moved), solved(tmp_path / "other", tied(kind, tie, size * 0.01)), rtol=1e-6)
