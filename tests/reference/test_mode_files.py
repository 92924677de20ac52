"""Mode shapes of universal files as measured modes: written by pyuff, an independent program, and by the layout of SDRC."""

import numpy as np
import pytest

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.mode_files import read_modes

NODES, HZ = np.arange(2, 6), np.array([3.4, 21.5, 60.25])
SHAPES = np.array([[0.1, -0.7, 1.2], [0.4, -1.0, 0.2], [0.7, 0.1, -1.1], [1.0, 1.3, 0.9]])
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
test:
  modes: {file: shapes.unv, frequency_sd: 1 %, shape_sd: 2 %"""


def pyuff_55(path, complex_shapes: bool = False) -> None:
    """Data sets 55 by pyuff, modal mass 4; complex ones turned by 40 degrees, 1 % damping."""
    pyuff = pytest.importorskip("pyuff", reason="needs pyuff")
    file, still = pyuff.UFF(str(path)), np.zeros(len(NODES))
    text = {f"id{k}": "NONE" for k in range(1, 6)}
    for r in (2, 0, 1):  # not in the order of their frequencies
        common = dict(text, model_type=1, data_ch=2, spec_data_type=8, n_data_per_node=3, node_nums=NODES, load_case=1)
        if complex_shapes:
            size = 2 * np.pi * HZ[r]
            values = {"r1": still + 0j, "r2": SHAPES[:, r] * np.exp(0.7j), "r3": still + 0j, "data_type": 5}
            pole = {"eig": size * (-0.01 + 1j * np.sqrt(1 - 1e-4)), "modal_a": 1 + 0j, "modal_b": 0j}
            mode = pyuff.prepare_55(analysis_type=3, mode_n=r + 1, **pole, **values, **common)
        else:
            values = {"r1": still, "r2": 2 * SHAPES[:, r], "r3": still, "data_type": 2}
            told = {"freq": HZ[r], "modal_m": 4.0, "modal_damp_vis": 0.02, "modal_damp_his": 0.0}
            mode = pyuff.prepare_55(analysis_type=2, mode_n=r + 1, **told, **values, **common)
        file.write_sets(mode, mode="add")


def text_2414(units: int = 1) -> str:
    """Data sets 2414 of normal modes with six values at a node, after the file specification of SDRC."""
    wholes, reals = (
        (lambda *n: "".join(f"{k:10d}" for k in n) + "\n"),
        (lambda *x: "".join(f"{v:13.5E}" for v in x) + "\n"),
    )
    sets = [
        f"    -1\n   164\n{units:10d}{'NONE':>20}{2:10d}\n{1:25.17E}{1:25.17E}{1:25.17E}\n{273.15:25.17E}\n    -1\n"
    ]
    for r, hz in enumerate(HZ):
        head = wholes(r + 1) + "modes\n" + wholes(1) + "NONE\n" * 5 + wholes(1, 2, 3, 8, 2, 6)
        head += (
            wholes(0, 0, 0, 0, 1, r + 1, 0, 0)
            + wholes(0, 0)
            + reals(0, hz, (2 * np.pi * hz) ** 2, 1, 0.03, 0)
            + reals(*[0] * 6)
        )
        body = "".join(
            wholes(node) + reals(0, value, 0, 0, 0, 0) for node, value in zip(NODES, SHAPES[:, r], strict=True)
        )
        sets.append(f"    -1\n  2414\n{head}{body}    -1\n")
    return "".join(sets)


def deck(folder, more: str = "") -> str:
    path = folder / "deck.yaml"
    path.write_text(f"{DECK}{more}}}\n")
    return str(path)


def test_normal_modes_of_data_sets_55(tmp_path):
    pyuff_55(tmp_path / "shapes.unv")
    found = read_modes(str(tmp_path / "shapes.unv"))
    assert found.names == ("2TY", "3TY", "4TY", "5TY")
    assert found.frequency_hz == pytest.approx(HZ, rel=1e-5) and found.damping == pytest.approx(np.full(3, 0.02))
    assert found.shapes == pytest.approx(SHAPES, rel=1e-5)  # 2 times over the root of a modal mass of 4


def test_complex_modes_are_turned(tmp_path):
    pyuff_55(tmp_path / "shapes.unv", complex_shapes=True)
    found = read_modes(str(tmp_path / "shapes.unv"))
    assert found.frequency_hz == pytest.approx(HZ, rel=1e-5) and found.damping == pytest.approx(
        np.full(3, 0.01), rel=1e-3
    )
    signs = np.sign((found.shapes * SHAPES).sum(axis=0))
    assert found.shapes * signs == pytest.approx(SHAPES, abs=1e-4)


@pytest.mark.parametrize(("units", "mass"), [(1, 1.0), (5, 1.0), (7, 175.126835246476), (2, 14.5939029372064)])
def test_data_sets_2414_with_the_units_of_164(tmp_path, units, mass):
    """One lbf s2/in is 175.1268 kg, one slug 14.5939 kg (NIST SP 811); mm and mN give kg."""
    (tmp_path / "shapes.unv").write_text(text_2414(units))
    found = read_modes(str(tmp_path / "shapes.unv"))
    assert (
        found.frequency_hz == pytest.approx(HZ) and found.shapes == pytest.approx(SHAPES) and found.damping[0] == 0.03
    )
    assert found.mass_kg == pytest.approx(mass, rel=1e-9)
    test = read_deck(deck(tmp_path)).test
    assert test.shapes == pytest.approx(SHAPES / np.sqrt(mass), rel=1e-9)


def test_a_deck_takes_all_sensors_or_those_it_names(tmp_path):
    (tmp_path / "shapes.unv").write_text(text_2414())
    whole = read_deck(deck(tmp_path)).test
    assert whole.frequency_hz == pytest.approx(HZ) and whole.frequency_sd_hz == pytest.approx(0.01 * HZ)
    assert whole.shapes == pytest.approx(SHAPES)
    assert whole.shape_sd == pytest.approx(0.02 * np.abs(SHAPES).max(axis=0) * np.ones((4, 1)))
    some = read_deck(deck(tmp_path, ", dofs: [5TY, 3-TY]")).test
    assert some.read(np.eye(12)[:, :3]).shape == (2, 3) and some.shapes == pytest.approx(SHAPES[[3, 1]] * [[1], [-1]])


def broken(text: str) -> dict[str, tuple[str, str]]:
    lines = text.splitlines()
    begin = lines.index("  2414") + 14
    word = [*lines[: begin + 1], lines[begin + 1].replace("0.00000E+00", "0.0000oE+00", 1), *lines[begin + 2 :]]
    return {
        "head": ("\n".join(lines[: begin - 4]), "MD252"),
        "row": ("\n".join([*lines[: begin + 1], *lines[begin + 8 :]]), "MD252"),
        "word": ("\n".join(word), "MD252"),
        "none": ("    -1\n   151\nmodel\n    -1\n", "MD624"),
        "no file": ("", "MD250"),
    }


@pytest.mark.parametrize("kind", ["head", "row", "word", "none", "no file"])
def test_damaged_files_are_diagnosed_with_their_line(tmp_path, kind):
    text, code = broken(text_2414())[kind]
    if kind != "no file":
        (tmp_path / "shapes.unv").write_text(text + "\n")
    with pytest.raises(DeckError) as caught:
        read_deck(deck(tmp_path))
    assert [each.code for each in caught.value.diagnostics] == [code]
    assert code != "MD252" or caught.value.diagnostics[0].span.line > 6


@pytest.mark.parametrize(("more", "code"), [(", dofs: [5TX]", "MD600"), (", frequency: [1, 2, 3]", "MD217")])
def test_a_deck_that_contradicts_the_file_is_refused(tmp_path, more, code):
    (tmp_path / "shapes.unv").write_text(text_2414())
    with pytest.raises(DeckError) as caught:
        read_deck(deck(tmp_path, more))
    assert code in [each.code for each in caught.value.diagnostics]


def surveyed(folder, systems: str, moved: int, size: float = 1.0) -> None:
    """Modes by pyuff at nodes 102 to 105 of the test, which stand on 2 to 5 of the model, in 1 / size m; geometry by its layout."""
    (folder / "shapes.unv").unlink(missing_ok=True)  # pyuff would add to it
    pyuff_55(folder / "shapes.unv")
    text = (folder / "shapes.unv").read_text()
    for node in NODES:
        text = text.replace(f"\n{node:10d}\n", f"\n{node + 100:10d}\n")
    nodes = "".join(
        f"{n + 100:10d}{0:10d}{moved:10d}{1:10d}\n{(n - 1) / 4 * size:25.16E}{0.0:25.16E}{0.0:25.16E}\n" for n in NODES
    )
    (folder / "shapes.unv").write_text(f"    -1\n  2411\n{nodes}    -1\n{systems}{text}")


def system(kind: int, axes, origin) -> str:
    rows = "".join("".join(f"{x:25.16E}" for x in row) + "\n" for row in (*axes, origin))
    return f"    -1\n  2420\n{1:10d}\npart\n{7:10d}{kind:10d}{1:10d}\nsystem\n{rows}    -1\n"


def test_sensors_stand_at_the_coordinates_of_the_test(tmp_path):
    surveyed(tmp_path, "", 0)
    test = read_deck(deck(tmp_path, ", mount: coordinates")).test
    assert test.sensors == ("102TY", "103TY", "104TY", "105TY") and test.shapes == pytest.approx(SHAPES, rel=1e-5)
    labels = read_deck(deck(tmp_path, ", mount: coordinates")).structure.labels
    read = test.read(np.eye(len(labels)))
    assert read == pytest.approx(np.array([[label == f"{n}TY" for label in labels] for n in NODES], float))
    with pytest.raises(DeckError):
        read_deck(deck(tmp_path))  # by numbers: the model has no node 102


def test_coordinates_are_in_the_unit_of_the_file(tmp_path):
    """Code 5 of data set 164 is mm, of a deck in m; without the set, a test of another size than the structure is refused."""
    units = f"    -1\n   164\n{5:10d}{'NONE':>20}{2:10d}\n{1:25.17E}{1:25.17E}{1:25.17E}\n{273.15:25.17E}\n    -1\n"
    surveyed(tmp_path, units, 0, 1e3)
    problem = read_deck(in_si(tmp_path))
    labels = problem.structure.labels
    expected = np.array([[label == f"{n}TY" for label in labels] for n in NODES], float)
    assert problem.test.read(np.eye(len(labels))) == pytest.approx(expected)
    surveyed(tmp_path, "", 0, 1e3)
    with pytest.raises(DeckError) as told:
        read_deck(in_si(tmp_path))
    assert [d.code for d in told.value.diagnostics] == ["MD335"] and "by 0.001" in told.value.diagnostics[0].help


def in_si(folder) -> str:
    """The deck with its units, and sensors by coordinates."""
    path = folder / "deck.yaml"
    path.write_text(DECK.replace("mouse: 1\n", "mouse: 1\nunits: SI\n") + ", mount: coordinates}\n")
    return str(path)


def test_shapes_that_are_zero_everywhere(tmp_path):
    text = text_2414()
    for value in SHAPES.ravel():
        text = text.replace(f"{0:13.5E}{value:13.5E}", f"{0:13.5E}{0:13.5E}")
    (tmp_path / "shapes.unv").write_text(text)
    with pytest.raises(DeckError, match="zero, or no numbers"):
        read_modes(str(tmp_path / "shapes.unv"))


def test_directions_of_other_systems(tmp_path):
    """Y of a system turned by 30 degrees about Z; the tangent of a cylindrical one whose axis is Z, below the sensors."""
    c, s = np.cos(np.pi / 6), 0.5
    surveyed(tmp_path, system(0, [[c, s, 0], [-s, c, 0], [0, 0, 1]], [0, 0, 0]), 7)
    problem = read_deck(deck(tmp_path, ", mount: coordinates"))
    labels, read = problem.structure.labels, problem.test.read(np.eye(problem.structure.n))
    assert dict(zip(labels, read[1], strict=True)) == pytest.approx(
        {x: {"3TX": -s, "3TY": c}.get(x, 0.0) for x in labels}
    )
    surveyed(tmp_path, system(1, np.eye(3), [0.5, -0.5, 0]), 7)
    read = read_deck(deck(tmp_path, ", mount: coordinates")).test.read(np.eye(problem.structure.n))
    far = {"5TX": -(0.5**0.5), "5TY": 0.5**0.5}  # radius at 45 degrees
    assert dict(zip(labels, read[3], strict=True)) == pytest.approx({x: far.get(x, 0.0) for x in labels})
