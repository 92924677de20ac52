"""`mouse plot`: figures of answers in JSON show the numbers of the document, whatever names it holds."""

import contextlib
import io
import json
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.cli.main import _run
from mouse_cli.plots import figures_of
from mouse_cli.report.reading import Part, read

matplotlib = pytest.importorskip("matplotlib", reason="figures need matplotlib")

DECKS = Path(__file__).resolve().parents[2] / "decks"
HOSTILE = "$\\frac{$ <b>\x00\u202e" + "x" * 200
MAGIC = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """A run of a structure, one of a chain with measured shapes, a diagnosis that names a cause."""
    folder = tmp_path_factory.mktemp("answers")
    for name, arguments in {
        "structure": ["run", "garteur_smag19.yaml"],
        "chain": ["run", "table_5_3.yaml"],
        "diagnosis": ["diagnose", "ground_spring.yaml"],
    }.items():
        with contextlib.redirect_stdout(io.StringIO()) as told:
            _run([arguments[0], str(DECKS / arguments[1]), "--json", "-q"])
        (folder / f"{name}.json").write_text(told.getvalue())
    return folder


def drawn(document: Part, key: str):
    """The axes of a figure; None where it had nothing to show."""
    from matplotlib.figure import Figure

    axes = Figure().add_subplot()
    return axes if figures_of(Part)[key].draw(document, axes) else None


@pytest.fixture
def documents(answers):
    return {path.stem: read(path.read_bytes(), str(path)) for path in answers.glob("*.json")}


def test_bars_are_what_the_models_miss(documents):
    document = documents["structure"]
    axes = drawn(document, "answer-frequencies")
    heights = [bar.get_height() for bar in axes.patches]
    expected = [
        100 * (m[key] / m["test_hz"] - 1) for key in ("prior_hz", "revised_hz") for m in document.values["modes"]
    ]
    assert heights == pytest.approx(expected)


def test_whiskers_are_the_posterior_in_prior_sd(documents):
    document = documents["structure"]
    axes = drawn(document, "answer-parameters")
    prior, posterior = (container[0].get_xydata()[:, 0] for container in axes.containers)
    found = document.values["parameters"]
    assert posterior == pytest.approx(np.array([(p["posterior"] - p["prior"]) / p["prior_sd"] for p in found]))
    assert not prior.any()
    reach = [abs(bar[1][0] - bar[0][0]) / 2 for bar in axes.containers[1][2][0].get_segments()]
    assert reach == pytest.approx([p["posterior_sd"] / p["prior_sd"] for p in found])


def test_the_diagonal_of_mac_is_that_of_the_paired_modes(documents):
    matrix = drawn(documents["chain"], "answer-mac").images[0].get_array()
    assert matrix.shape == (4, 4)
    expected = [m["mac"] for m in documents["chain"].values["modes"]]
    assert np.diag(matrix).tolist() == pytest.approx(expected, abs=1e-6)


def test_shapes_stand_beside_the_structure(documents):
    """Each mode is drawn over the undeformed lines, moved by its displacements; rigid parts keep their length."""
    document = documents["structure"]
    axes = drawn(document, "answer-shapes")
    shapes = document.values["geometry"]["shapes"][:8]
    labels = [text.get_text() for text in axes.texts]
    assert labels == [f"mode {s['mode']}, {s['hz']:.4g} Hz" for s in shapes]
    assert len(axes.lines) == 2 * len(shapes)
    still = [line.get_xydata() for line in axes.lines[::2]]
    moved = [line.get_xydata() for line in axes.lines[1::2]]
    for one, other in zip(still, moved, strict=True):
        assert one.shape == other.shape and np.nanmax(np.abs(one - other)) > 0


def test_a_diagnosis_shows_causes_and_places(documents):
    document = documents["diagnosis"]
    widths = [bar.get_width() for bar in drawn(document, "answer-causes").patches]
    assert widths == [g["probability"] for g in document.values["groups"]]
    bars = drawn(document, "answer-places")
    assert bars.get_yticklabels()[0].get_text().startswith("degree of freedom 2")
    assert bars.patches[0].get_width() == document.values["location"]["places"][0]["probability"]
    assert drawn(documents["chain"], "answer-causes") is None


@pytest.mark.parametrize("kind", sorted(MAGIC))
def test_files_of_every_kind(answers, tmp_path, kind):
    path = tmp_path / f"figures.{kind}"
    assert _run(["plot", str(answers / "diagnosis.json"), "-o", str(path)]) == 0
    assert path.read_bytes().startswith(MAGIC[kind])


def test_a_folder_holds_what_was_asked_for(answers, tmp_path, capsys):
    arguments = ["plot", str(answers / "structure.json"), "-o", str(tmp_path / "figures")]
    assert _run([*arguments, "--figure", "answer-shapes", "--figure", "answer-convergence"]) == 0
    assert sorted(path.name for path in (tmp_path / "figures").iterdir()) == [
        "answer-convergence.png",
        "answer-shapes.png",
    ]
    assert _run([*arguments, "--figure", "answer-causes"]) == 0
    assert "MD532" in capsys.readouterr().err
    assert _run([*arguments, "--figure", "nope"]) == 2
    assert "answer-frequencies" in capsys.readouterr().err


def test_names_of_any_kind_are_drawn(answers, tmp_path):
    for name in ("diagnosis", "structure"):
        text = (answers / f"{name}.json").read_text()
        document = json.loads(text)
        for update in (document, document.get("extended") or {}):
            for parameter in update.get("parameters", []):
                parameter["name"] = HOSTILE
        for group in document.get("groups", []):
            group["group"] = HOSTILE
        (tmp_path / "hostile.json").write_text(json.dumps(document))
        assert _run(["plot", str(tmp_path / "hostile.json"), "-o", str(tmp_path / "out.svg")]) == 0


def test_what_is_no_answer_is_refused(tmp_path, capsys):
    for text, code in (
        ("{}", "MD920"),
        ('{"schema": "mouse.spectra/1"}', "MD921"),
        ('{"schema": "mouse.result/1", "modes": 3}', "MD922"),
    ):
        (tmp_path / "bad.json").write_text(text)
        assert _run(["plot", str(tmp_path / "bad.json"), "-o", str(tmp_path / "out.png")]) == 4
        assert code in capsys.readouterr().err
    assert not (tmp_path / "out.png").exists()
