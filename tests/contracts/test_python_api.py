"""The Python API: few names, each documented by an example; frames and datasets hold the numbers of documents and no others."""

import doctest
import inspect
import json
import math
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from diagnosis_examples import DIAGNOSES
from hypothesis import given
from hypothesis import strategies as st
from report_examples import FORECASTS, PROBLEMS, chain, spectra

import mouse_cli
from mouse_cli._errors import DeckError, MouseError
from mouse_cli.cli.main import _run
from mouse_cli.report.answers import schemas
from mouse_cli.report.tables import tables
from mouse_cli.updating import run

TOP = Path(__file__).resolve().parents[2]
DECKS = TOP / "decks"
NAMES = sorted(set(mouse_cli.__all__) - {"__version__"})


def test_two_dozen_names_at_most():
    assert len(NAMES) <= 24
    assert set(NAMES) | {"__version__"} == set(mouse_cli.__all__) <= set(dir(mouse_cli))
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        mouse_cli.nothing  # noqa: B018


@pytest.mark.parametrize("name", NAMES)
def test_each_name_is_documented_by_an_example(name):
    found = getattr(mouse_cli, name)
    assert doctest.DocTestParser().get_examples(inspect.getdoc(found)), f"{name} has no example"
    assert f"`{name}`" in (TOP / "docs" / "how-to" / "python.md").read_text("utf-8")


