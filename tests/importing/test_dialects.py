"""Input files as users have them: what the solver would pass over without a word, what it stops at, and idioms of Abaqus."""

import shutil

import numpy as np
import pytest
from test_import import BAR, written

from mouse_cli import DeckError
from mouse_cli.importing.calculix import Solver
from mouse_cli.importing.jobs import frequencies
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
