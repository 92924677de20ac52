"""Tables of modes as spreadsheets export them: what is written in them by hand here is what must be read."""

import numpy as np
import pytest

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.mode_files import read_modes

HZ, SD = [3.4, 21.5], [0.02, 0.1]
SHAPES = np.array([[0.1, -0.7], [0.4, -1.0], [np.nan, 0.1], [1.0, 1.3]])
NAMES = ("2TY", "3TY", "4TY", "5TY")
TABLES = {
    "rows of sensors": "node,direction,mode 1,mode 2\nfrequency,,3.4,21.5\nsd,,0.02,0.1\n2,TY,0.1,-0.7\n3,Y,0.4,-1\n"
    "4,+Y,,0.1\n5,-UY,-1,-1.3\n",
    "frequencies in the head": "# lab 3\nnode;dir;mode 1 (3,4 Hz);mode 2 (21,5 Hz)\nsd;;0,02;0,1\n2;TY;0,1;-0,7\n3;TY;0,4;-1\n"
    "4;TY;;0,1\n5;TY;1;1,3\n",
    "rows of modes": "Mode\tFrequency [Hz]\tSD\tDamping [%]\t2TY\t3:+Y\t4TY\t5:-Y\n2\t21.5\t0.1\t1\t-0.7\t-1\t0.1\t-1.3\n"
    "1\t3.4\t0.02\t2\t0.1\t0.4\t\t-1\n",
    "two tables": "\ufeffsensor,direction,1,2\r\n2,Y,0.1,-0.7\r\n3,Y,0.4,-1\r\n4,Y,-,0.1\r\n5,Y,1,1.3\r\n,,,\r\n"
    "mode,frequency,sd\r\n1,3.4,0.02\r\n"
    "2,21.5,0.1\r\n",
    "a title and frequencies above": "Bridge,,,\nfrequency,,3.4,21.5\nsd,,0.02,0.1\n"
    "point,axis,1,2\n2,Y,0.1,-0.7\n3,Y,0.4,-1\n4,Y,,0.1\n"
    "5,Y,1,1.3\n",
}  # fmt: skip
DECK = """mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 5, start: [0, 0], end: [1, 0]}}
    materials: {steel: {E: 2.1e+11, nu: 0.3, density: 7850}}
    sections: {bar: {rectangle: [0.006, 0.03]}}
    elements: [{id: 1-4, type: beam, nodes: 1-5, material: steel, section: bar}]
    supports: {1: all}
    plane: XY
parameters: [{name: E, material: steel, property: E, sd: 10 %}]
test: {modes: {file: modes.csv, shape_sd: 2 %}}
"""


@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_read_as_it_is_labelled(name, tmp_path):
    path = tmp_path / "modes.csv"
    path.write_bytes(TABLES[name].encode())
    found = read_modes(str(path))
    assert found.names == NAMES
    assert found.frequency_hz.tolist() == HZ and found.frequency_sd_hz.tolist() == SD
    np.testing.assert_allclose(found.shapes, SHAPES)


def problem(folder, table: str, deck: str = DECK):
    (folder / "modes.csv").write_text(table)
    (folder / "deck.yaml").write_text(deck)
    return read_deck(str(folder / "deck.yaml"))


def test_a_deck_takes_frequencies_their_sd_and_shapes(tmp_path):
    test = problem(tmp_path, TABLES["rows of sensors"]).test
    assert test.frequency_hz.tolist() == HZ and test.frequency_sd_hz.tolist() == SD
    np.testing.assert_allclose(test.shapes, SHAPES)
    np.testing.assert_allclose(test.shape_sd[:, 0], [0.02, 0.02, np.nan, 0.02])  # of the largest, 1


def test_sensors_by_coordinates_read_between_the_nodes(tmp_path):
    """Cubic interpolation of a beam, midway: half of both deflections and an eighth of the length times the turns."""
    table = "sensor,x,y,z,nx,ny,nz,1\nfrequency,,,,,,,3.4\nsd,,,,,,,0.1\nA,0.625,0,0,0,2,0,1\nB,1,0,0,1,1,0,2\n"
    test = problem(tmp_path, table).test
    assert test.sensors == ("A", "B")
    labels = read_deck(str(tmp_path / "deck.yaml")).structure.labels
    row = dict(zip(labels, test.sensing.toarray()[0], strict=True))
    expected = {"3TY": 0.5, "4TY": 0.5, "3RZ": 0.25 / 8, "4RZ": -0.25 / 8}
    assert {k: v for k, v in row.items() if v} == pytest.approx(expected)
    row = dict(zip(labels, test.sensing.toarray()[1], strict=True))
    assert {k: v for k, v in row.items() if v} == pytest.approx({"5TX": 0.5**0.5, "5TY": 0.5**0.5})


@pytest.mark.parametrize(
    ("table", "code", "words"),
    [
        ("2,TY,0.1\n", "MD252", "no head"),
        ("node,direction,mode 1\n2,up,0.1\n", "MD252", "'up' is no direction"),
        ("node,direction,mode 1\nfrequency,,abc\n2,TY,0.1\n", "MD252", "'abc' is no number"),
        ("sensor,x,y,z,mode 1\nA,1,0,0,0.1\n", "MD252", "needs x, y, z and a direction"),
        ("node,direction,1,2\n2,Y,1,1\nmode,frequency\n1,3\n", "MD252", "1 frequencies and shapes of 2 modes"),
    ],
)
def test_what_is_wrong_is_refused_by_its_line(table, code, words, tmp_path):
    with pytest.raises(DeckError) as told:
        problem(tmp_path, table)
    assert [d.code for d in told.value.diagnostics] == [code] and words in str(told.value)


def test_close_modes_that_noise_has_exchanged_are_sorted(tmp_path):
    modes = "{frequency: [3.4, 21.6, 21.5], frequency_sd: 1 %, dofs: [3TY, 5TY], shapes: [[1, 2, 3], [4, 5, 6]], shape_sd: 0.1}"
    found = problem(tmp_path, "", DECK.replace("{file: modes.csv, shape_sd: 2 %}", modes))
    assert [d.code for d in found.warnings] == ["MD336"] and found.test.frequency_hz.tolist() == [3.4, 21.5, 21.6]
    assert found.test.shapes.tolist() == [[1, 3, 2], [4, 6, 5]] and found.test.number.tolist() == [1, 2, 3]
    with pytest.raises(DeckError) as told:
        problem(tmp_path, "", DECK.replace("{file: modes.csv, shape_sd: 2 %}", modes.replace("21.6", "31.6")))
    assert [d.code for d in told.value.diagnostics] == ["MD322"]
