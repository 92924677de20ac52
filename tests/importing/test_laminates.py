"""Laminates of an imported model: each material of the layers of a set is a set of its own. Truth: CalculiX."""

import numpy as np
import pytest
from test_import import imported, solver, written
from test_thickness import hz, solved, square

from mouse_cli import DeckError, read_deck
from mouse_cli.importing.read import read
from mouse_cli.importing.revised import revised_job
from mouse_cli.model.revision import RevisedMass, RevisedSet, RevisedSpring, Revision
from mouse_cli.terms.assembly import assembly

FACE = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n{E}, 9.0e9, 9.0e9, 0.3, 0.3, 0.4, {G}, 4.5e9,\n3.2e9\n*DENSITY\n1600.\n"
CORE = "*MATERIAL, NAME=CORE\n*ELASTIC\n1.0e9, 0.3\n*DENSITY\n120.\n"
TURNED = (
    "*ORIENTATION, NAME=ALONG\n1., 0., 0., 0., 1., 0.\n*ORIENTATION, NAME=ACROSS\n0., 1., 0., -1., 0., 0.\n"
    "*MATERIAL, NAME=CFRP\n" + FACE.format(E="1.2e11", G="4.5e9") + CORE
)
LAYERS = "0.002, , {0}, ALONG\n0.010, 3, CORE, 0.\n0.001, , {0}, ACROSS\n"


def panel(*left: str) -> str:
    """A sandwich plate; left: the section of its elements LEFT, where they have one of their own."""
    plate = square(0.01, "S8R").split("*MATERIAL")[0]
    sets = "*ELSET, ELSET=LEFT\n1, 2\n*ELSET, ELSET=REST\n3, 4, 5, 6\n"
    sections = left or ("",)
    own = (
        "".join(sections) + "*SHELL SECTION, ELSET=REST, COMPOSITE\n"
        if left
        else "*SHELL SECTION, ELSET=P, COMPOSITE\n"
    )
    ends = square(0.01, "S8R").split("0.01\n*NSET")[1]
    return plate + sets + TURNED + own + LAYERS.format("CFRP") + "*NSET" + ends


SOFT = panel(
    "*MATERIAL, NAME=WORSE\n" + FACE.format(E="8.4e10", G="3.15e9").replace("9.0e9", "6.3e9").replace("4.5e9", "3.15e9")
    .replace("3.2e9", "2.24e9") + "*SHELL SECTION, ELSET=LEFT, COMPOSITE\n" + LAYERS.format("WORSE")
)  # fmt: skip


@solver
def test_a_material_of_the_layers_of_a_set_is_a_set_of_its_own(tmp_path):
    """Matrices without 30 % of the stiffness of the faces of LEFT, and the job revised so, as a job written by hand.

    Without its faces the core of LEFT is there; without both, its elements are not.
    """
    (tmp_path / "job").mkdir()
    deck, _ = imported(tmp_path / "job", panel())
    problem = read_deck(deck)
    assert [each.name for each in problem.groups] == ["CFRP in LEFT", "CORE in LEFT", "CFRP in REST", "CORE in REST"]
    assert [p.name for p in problem.parameters][::2] == ["E of CFRP", "E of CORE"]
    expected = solved(tmp_path / "by hand", SOFT)
    K, M = assembly(problem).matrices(problem.prior.mean)
    assert np.abs(hz(K, M) / expected - 1).max() > 1e-3
    kept = problem.held.kept
    assert np.allclose(hz(K - 0.3 * problem.groups[0].K[kept][:, kept], M), expected, rtol=1e-6)
    model, lost = read(str(tmp_path / "job" / "job.inp")), RevisedSet("CFRP in LEFT", stiffness=-0.3)
    back = revised_job(model, problem, Revision("", "", "SI", sets=(lost,)), False)
    assert np.allclose(solved(tmp_path / "back", back), expected, rtol=1e-9)
    lost = [RevisedSet(name, left=0.0) for name in ("CFRP in LEFT", "CORE in LEFT")]
    for sets, count in ((lost[:1], 6), (lost, 4)):
        (tmp_path / "left").mkdir(exist_ok=True)
        text = revised_job(model, problem, Revision("", "", "SI", sets=tuple(sets)), False)
        assert len(read(written(tmp_path / "left", text)).elements) == count


@solver
def test_springs_and_masses_beside_laminates_are_bricks_that_the_solver_runs(tmp_path):
    """Against K and M with the same added by hand; of a spring or mass element CalculiX says that it does not know it."""
    (tmp_path / "job").mkdir()
    problem = read_deck(imported(tmp_path / "job", panel())[0])
    K, M = (
        np.array(each.todense() if hasattr(each, "todense") else each)
        for each in assembly(problem).matrices(problem.prior.mean)
    )
    a, b, c = (problem.structure.labels.index(f"{node}TZ") for node in (14, 8, 6))
    for i, j, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1), (c, c, 1)):
        K[i, j] += 3e5 * sign
    for d in "XYZ":
        i = problem.structure.labels.index(f"14T{d}")
        M[i, i] += 0.7
    springs = RevisedSpring("between", ((14, 3), (8, 3)), 3e5), RevisedSpring("to ground", ((6, 3),), 3e5)
    revised = Revision("", "", "SI", springs=springs, masses=(RevisedMass("tank", 14, 0.7),))
    model = read(str(tmp_path / "job" / "job.inp"))
    text = revised_job(model, problem, revised, False)
    assert "SPRING" not in text and "*MASS" not in text and "*MASS" in revised_job(model, problem, revised, True)
    assert np.allclose(solved(tmp_path / "back", text), hz(K, M), rtol=1e-6)


def test_a_layer_turned_by_an_angle_is_refused_by_its_line(tmp_path):
    text = panel().replace("CORE, 0.", "CORE, 45.")
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, text))
    found = refused.value.diagnostics[0]
    assert found.code == "MD268" and text.splitlines()[found.span.line - 1].endswith("45.")
