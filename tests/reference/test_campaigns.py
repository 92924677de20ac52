"""Sweeps against runs of decks edited by hand, bootstraps against closed forms and scipy, and both through kills."""

import csv
import json
import signal
import subprocess
import sys
import time
from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import bootstrap as scipy_bootstrap

from mouse_cli._errors import DeckError
from mouse_cli.batch.changes import changed, edited
from mouse_cli.batch.drawn import reweighted
from mouse_cli.batch.work import perform
from mouse_cli.campaigns import answers, design, resampled, sweep
from mouse_cli.cli._vary import varied
from mouse_cli.cli.main import _run
from mouse_cli.formats import read_deck
from mouse_cli.updating import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
CHAIN = DECKS / "table_5_3.yaml"


def told(capsys, *arguments: object) -> tuple[int, dict]:
    """Exit code and document of `mouse ... -j 1 --json`."""
    status = _run([str(each) for each in (*arguments, "-j", "1", "--json", "-q")])
    return status, json.loads(capsys.readouterr().out)


EDITS = {  # a change of the sweep, and of the deck's text by hand
    "k1.sd=4000": [("sd: 8485.2814", "sd: 4000.0")],
    "k1=90000": [("nominal: 100000.0", "nominal: 90000.0"), ("[1, 1, 250000.0]", "[1, 1, 240000.0]")],
    "shape_sd*=3": [("shape_sd: 0.05", "shape_sd: 0.15")],
    "frequency_sd*=2": [
        ("[0.182125696, 0.546256567, 0.932136357, 1.12660245]", "[0.364251392, 1.092513134, 1.864272714, 2.2532049]")
    ],
    "test.modes.shape_sd=0.02": [("shape_sd: 0.05", "shape_sd: 0.02")],
    "parameters.k2.sd=5000": [("sd: 10000.0", "sd: 5000.0")],
    "parameters[2].sd=5000": [("sd: 10000.0", "sd: 5000.0")],
    "test.modes.frequency[4]=114.0": [("115.25]", "114.0]")],
    "test.modes.shapes[1][2]=-0.6": [("-0.597509", "-0.6")],
    "recursion=anchored": [("recursion: replaced", "recursion: anchored")],
    "estimator=least-squares": [("estimator: bayes", "estimator: least-squares")],
    "cycles=2": [("partials: 5", "partials: 5, cycles: 2")],
}


