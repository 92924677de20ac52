"""Bulk data of several files, and CBUSH as springs. Truth: closed form of a spring along a direction, CalculiX by its own cards."""

import numpy as np
import pytest
from test_bulk_data import BRICKS, HEAD, MORE, solver, written

from mouse_cli import DeckError, read_deck
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported

TURNED = np.array([2.0, 1.0, 2.0]) / 3  # first axis of system 4
BUSHES = MORE + (
    "CORD2R,4,,0.,0.,0.,1.,2.,-2.,\n,2.,1.,2.\n"
    "CBUSH,50,5,9,,,,,4\nCBUSH,51,6,10,11\nCBUSH,52,7,12,,,,,0\n"
    "PBUSH,5,K,3.+9\nPBUSH,6,K,4.+9,,,,,,+\n+,B,100.\nPBUSH,7,K,1.+9,2.+9\n"
)


@solver
def test_a_bush_is_a_spring_in_each_of_its_directions(tmp_path):
    """K = k n n', n the axis: of a system, along its two points, or a basic one; the import checks itself."""
    imported(written(tmp_path, BUSHES), tmp_path / "deck.yaml", None, False, str)
    problem = read_deck(tmp_path / "deck.yaml")
    groups = {group.name: group for group in problem.groups}
    assert [*groups][2:] == ["CBUSH_50", "CBUSH_51", "CBUSH_52_1", "CBUSH_52_2"]
    assert [p.name for p in problem.parameters][2:] == [f"stiffness of {name}" for name in [*groups][2:]]
    for name, k, n in (("CBUSH_50", 3e9, TURNED), ("CBUSH_51", 4e9, np.array([1.0, -1.0]))):
        K = np.asarray(groups[name].K)
        rows = np.flatnonzero(np.abs(K).sum(axis=0) > 1.0)
        assert np.allclose(K[np.ix_(rows, rows)], k * np.outer(n, n), rtol=1e-9)


REFUSED = {
    "rotations": ("PBUSH,5,K,1.+6,,,1.+3\nCBUSH,50,5,9,,,,,0\n", "rotation"),
    "across its length": ("PBUSH,5,K,1.+6,1.+6\nCBUSH,50,5,9,10,,,,0\n", "K2 of this CBUSH acts across"),
    "no axes": ("PBUSH,5,K,1.+6\nCBUSH,50,5,9\n", "no CID"),
    "no property": ("CBUSH,50,5,9,,,,,0\n", "no PBUSH"),
    "a mass": ("PBUSH,5,K,1.+6,,,,,,+\n+,M,3.\nCBUSH,50,5,9,,,,,0\n", "mass"),
    "an offset": ("PBUSH,5,K,1.+6\nCBUSH,50,5,9,10,,,,,\n,.5,0,.1\n", "offset"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_bush_that_is_more_than_springs_is_refused_by_its_line(name, tmp_path):
    text, words = REFUSED[name]
    with pytest.raises(DeckError, match=words) as told:
        read(written(tmp_path, MORE + text))
    assert told.value.diagnostics[0].help and told.value.diagnostics[0].span.line > len(MORE.splitlines())


def test_bulk_data_of_several_files_is_one_model(tmp_path):
    """Places are those of the included file; a name between quotes goes on on the next line."""
    head, grids = BRICKS.index("GRID,1"), BRICKS.index("CHEXA")
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "grids.bdf").write_text(BRICKS[head:grids])
    (tmp_path / "sub" / "all.bdf").write_text("include 'gri\nds.bdf'\n" + BRICKS[grids:].replace("ENDDATA\n", ""))
    job = written(tmp_path, BRICKS[:head] + "INCLUDE 'sub/all.bdf' $ the model\nENDDATA\n")
    found, alone = read(job), read(written(tmp_path / "sub", BRICKS))
    assert {n: x.tolist() for n, x in found.nodes.items()} == {n: x.tolist() for n, x in alone.nodes.items()}
    assert found.elements == alone.elements and [s.dofs for s in found.supports] == [s.dofs for s in alone.supports]
    (tmp_path / "sub" / "all.bdf").write_text("INCLUDE 'grids.bdf'\nCBAR,9,9,1,2,0.,0.,1.\n" + BRICKS[grids:])
    with pytest.raises(DeckError, match="CBAR") as told:
        read(job)
    span = told.value.diagnostics[0].span
    assert span.file.endswith("all.bdf") and span.line == 2 and span.text.startswith("CBAR,9")


@pytest.mark.parametrize(
    ("line", "code"),
    [("INCLUDE 'absent.bdf'\n", "MD266"), ("INCLUDE job.bdf\n", "MD267"), ("INCLUDE '../job.bdf'\n", "MD231")],
)
def test_what_cannot_be_included_is_told_by_its_line(line, code, tmp_path):
    (tmp_path / "job.bdf").write_text(HEAD)
    (tmp_path / "job").mkdir()
    with pytest.raises(DeckError) as told:
        read(written(tmp_path / "job", HEAD + line))
    found = told.value.diagnostics[0]
    assert (found.code, found.span.line) == (code, len(HEAD.splitlines()) + 1) and found.help
