"""Bad input and doubtful answers as the command line tells them: each with its code, its place and a remedy, and no file."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.io import mmwrite, savemat
from scipy.sparse import coo_array

from mouse_cli.cli.main import _run
from mouse_cli.dynamics import memory

DECKS = Path(__file__).resolve().parents[2] / "decks"
BAR = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0], 3: [2, 0]}
    materials: {steel: {E: 2.0e+11, nu: 0.3, density: 7800}}
    sections: {bar: {rectangle: [0.01, 0.02]}}
    elements:
      - {id: 1-2, type: beam, nodes: 1-3, material: steel, section: bar}
      - {id: 10, type: mass, nodes: [3], mass: 0.5}
    supports: {1: [TX, TY, RZ]}
    plane: XY
parameters:
  - {name: E, material: steel, property: E, sd: 3 %}
test:
  modes: {frequency: [3], frequency_sd: 1 %, dofs: [2TY, 3TY], shapes: [[0.3], [1]], shape_sd: 0.05}
"""
LINKAGE = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0], 3: [1, 1], 4: [0, 1]}
    elements:
      - {id: 1-3, type: rod, nodes: 1-4, E: 2.0e+11, A: 1.0e-4, density: 7800}
    supports: {1: [TX, TY], 4: [TX, TY]}
    plane: XY
"""
CHAIN = """\
mouse: 1
model:
  stiffness: {order: 4, entries: [[1, 1, 2000], [1, 2, -1000], [2, 2, 2000], [2, 3, -1000], [3, 3, 2000], [3, 4, -1000],
      [4, 4, 1000]]}
  mass: {identity: 4}
parameters:
  - {name: k1, nominal: 1000, sd: 150, stiffness: [[1, 1, 1]]}
test:
  modes:
    number: [1, 2]
    dofs: [1, 2, 3, 4]
    frequency: [1.765, 4.99]
    frequency_sd: 1 %
    shapes: [[0.36, -0.98], [0.63, -1.02], [0.9, 0.02], [1, 1.03]]
    shape_sd: 0.02
run: {recursion: anchored}
"""
FILES = """\
mouse: 1
model:
  stiffness: {file: FILE}
  mass: {identity: 4}
test:
  modes: {frequency: [0.07], frequency_sd: 1 %}