@pytest.mark.parametrize("vary", EDITS)
def test_a_point_is_the_run_of_the_deck_edited_by_hand(vary, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = CHAIN.read_text()
    for old, new in EDITS[vary]:
        assert text.count(old) == 1
        text = text.replace(old, new)
    Path("by_hand.yaml").write_text(text)
    result = run(read_deck("by_hand.yaml"))
    quantity = varied(vary, read_deck(CHAIN), by_points=False)
    (job,) = sweep.jobs(str(CHAIN), (quantity,), design.grid((quantity,)), {}, outside=False)
    point = answers.read(perform(job, str(tmp_path)), ["k1", "k2"], [])
    assert point.exit_code == result.exit_code
    assert point.theta == pytest.approx(result.revised.theta, rel=1e-9)
    assert point.sd == pytest.approx(result.sd_theta, rel=1e-7)
    assert point.chi2 == pytest.approx(result.residual.chi2, rel=1e-7)


def test_a_grid_of_a_sweep_and_its_table(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    vary = ("--vary", "recursion=anchored,replaced", "--vary", "shape_sd*=log:0.5:2:3")
    status, found = told(capsys, "sweep", CHAIN, *vary, "--csv", "t.csv")
    assert status == 1
    assert [list(p["values"].values()) for p in found["points"]] == [
        [word, pytest.approx(factor)] for word in ("anchored", "replaced") for factor in (0.5, 1.0, 2.0)
    ]
    table = list(csv.DictReader(Path("t.csv").read_text().splitlines()))
    assert len(table) == 6 * (2 + 4)
    values = [float(row["value"]) for row in table if row["name"] == "k1" and row["quantity"] == "parameter"]
    assert values == [p["posterior"]["k1"] for p in found["points"]]
    k1 = found["parameters"][0]
    assert k1["lowest"] == min(values) and k1["highest"] == max(values)
    sd = np.median([p["posterior_sd"]["k1"] for p in found["points"]])
    assert k1["moves_by_sd"] == pytest.approx((max(values) - min(values)) / sd, rel=1e-12)
    by_hand = np.reshape(values, (2, 3))
    whole = by_hand.var()
    assert k1["shares"]["recursion"] == pytest.approx(by_hand.mean(axis=1).var() / whole, rel=1e-9)
    assert k1["shares"]["shape_sd*"] == pytest.approx(by_hand.mean(axis=0).var() / whole, rel=1e-9)


def test_shares_of_a_sum_whose_shares_are_known():
    """y = 3 a + b, both uniform: nine tenths of its variance are due to a (Sobol). Noise alone explains nothing."""
    ab = tuple(design.Varied(name, "values", low=0.0, high=1.0) for name in "ab")
    for kind, error in (("sobol", 0.04), ("latin-hypercube", 0.09)):
        points = design.drawn(ab, 256, kind, seed=2)
        y = np.array([3 * a + b for a, b in points])
        a, b = (sweep.share(y, each, True) for each in sweep.grouped(points, 2))
        assert a == pytest.approx(0.9, abs=error) and b == pytest.approx(0.1, abs=error)
        noise = np.random.default_rng(3).standard_normal(256)
        assert max(sweep.share(noise, each, True) for each in sweep.grouped(points, 2)) < 0.08


def test_points_fill_their_ranges():
    """A Latin hypercube of n points has one in each n-th of every range; by logarithms where asked for; words share it out."""
    abc = (
        design.Varied("a", "values", low=2.0, high=4.0),
        design.Varied("b", "values", low=0.01, high=100.0, log=True),
        design.Varied("c", "run", values=("x", "y")),
    )
    a, b, c = zip(*design.drawn(abc, 40, "latin-hypercube", 4), strict=True)
    assert sorted(int((x - 2.0) * 20) for x in a) == list(range(40))
    assert sorted(int((np.log10(x) + 2) * 10) for x in b) == list(range(40))
    assert c.count("x") == c.count("y") == 20
    assert design.spaced(1.0, 16.0, 5, log=True) == pytest.approx((1, 2, 4, 8, 16))
    assert design.drawn(abc, 8, "sobol", 4) == design.drawn(abc, 8, "sobol", 4)


@pytest.mark.parametrize(
    ("vary", "code"),
    [("k3=1,2", "MD932"), ("test.modes.shapes=1", "MD932"), ("test.modes.frequency[5]=1", "MD932"), ("k1.sd=0,1", "MD933"),
     ("shape_sd*=-1", "MD933"), ("frequency_sd*=1e-308", "MD933"), ("model.mass.diagonal[1]={a}", "MD933"),
     ("parameters.k3.sd=1", "MD932")],
)  # fmt: skip
def test_what_cannot_be_varied_is_refused_before_anything_runs(vary, code, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(DeckError) as refused:
        problem = read_deck(CHAIN)
        name, _, value = vary.partition("=")
        kind = "texts" if ("." in name and not name.endswith("k1.sd")) or name == "k3" else "values"
        option = {kind: {name: value.split(",")[0] if kind == "texts" else float(value.split(",")[0])}}
        edited(CHAIN.read_bytes(), str(CHAIN), option)
        changed(problem, option)
    assert refused.value.diagnostics[0].code == code
    assert _run(["sweep", str(CHAIN), "--vary", vary, "-j", "1"]) == 4
    assert code in capsys.readouterr().err
    assert not list(tmp_path.glob("mouse-sweep/*.json"))


@pytest.mark.parametrize(
    "vary", ["k1", "k1=", "k1=a,b", "k1=3:1:4", "k1=1:3", "k1=log:-1:3:4", "recursion=never", "exact=maybe", "k1=1,1"]
)
def test_values_that_cannot_be_read_are_wrong_usage(vary, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert _run(["sweep", str(CHAIN), "--vary", vary]) == 2


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
def test_a_sweep_that_is_killed_goes_on_and_ends_like_an_unbroken_one(tmp_path):
    command = [
        sys.executable,
        "-m",
        "mouse_cli",
        "sweep",
        str(CHAIN),
        "--vary",
        "k1.sd=4000:16000:9",
        "--vary",
        "shape_sd*=0.5:2:6",
    ]
    command += ["-j", "1", "--json", "-q", "-o", "answers"]
    for place in ("whole", "broken"):
        (tmp_path / place).mkdir()
    whole = subprocess.run(command, cwd=tmp_path / "whole", capture_output=True, text=True, timeout=120)
    for target in (1, 20):
        going = subprocess.Popen(command, cwd=tmp_path / "broken", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        end = time.monotonic() + 60
        while (
            len(list(tmp_path.glob("broken/answers/*.json"))) < target
            and going.poll() is None
            and time.monotonic() < end
        ):
            time.sleep(0.002)
        going.kill()
        going.communicate()
    kept = {path: path.stat().st_mtime_ns for path in tmp_path.glob("broken/answers/*.json")}
    assert len(kept) >= 20
    time.sleep(0.3)  # what the killed one began may still be written
    last = subprocess.run(command, cwd=tmp_path / "broken", capture_output=True, text=True, timeout=120)
    assert all(path.stat().st_mtime_ns == when for path, when in kept.items())
    assert json.loads(last.stdout) == json.loads(whole.stdout)
    assert last.returncode == whole.returncode


SIZES = np.array([1.0, 1.5, 2.2, 3.0, 4.1, 5.5])
TRUE_HZ = np.sqrt(1000.0 * SIZES) / (2 * pi)


def separate(folder: Path, errors: np.ndarray) -> Path:
    """Six masses of 1 kg, each on its own spring of k SIZES: lambda_i = k SIZES_i, linear in k; errors in standard deviations."""
    sd = 0.01 * TRUE_HZ
    entries = ", ".join(f"[{i}, {i}, {1100 * size}]" for i, size in enumerate(SIZES, 1))
    moved = ", ".join(f"[{i}, {i}, {size}]" for i, size in enumerate(SIZES, 1))
    path = folder / "separate.yaml"
    path.write_text(
        "mouse: 1\n"
        f"model: {{stiffness: {{order: 6, entries: [{entries}]}}, mass: {{identity: 6}}}}\n"
        f"parameters: [{{name: k, nominal: 1100.0, sd: 100.0, stiffness: [{moved}]}}]\n"
        f"test: {{modes: {{frequency: {(TRUE_HZ + errors * sd).tolist()}, frequency_sd: {sd.tolist()}}}}}\n"
    )
    return path


def closed_form(path: Path, counts: np.ndarray) -> np.ndarray:
    """The posterior mean of k for weights (..., 6) of the frequencies, conjugate normal."""
    test = read_deck(path).test
    value = (2 * pi * test.frequency_hz) ** 2
    sd = 8 * pi**2 * test.frequency_hz * test.frequency_sd_hz
    precision = 1 / 100.0**2 + (counts * (SIZES / sd) ** 2).sum(axis=-1)
    return (1100.0 / 100.0**2 + (counts * SIZES * value / sd**2).sum(axis=-1)) / precision


def test_bootstrap_and_jackknife_of_a_linear_problem_are_the_closed_form(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = separate(tmp_path, np.array([0.8, -1.1, 0.3, 1.4, -0.6, -0.9]))
    _, found = told(capsys, "bootstrap", path, "--replicates", 60, "--seed", 7, "--csv", "t.csv")
    counts = np.array([each["counts"] for each in found["replicates"]])
    assert (counts.sum(axis=1) == 6).all()
    drawn = np.array([each["posterior"]["k"] for each in found["replicates"]])
    np.testing.assert_allclose(drawn, closed_form(path, counts), rtol=1e-9)
    k, whole = found["parameters"][0], closed_form(path, np.ones(6))
    assert k["value"] == pytest.approx(whole, rel=1e-9)
    assert k["sd"] == pytest.approx(closed_form(path, counts).std(ddof=1), rel=1e-7)
    assert k["bias"] == pytest.approx(closed_form(path, counts).mean() - whole, abs=1e-5)
    left_out = closed_form(path, 1 - np.eye(6))
    assert k["jackknife_sd"] == pytest.approx(np.sqrt(5 / 6 * np.sum((left_out - left_out.mean()) ** 2)), rel=1e-7)
    influence = (left_out - whole) / k["posterior_sd"]
    assert list(k["influence"].values()) == pytest.approx(influence, rel=1e-6)
    assert k["most_influential"] == f"mode {np.abs(influence).argmax() + 1}"
    sd = 8 * pi**2 * read_deck(path).test.frequency_hz * read_deck(path).test.frequency_sd_hz
    information = np.sum((SIZES / sd) ** 2)
    predicted = np.sqrt(5 / 6 * information) / (
        1 / 100.0**2 + information
    )  # sd of the sum of what each datum moves, times 1 - 1/6
    assert k["predicted_sd"] == pytest.approx(predicted, rel=1e-6)
    assert sum(row["kind"] == "replicate" for row in csv.DictReader(Path("t.csv").read_text().splitlines())) == 60 * (
        1 + 6
    )


@pytest.mark.parametrize(("scale", "code"), [(6.0, "MD936"), (0.02, "MD937"), (1.0, None)])
def test_data_that_disagree_and_data_better_than_stated_are_told(scale, code, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = separate(tmp_path, scale * np.array([0.8, -1.1, 0.3, 1.4, -0.6, -0.9]))
    _, found = told(capsys, "bootstrap", path, "--replicates", 40)
    codes = {each[:5] for each in found["warnings"]}
    assert codes & {"MD936", "MD937"} == ({code} if code else set())


def test_bca_is_that_of_scipy():
    x = np.random.default_rng(9).exponential(size=15)
    theirs = scipy_bootstrap((x,), np.mean, n_resamples=4000, rng=np.random.default_rng(1))
    left_out = np.array([np.delete(x, i).mean() for i in range(len(x))])
    ours = resampled.bca(theirs.bootstrap_distribution, x.mean(), [left_out])
    expected = theirs.confidence_interval
    assert ours == pytest.approx([expected.low, expected.high], rel=1e-3)
    assert resampled.jackknife_sd([left_out]) == pytest.approx(x.std(ddof=1) / np.sqrt(15), rel=1e-12)


def test_what_is_drawn_twice_has_half_the_variance_and_what_is_held_out_stays():
    problem = read_deck(DECKS / "ground_spring_proved.yaml")
    test, n = problem.test, problem.test.m
    modes, sensors = [2, *[1] * (n - 1)], [0, *[1] * (test.s - 2), 3]
    found = changed(problem, {"drawn": {"modes": modes, "sensors": sensors}})
    assert found.test.s == test.s - 1 and found.test.m == n
    assert found.test.frequency_sd_hz[0] == pytest.approx(test.frequency_sd_hz[0] / 2**0.5, rel=1e-12)
    assert found.test.frequency_sd_hz[1:] == pytest.approx(test.frequency_sd_hz[1:], rel=1e-12)
    assert found.test.shape_sd[-1, 0] == pytest.approx(test.shape_sd[-1, 0] / 6**0.5, rel=1e-12, nan_ok=True)
    assert found.hold_out is problem.hold_out


def test_a_sensor_left_out_is_the_deck_without_its_row(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    _, found = told(capsys, "bootstrap", CHAIN, "--over", "sensors", "--jackknife", "--recursion", "anchored")
    assert found["replicates"] == [] and found["parameters"][0]["sd"] is None
    text = (
        CHAIN.read_text()
        .replace("dofs: [1, 2, 3, 4]", "dofs: [1, 2, 4]")
        .replace("recursion: replaced", "recursion: anchored")
    )
    text = text.replace("      - [0.558403, 0.192409, -0.298186, -0.756338]\n", "")
    Path("without.yaml").write_text(text)
    result = run(read_deck("without.yaml"))
    without = next(each for each in found["left_out"] if each["without"] == "sensor 3")
    assert list(without["posterior"].values()) == pytest.approx(result.revised.theta, rel=1e-9)


def test_weights_of_both_kinds_multiply():
    problem = read_deck(CHAIN)
    found = reweighted(problem.test, [1, 2, 1, 0], [2, 1, 1, 0])
    assert found.shape_sd[0, 1] == pytest.approx(0.05 / 2.0)
    assert found.frequency_sd_hz[1] == pytest.approx(0.546256567 / 2**0.5)
    assert run(replace(problem, test=found)).y.shape == (3 + 9,)


def test_replicates_without_prior_spread_as_weighted_least_squares(tmp_path, capsys, monkeypatch):
    """k* = sum w c lambda / sum w c^2 in any replicate; to first order its sd is root of (1 - 1/6) / sum c^2 / s^2."""
    monkeypatch.chdir(tmp_path)
    path = separate(tmp_path, np.array([0.8, -1.1, 0.3, 1.4, -0.6, -0.9]))
    _, found = told(capsys, "bootstrap", path, "--replicates", 20, "--estimator", "weighted-least-squares")
    test = read_deck(path).test
    sd, value = 8 * pi**2 * test.frequency_hz * test.frequency_sd_hz, (2 * pi * test.frequency_hz) ** 2
    counts = np.array([each["counts"] for each in found["replicates"]])
    expected = (counts * SIZES * value / sd**2).sum(axis=1) / (counts * (SIZES / sd) ** 2).sum(axis=1)
    assert [each["posterior"]["k"] for each in found["replicates"]] == pytest.approx(expected, rel=1e-9)
    k = found["parameters"][0]
    assert k["predicted_sd"] == pytest.approx((5 / 6 / np.sum((SIZES / sd) ** 2)) ** 0.5, rel=1e-6)


def test_an_estimator_that_does_not_weigh_cannot_count_twice(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert _run(["bootstrap", str(CHAIN), "--estimator", "least-squares"]) == 4
    assert "MD934" in capsys.readouterr().err


def test_tests_without_modes_to_draw_are_refused(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert _run(["bootstrap", str(DECKS / "twin_springs.yaml"), "--over", "both"]) == 4
    assert "MD934" in capsys.readouterr().err