def numbers(value: object) -> Iterator[float]:
    """All numbers in dicts, lists and arrays, without those that are unknown."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | np.ndarray):
        for each in value:
            yield from numbers(each)
    elif isinstance(value, int | float | np.number | np.bool_) and not math.isnan(value):
        yield value


def of_frames(frames: dict) -> Counter:
    """Numbers in the cells of frames, without the numbers of rows above."""
    found: Counter = Counter()
    for name, frame in frames.items():
        above = name.split(".")[-2:-1]  # the list above, if there is one in the document
        kept = [column for column in frame.columns if [column] != above or column in ("modes",)]
        found.update(one for column in kept for one in numbers(frame[column].tolist()))
    return found


ANSWERS = {
    **{f"result {name}": (lambda make=make: run(make())) for name, make in PROBLEMS.items()},
    **{f"diagnosis {name}": make for name, make in DIAGNOSES.items()},
    **{f"forecast {name}": make for name, make in FORECASTS.items()},
    "spectra": spectra,
}


@pytest.mark.parametrize("name", ANSWERS)
def test_frames_hold_all_numbers_of_the_document_and_no_others(name):
    pytest.importorskip("pandas", reason="the extra `frames` is not installed")
    document = mouse_cli.document(ANSWERS[name]())
    assert of_frames(mouse_cli.frames(document)) == Counter(numbers(document))


@pytest.mark.parametrize(
    "command", [["correlate", "cantilever.yaml", "--expand", "serep"], ["compare", "table_5_2.yaml"]], ids=" ".join
)
def test_frames_of_other_documents(capsys, command):
    pytest.importorskip("pandas", reason="the extra `frames` is not installed")
    _run([command[0], str(DECKS / command[1]), *command[2:], "--json", "-q"])
    document = json.loads(capsys.readouterr().out)
    assert of_frames(mouse_cli.frames(document)) == Counter(numbers(document))


def test_frames_of_a_result():
    pytest.importorskip("pandas", reason="the extra `frames` is not installed")
    result = run(chain())
    found = mouse_cli.frames(result)
    by_name = found["parameters"].set_index("name")
    assert by_name.posterior.tolist() == result.revised.theta.tolist()
    assert by_name.prior.to_dict() == {"k1": 1e5, "k2": 1.5e5} and set(by_name.unit) == {"N/m"}
    assert found["covariance"].loc["k1", "k2"] == result.covariance[0, 1]
    assert found["cycles"]["theta.k2"].tolist() == [cycle.theta[1] for cycle in result.cycles]
    shape = found["shapes"].pivot(index="dof", columns="mode", values="revised")
    assert np.array_equal(shape, result.revised.model_shapes)
    assert found["summary"]["residual.p"].tolist() == [result.residual.p]


def test_frames_of_a_deck_and_of_a_diagnosis():
    pytest.importorskip("pandas", reason="the extra `frames` is not installed")
    problem = chain()
    found = mouse_cli.frames(problem)
    assert found["parameters"].prior_sd.tolist() == problem.prior.sd.tolist()
    assert found["modes"].test_hz.tolist() == problem.test.frequency_hz.tolist()
    assert np.array_equal(found["shapes"].pivot(index="dof", columns="mode", values="test"), problem.test.shapes)
    named = mouse_cli.frames(DIAGNOSES["named"]())
    sizes = named["candidates.parameters"]
    first = named["candidates"].physics[sizes.candidates[0]], sizes.name[0], sizes.value[0], sizes.unit[0]
    assert first == ("ground-spring", "stiffness", 393.5, "N/m")
    assert "location.places" in named and named["groups"].probability.max() <= 1


def test_dataset_of_a_result():
    pytest.importorskip("xarray", reason="the extra `frames` is not installed")
    result = run(PROBLEMS["missing"]())
    found = mouse_cli.dataset(result)
    assert found.posterior.sel(parameter="k2") == result.revised.theta[1]
    assert found.covariance.sel(parameter="k1", other_parameter="k2") == result.covariance[0, 1]
    assert found.unit.values.tolist() == ["N/m", "N/m"] and found.test_hz.attrs["units"] == "Hz"
    measured = np.isfinite(result.test_shapes)
    assert np.array_equal(np.isfinite(found.test_shape), measured) and not measured.all()
    assert np.array_equal(found.revised_shape.values[measured], result.revised.model_shapes[measured])
    assert np.isnan(found.test_hz.sel(mode=2)) and found.model_mode.dtype.kind == "i"
    assert np.array_equal(found.theta, [cycle.theta for cycle in result.cycles])
    assert np.array_equal(found.stiffness, result.revised.K)
    assert found.attrs["model_form"] == result.model_form and found.attrs["exit_code"] == result.exit_code


def test_datasets_of_decks_forecasts_and_diagnoses():
    pytest.importorskip("xarray", reason="the extra `frames` is not installed")
    problem = chain()
    assert np.array_equal(mouse_cli.dataset(problem).test_shape, problem.test.shapes)
    assert np.array_equal(mouse_cli.dataset(problem).prior_covariance, problem.prior.dense())
    forecast = FORECASTS["chain"]()
    found = mouse_cli.dataset(forecast)
    assert np.array_equal(found["shape"], forecast.shapes) and np.array_equal(found.sd_hz, forecast.sd_hz)
    for name, make in DIAGNOSES.items():
        diagnosis = make()
        told = mouse_cli.document(diagnosis)
        model = told.get("extended") or told["baseline"]
        assert mouse_cli.dataset(diagnosis).posterior.values.tolist() == [
            each["posterior"] for each in model["parameters"]
        ], name
        assert mouse_cli.dataset(diagnosis).attrs["kind"] == diagnosis.kind


def test_dataset_of_functions(capsys):
    pytest.importorskip("xarray", reason="the extra `frames` is not installed")
    assert _run(["couple", str(DECKS / "coupled" / "portal.yaml"), "--json", "-q"]) in (0, 1)
    told = json.loads(capsys.readouterr().out)
    found = mouse_cli.dataset(told)
    one = told["functions"]["each"][-1]
    H = found.H.sel(response=one["response"], force=one["force"])
    assert np.array_equal(H.real, one["real"]) and np.array_equal(H.imag, one["imag"])
    assert found.line.values.tolist() == told["functions"]["hz"]


def test_answers_are_read_again_from_files(tmp_path, monkeypatch, capsys):
    pandas = pytest.importorskip("pandas", reason="the extra `frames` is not installed")
    monkeypatch.chdir(tmp_path)
    result = mouse_cli.run(mouse_cli.read_deck(DECKS / "sound_chain.yaml"))
    assert _run(["run", str(DECKS / "sound_chain.yaml"), "--json", "-q", "-o", "result.json"]) == 0
    assert _run(["batch", str(DECKS / "sound_chain.yaml"), "-j", "1", "-o", "answers"]) == 0
    capsys.readouterr()
    kept = mouse_cli.frames(result)
    for path in (Path("result.json"), *Path("answers").glob("*.json")):
        assert mouse_cli.document(path) == mouse_cli.document(result)
        for name, frame in mouse_cli.frames(str(path)).items():
            pandas.testing.assert_frame_equal(frame, kept[name])
        assert mouse_cli.dataset(path).identical(mouse_cli.dataset(result))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (None, "MD250"),
        ("mouse: 1", "MD920"),
        ('{"schema": "mouse.result/9"}', "MD921"),
        ('{"schema": "mouse.job/1", "document": null}', "MD920"),
    ],
)
def test_files_that_are_no_answers(tmp_path, text, code):
    path = tmp_path / "answer.json"
    if text is not None:
        path.write_text(text)
    with pytest.raises(DeckError) as told:
        mouse_cli.document(path)
    assert told.value.diagnostics[0].code == code
    with pytest.raises(TypeError, match="int is no answer"):
        mouse_cli.document(3)


def test_datasets_of_what_has_none(monkeypatch):
    pytest.importorskip("xarray", reason="the extra `frames` is not installed")
    with pytest.raises(DeckError) as told:
        mouse_cli.dataset(spectra())
    assert told.value.diagnostics[0].code == "MD961"
    for damaged in ([{"no name": 1}], [1], [{"name": "k", "prior": [1]}], [{"name": []}]):
        with pytest.raises(DeckError) as told:
            mouse_cli.dataset({"schema": "mouse.result/1", "parameters": damaged})
        assert told.value.diagnostics[0].code in ("MD922", "MD961")


@pytest.mark.parametrize(("name", "package"), [("frames", "pandas"), ("dataset", "xarray")])
def test_packages_that_are_not_there_are_told_of(monkeypatch, name, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MouseError) as told:
        getattr(mouse_cli, name)(chain())
    (one,) = told.value.diagnostics
    assert (one.code, package in one.message, "mouse-cli[frames]" in one.help) == ("MD960", True, True)


def test_every_kind_of_document_can_be_read():
    listed = (TOP / "docs" / "reference" / "json.md").read_text("utf-8")
    described = {line.split()[1].rstrip(",") for line in listed.splitlines() if line.startswith("## mouse.")}
    assert {"mouse.result/1", "mouse.diagnosis/1", "mouse.coupling/1"} <= described <= set(schemas())


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.floats(allow_nan=False) | st.text("ab.", max_size=3),
    lambda below: st.lists(below, max_size=3) | st.dictionaries(st.text("ab.", max_size=2), below, max_size=3),
    max_leaves=12,
)


@given(st.dictionaries(st.sampled_from(["parameters", "modes", "dofs", "a", "covariance", "cycles"]), JSON, max_size=4))
def test_any_document_becomes_tables_whose_columns_are_equally_long(document):
    for table in tables(document).values():
        lengths = {len(column) for column in table.columns.values()}
        assert len(lengths) <= 1
        assert table.index is None or {len(table.index)} == lengths