"""


def changed(text: str, *changes: tuple[str, str]) -> str:
    """`text` with parts replaced, each of which it holds once."""
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


def told(capsys, *arguments: str) -> tuple[int, str, str]:
    """Exit code, standard output and standard error."""
    status = _run(list(arguments))
    out, err = capsys.readouterr()
    return status, out, err


BENT = "{id: 1-2, type: beam, nodes: 1-3, material: steel, section: bar"
STRUCTURES = [  # code, deck, line:column, words
    ("MD410", changed(BAR, ("3: [2, 0]}", "3: [2, 0], 4: [5, 5]}")), "4:46", "node 4 is held by no element"),
    ("MD304", changed(CHAIN, ("identity: 4", "diagonal: [1, 1, 0, 1]")), "5:27", "freedom 3 is 0"),
    (
        "MD304",
        changed(CHAIN, ("identity: 4", "dense: [[1, 1, 0, 0], [1, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]")),
        "5:22",
        "a motion of the degrees of freedom 1, 2 has no mass",
    ),
    ("MD304", changed(BAR, ("density: 7800", "density: 0"), ("mass: 0.5", "mass: 0")), "3:3", "2TX is 0"),
    ("MD418", LINKAGE, "4:24", "nothing resists a motion of 2TY, 3TY"),
    ("MD421", changed(BAR, (BENT, BENT + ", releases: {1: [TX], 2: [TX]}")), "8:9", "move by themselves"),
    ("MD412", changed(BAR, (BENT, BENT + ", orientation: [1, 0, 0]")), "8:9", "parallel to elements 1, 2"),
    ("MD329", changed(BAR, ("2TY, 3TY", "2TY, 7TY")), "15:58", "node 7, which the model does not have"),
    ("MD328", changed(BAR, ("2TY, 3TY", "2TY, 1TZ")), "15:58", "node 1 cannot move"),
]


@pytest.mark.parametrize("command", ["check", "run", "modes", "correlate"])
@pytest.mark.parametrize(("code", "deck", "place", "words"), STRUCTURES, ids=lambda v: str(v)[:5])
def test_a_structure_that_is_none(capsys, tmp_path, command, code, deck, place, words):
    path, output = tmp_path / "bad.yaml", tmp_path / "answer.txt"
    path.write_text(deck)
    status, _, err = told(capsys, command, str(path), *([] if command == "check" else ["-o", str(output)]))
    assert status == 4 and not output.exists()
    assert f"{path}:{place}: error[{code}]" in err and words in err and "= help: " in err, err


def test_weight_without_a_way_to_the_ground(capsys, tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text(changed(BAR, ("    supports: {1: [TX, TY, RZ]}\n", "    gravity: [0, -9.81]\n")))
    status, _, err = told(capsys, "check", str(path))
    assert status == 4 and f"{path}:" in err and "error[MD422]" in err


def test_a_part_that_moves_freely_is_told(capsys, tmp_path):
    path = tmp_path / "bad.yaml"
    free = ("3: [2, 0]}", "3: [2, 0], 4: [5, 5], 5: [6, 5]}")
    path.write_text(changed(BAR, free, (BENT, BENT.replace("1-3", "4-5").replace("1-2", "20") + "}\n      - " + BENT)))
    assert f"{path}:4:46: warning[MD423]: the part of nodes 4, 5" in told(capsys, "modes", str(path))[2]
    status, _, err = told(capsys, "run", str(path))
    assert status == 4 and "error[MD330]" in err


@pytest.mark.parametrize("command", ["run", "diagnose"])
def test_a_model_without_any_stiffness_has_rigid_modes_alone(capsys, tmp_path, command):
    path = tmp_path / "free.yaml"
    path.write_text(
        "mouse: 1\ntitle: free\nmodel: {stiffness: {order: 2, entries: [[1,1,0.0]]}, mass: {diagonal: [1.0, 2.0]}}\n"
        "parameters: []\ntest: {modes: {frequency: [5, 7], frequency_sd: 1 %, dofs: [1, 2], shapes: [[1, 0], [0, 1]], "
        "shape_sd: 2 %}}\n"
    )
    status, _, err = told(capsys, command, str(path))
    assert status == 4 and "error[MD330]" in err


PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0"
STI = b"1 1 2.0\n2 2 2.0\n3 3 2.0\n4 4 1.0\n1 2 -1.0\n2 3 -1.0\n3 4 -1.0\n"
IMPOSTORS = [
    ("k.mtx", PNG, "MD252", "the file is a picture"),
    ("k.mat", PNG, "MD252", "the file is a picture"),
    ("k.op4", b"a report of a run\n", "MD252", "2 whole numbers of 8 characters"),
    ("k.sti", b"", "MD252", "the file is empty"),
    ("k.h5", b"nothing", "MD252", "not an HDF5 file"),
    ("k.npz", b"nothing", "MD252", "not a NumPy archive"),
]


@pytest.mark.parametrize("command", ["check", "run", "modes", "correlate"])
@pytest.mark.parametrize(("name", "data", "code", "words"), IMPOSTORS, ids=lambda v: str(v)[:6])
def test_a_file_that_is_not_what_it_says(capsys, tmp_path, command, name, data, code, words):
    path, output = tmp_path / "bad.yaml", tmp_path / "answer.txt"
    path.write_text(FILES.replace("FILE", name))
    (tmp_path / name).write_bytes(data)
    status, _, err = told(capsys, command, str(path), *([] if command == "check" else ["-o", str(output)]))
    assert status == 4 and not output.exists()
    assert f"{tmp_path / name}:1:1: error[{code}]" in err and words in err
    assert f"{path}:3:21" in err and "= help: " in err


@pytest.mark.parametrize("packed", [False, True])
def test_a_matlab_file_cut_short(capsys, tmp_path, packed):
    path, file = tmp_path / "bad.yaml", tmp_path / "k.mat"
    path.write_text(FILES.replace("FILE", "k.mat"))
    savemat(file, {"K": np.diag([2.0, 2, 2, 1])}, do_compression=packed)
    file.write_bytes(file.read_bytes()[:-40])
    status, _, err = told(capsys, "run", str(path))
    assert status == 4 and f"{file}:1:1: error[MD252]: cut short" in err


def test_calculix_matrices_without_their_degrees_of_freedom(capsys, tmp_path):
    """A .sti numbers its rows; who they are only the .dof tells."""
    path = tmp_path / "bad.yaml"
    (tmp_path / "k.sti").write_bytes(STI)
    path.write_text(FILES.replace("FILE", "k.sti").replace("  mass:", "  dofs: {file: k.dof}\n  mass:"))
    status, _, err = told(capsys, "run", str(path))
    assert status == 4 and f"{tmp_path / 'k.dof'}:1:1: error[MD250]: there is no such file" in err
    path.write_text(FILES.replace("FILE", "k.sti").replace("1 %}", "1 %, dofs: [12TY], shapes: [[1]], shape_sd: 0.1}"))
    status, _, err = told(capsys, "run", str(path))
    assert status == 4 and "error[MD225]" in err and "'12TY'" in err and "the model has no labels" in err


def test_a_revision_that_makes_the_model_indefinite(capsys, tmp_path):
    """The loop of 1972 drives the spring below zero: no answer, and which property it was."""
    path, output = tmp_path / "bad.yaml", tmp_path / "answer.txt"
    path.write_text(
        changed(CHAIN, ("sd: 150", "sd: 5000"), ("anchored", "replaced"), ("[1.765, 4.99]", "[0.2, 5.033]"))
    )
    status, _, _ = told(capsys, "run", str(path), "-o", str(output))
    text = " ".join(output.read_text().split())
    assert status == 5 and "makes the model unphysical (the stiffness matrix has" in text
    assert re.search(r"; k1 -[\d.]+, 1000 before\)", text)


@pytest.mark.parametrize("command", ["run", "modes", "correlate"])
def test_a_model_too_large_for_the_memory(capsys, tmp_path, monkeypatch, command):
    monkeypatch.setattr(memory, "available", lambda: 1_000_000)
    n, path, output = 2000, tmp_path / "large.yaml", tmp_path / "answer.txt"
    here = np.arange(n)
    K = coo_array((np.r_[np.full(n, 2.0), np.full(n - 1, -1.0)], (np.r_[here, here[1:]], np.r_[here, here[:-1]])))
    mmwrite(tmp_path / "k.mtx", K, symmetry="symmetric")
    mmwrite(tmp_path / "m.mtx", coo_array((np.ones(n), (here, here))), symmetry="symmetric")
    path.write_text(FILES.replace("FILE", "k.mtx").replace("{identity: 4}", "{file: m.mtx}"))
    status, _, err = told(capsys, command, str(path), "-o", str(output))
    assert status == 5 and not output.exists()
    assert re.search(r"error\[MD517\]: a model of 2,000 degrees of freedom needs about [\d.]+ GB, and there are", err)


def test_memory_that_runs_out_is_said(capsys, monkeypatch):
    def exhausted(*_):
        raise MemoryError

    monkeypatch.setattr("mouse_cli.updating.run", exhausted)
    status, _, err = told(capsys, "run", str(DECKS / "sound_chain.yaml"))
    assert status == 5 and "error[MD512]" in err


BOTH = "- {name: k1, nominal: 1000, sd: 150, stiffness: [[1, 1, 1]]}\n"
REMARKS = [  # code, changes of CHAIN, words
    (
        "MD502",
        [(BOTH, BOTH + "  - {name: idle, nominal: 1, sd: 0.1, stiffness: [[1, 1, 1.0e-6]]}\n")],
        "do not determine idle",
    ),
    (
        "MD503",
        [(BOTH, BOTH.replace("150", "9000") + "  - {name: twin, nominal: 1000, sd: 9000, stiffness: [[1, 1, 1]]}\n")],
        "k1 and twin are determined only together",
    ),
    ("MD504", [("sd: 150", "sd: 150, lower: 990"), ("[1.765, 4.99]", "[1.6, 4.9]")], "k1 stopped at its limit, 990"),
    (
        "MD505",
        [("nominal: 1000", "nominal: 10"), ("sd: 150", "sd: 150"), ("[1.765, 4.99]", "[1.6, 4.9]")],
        "k1 became -",
    ),
    (
        "MD506",
        [
            ("sd: 150", "sd: 5"),
            ("[1, 2]\n", "[1, 3]\n"),
            ("0.02\n", "0.02\n    scale: none\n"),
            ("anchored", "anchored, pairing: number"),
        ],
        "resembles model mode 2",
    ),
    (
        "MD507",
        [("frequency_sd: 1 %", "frequency_sd: 50 %"), ("shape_sd: 0.02", "shape_sd: 5")],
        "better than their stated accuracies imply",
    ),
    ("MD508", [("recursion: anchored", "recursion: anchored, fix_total_mass: true")], "no property moves a mass"),
    (
        "MD509",
        [
            ("frequency: [1.765, 4.99]", "frequency: [1.765, 60.0]"),
            (
                "[[0.36, -0.98], [0.63, -1.02], [0.9, 0.02], [1, 1.03]]",
                "[[0.347, 1], [0.653, 1], [0.879, 1], [1, -1.87]]",
            ),
            ("recursion: anchored", "recursion: anchored, pairing: mac"),
        ],
        "measured mode 2 at 60 Hz has no likely partner",
    ),
]


@pytest.mark.parametrize(("code", "changes", "words"), REMARKS, ids=[code for code, *_ in REMARKS])
def test_what_a_careful_reader_is_told_of_an_answer(capsys, tmp_path, code, changes, words):
    path = tmp_path / "deck.yaml"
    path.write_text(changed(CHAIN, *changes))
    _, out, _ = told(capsys, "run", str(path))
    out = " ".join(out.split())
    assert code in out and words in out
    path.write_text(CHAIN)
    assert code not in told(capsys, "run", str(path))[1]


COMPARED = [
    ("MD510", [("number: [1, 2]", "number: [1, 3]"), ("4.99", "7.55")], (), "model mode 3 at 7.71"),
    ("MD513", [("[0.63, -1.02]", "[-0.63, 1.02]")], (), "sensor 2 looks mounted backwards"),
    (
        "MD516",
        [
            ("dofs: [1, 2, 3, 4]", "dofs: [1]"),
            ("[[0.36, -0.98], [0.63, -1.02], [0.9, 0.02], [1, 1.03]]", "[[0.36, -0.98]]"),
        ],
        (),
        "look alike",
    ),
]


@pytest.mark.parametrize(("code", "changes", "options", "words"), COMPARED, ids=[code for code, *_ in COMPARED])
def test_what_a_test_engineer_is_told_of_a_comparison(capsys, tmp_path, code, changes, options, words):
    path = tmp_path / "deck.yaml"
    path.write_text(changed(CHAIN, *changes))
    status, _, err = told(capsys, "correlate", str(path), *options)
    assert status == 0 and f"warning[{code}]" in err and words in err, err


def test_sensors_that_leave_a_motion_free(capsys, tmp_path):
    """Two bodies, sensors on one: the other one moves without force, so that nothing static tells of it."""
    path = tmp_path / "deck.yaml"
    path.write_text(
        "mouse: 1\nmodel:\n  stiffness: {dense: [[1, -1, 0, 0], [-1, 1, 0, 0], [0, 0, 1, -1], [0, 0, -1, 1]]}\n"
        "  mass: {identity: 4}\ntest:\n  modes: {number: [3], frequency: [0.225], frequency_sd: 1 %, dofs: [1, 2], "
        "shapes: [[1], [-1]], shape_sd: 0.01}\n"
    )
    assert "warning[MD515]" in told(capsys, "correlate", str(path))[2]
    status, _, err = told(capsys, "correlate", str(path), "--expand", "guyan")
    assert status == 5 and "error[MD514]" in err


def test_a_structure_does_not_go_on_cards(capsys, tmp_path):
    status, _, err = told(capsys, "convert", str(DECKS / "cantilever.yaml"), "-o", str(tmp_path / "no.dat"))
    assert status == 4 and err.count("error[") == 1 and "error[MD152]: the model is made of elements" in err
    assert not list(tmp_path.iterdir())


ONE_STILL = """\
mouse: 1
model: {stiffness: {dense: [[2, -1], [-1, 2]]}, mass: {identity: 2}}
test: {modes: {frequency: [0.16, 0.28], frequency_sd: 1 %, dofs: [1, 2], shapes: [[1, 0], [0, ~]], shape_sd: 0.1}}
"""
ALMOST_NO_MASS = BAR.replace("mass: 0.5", "mass: 1.0e-308").replace(
    "parameters:\n", "parameters:\n  - {name: tip, elements: 10, property: mass, sd: 3 %}\n"
)


@pytest.mark.parametrize(
    ("command", "deck"), [(["correlate", "--expand", "guyan"], ONE_STILL), (["run"], ALMOST_NO_MASS)], ids=["zeros", "no mass"]
)
def test_extreme_values_divide_nothing_by_zero(command, deck, tmp_path, capsys):
    path = tmp_path / "deck.yaml"
    path.write_text(deck)
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        assert _run([command[0], str(path), *command[1:]]) in (0, 1), capsys.readouterr().err
