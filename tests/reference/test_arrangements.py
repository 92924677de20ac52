"""Several arrangements of a chain of masses and springs; truths from matrices written down here, by numpy alone."""

import json
from pathlib import Path

import numpy as np
import pytest

from mouse_cli.cli._arrangements import Named
from mouse_cli.cli.main import _run
from mouse_cli.diagnosis.likelihoods.configurations import diagnose
from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged, Together
from mouse_cli.diagnosis.likelihoods.configurations.predict import predicted
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors
from mouse_cli.diagnosis.likelihoods.configurations.shared import frequencies as of_frequencies
from mouse_cli.diagnosis.likelihoods.configurations.sought import Sought
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.rank import rank
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import Choices

N, K, MASS, ITEM = 8, 2.0e5, 1.0, 0.12
COMMON = np.array([0.3, -0.25, 0.2, 0.1, -0.35]) / 100  # what "theory" errs in ln f, in every arrangement alike
NOISE = 0.0005
PLACES = [(1, 5), (2, 6), (3, 7), (4, 8), (2, 8), (1, 7), (3, 5), (4, 6), (1, 3), (5, 8)]  # of two items


def frequencies(places, item=0.0, ground=0.0, lost=0.0) -> np.ndarray:
    """Five natural frequencies in Hz; ground: N/m at node 6; lost: share of the spring between nodes 3 and 4."""
    springs = np.full(N, K)
    springs[3] *= 1 - lost
    stiffness = np.diag(springs + np.append(springs[1:], 0.0)) - np.diag(springs[1:], 1) - np.diag(springs[1:], -1)
    stiffness[5, 5] += ground
    mass = np.full(N, MASS)
    for node in places:
        mass[node - 1] += item
    values = np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(mass, mass)))
    return np.sqrt(values[:5]) / (2 * np.pi)


def written(folder: Path, name: str, sd: str, modes: str, items: str = "", more: str = "") -> str:
    """A deck of eight like springs and masses, whose stiffness has that sd, with measured `modes`."""
    path = folder / f"{name}.yaml"
    path.write_text(f"""mouse: 1
title: {name}
units: SI
model:
  structure:
    nodes: {{line: {{from: 0, to: {N}, start: [0, 0, 0], end: [{N}, 0, 0]}}}}
    elements:
      - {{id: 1-{N}, type: spring, nodes: 0-{N}, TX: {K}}}
      - {{id: 11-{10 + N}, type: mass, nodes: 1-{N}, mass: {MASS}}}
{items}    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{N}, property: TX, sd: {sd}}}
test:
  modes: {{{modes}, frequency_sd: 0.05 %}}
{more}""")
    return str(path)


def deck(folder: Path, name: str, places, truth: np.ndarray, seed: int, item: float = 0.0, more: str = "") -> str:
    hz = truth * np.exp(COMMON + NOISE * np.random.default_rng(seed).standard_normal(5))
    items = f"      - {{id: 21-22, type: mass, nodes: {list(places)}, mass: {item}}}\n"
    return written(folder, name, "3 %", f"frequency: {hz.tolist()}", items, more)


SCATTER = np.array([4.0, -3.0, 2.5, -4.0, 1.5, 3.0, -2.0, 3.5]) / 100  # of each spring, which no parameter has
SENSORS = (1, 3, 4, 6, 8)


def measured(
    folder: Path, name: str, seed: int, lost: float = 0.0, at: int = 4, errors: float = 1.0, ground: float = 0.0
) -> str:
    """A deck whose model has eight like springs, with modes of a chain whose springs scatter; lost: share of spring `at`.

    errors: times those of the test and the scatter. ground: stiffness of a spring at node 6 that is in no model.
    """
    springs = K * (1 + errors * SCATTER)
    springs[at - 1] *= 1 - lost
    beside = np.diag(springs[1:], 1)
    stiff = np.diag(springs + np.append(springs[1:], 0.0)) - beside - beside.T
    stiff[5, 5] += ground
    values, shapes = np.linalg.eigh(stiff)
    rng = np.random.default_rng(seed)
    hz = np.sqrt(values[:5] / MASS) / (2 * np.pi) * np.exp(errors * NOISE * rng.standard_normal(5))
    seen = shapes[np.array(SENSORS) - 1, :5]
    seen = (seen / np.abs(seen).max(axis=0) + errors * 0.005 * rng.standard_normal(seen.shape)).round(9)
    dofs = ", ".join(f"{node}TX" for node in SENSORS)
    modes = f"frequency: {hz.tolist()}, dofs: [{dofs}], shapes: {seen.tolist()}, shape_sd: 0.5 %"
    return written(folder, name, "5 %", modes)


def asked(folder: Path, *arguments: str) -> tuple[int, dict]:
    out = folder / "answer.json"
    code = _run(["diagnose", *arguments, "--common-sd", "0.3", "-q", "--report", str(out), "--json"])
    return code, json.loads(out.read_text())


def given(decks: list[str], fitted: int) -> list[str]:
    return decks[:fitted] + [part for each in decks[fitted:] for part in ("--held-out", each)]


@pytest.mark.proof
def test_items_and_a_spring_are_told_in_turn(tmp_path, capsys):
    decks = [deck(tmp_path, f"a{i}", p, frequencies(p, ITEM, 3e4), i) for i, p in enumerate(PLACES)]
    code, found = asked(tmp_path, *given(decks, 6), "-o", str(tmp_path / "revised"))
    assert code == 1
    told = {cause["physics"]: cause for cause in found["verdict"]["causes"]}
    assert set(told) == {"items", "ground-spring"} and found["verdict"]["kind"] == "named"
    assert told["ground-spring"]["site"]["ids"] == ["6TX"]
    value = {each["name"]: (each["posterior"], each["sd"]) for each in found["parameters"]}
    for truth, name in ((ITEM, "mass of items 21, 22"), (3e4, next(n for n in value if n.startswith("ground spring")))):
        assert abs(value[name][0] - truth) < 3 * value[name][1]
        assert value[name][1] < 0.1 * truth
    before, after = found["held_out"]["baseline"], found["held_out"]["revised"]
    assert before["rms_frequency_error"] > 0.005
    assert after["rms_frequency_error"] < 0.001  # noise 0.05 %, errors of theory learnt from the others
    assert after["covered"] > 0.75
    printed = " ".join(capsys.readouterr().out.split())
    assert found["verdict"]["causes"][0]["site"]["text"] in (tmp_path / "answer.json").read_text()
    assert "revised, 6 decks" in printed or found["revised_decks"]
    again = [read_deck(path) for path in found["revised_decks"]]
    assert len({tuple(p.name for p in each.parameters) for each in again}) == 1
    code, after = asked(tmp_path, *found["revised_decks"])
    assert (code, after["verdict"]["kind"]) == (0, "nothing-missing")


def test_errors_that_all_share_are_no_cause(tmp_path):
    decks = [deck(tmp_path, f"c{i}", p, frequencies(p), 40 + i) for i, p in enumerate(PLACES)]
    code, found = asked(tmp_path, *given(decks, 6))
    assert (code, found["verdict"]["kind"], found["turns"]) == (0, "nothing-missing", [])
    for error in found["shared_errors"]:
        assert abs(error["value"] - COMMON[error["mode"] - 1]) < 3 * error["sd"]
    assert found["held_out"]["baseline"]["covered"] > 0.75


def test_what_changed_is_sought_in_what_changed(tmp_path):
    before = [deck(tmp_path, f"b{i}", p, frequencies(p, ITEM), i, ITEM) for i, p in enumerate(PLACES[:5])]
    later = [deck(tmp_path, f"d{i}", p, frequencies(p, ITEM, lost=0.2), 20 + i, ITEM) for i, p in enumerate(PLACES[:8])]
    changed = [part for each in later for part in ("--changed", each)]
    held = [part for each in later[5:] for part in ("--held-out", each)]
    code, found = asked(tmp_path, *before, *changed, *held)
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["physics"], cause["site"]["text"]) == (1, "stiffness-loss", "spring 4")
    (size,) = found["turns"][0]["candidates"][0]["parameters"]
    assert abs(size["value"] - 0.2) < 3 * size["sd"]
    assert found["changed"] == [False] * 5 + [True] * 5


@pytest.mark.proof
def test_what_did_not_change_may_be_held_out_too(tmp_path):
    """Of what is held out nothing has the cause: that it is elsewhere takes nothing from its prediction."""
    before = [deck(tmp_path, f"b{i}", p, frequencies(p, ITEM), i, ITEM) for i, p in enumerate(PLACES[:6])]
    later = [deck(tmp_path, f"d{i}", p, frequencies(p, ITEM, lost=0.2), 20 + i, ITEM) for i, p in enumerate(PLACES[:4])]
    changed = [part for each in later for part in ("--changed", each)]
    code, found = asked(tmp_path, *given(before, 4), *changed)
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["physics"], cause["site"]["text"]) == (1, "stiffness-loss", "spring 4")
    assert found["held_out"]["revised"]["rms_frequency_error"] < 0.001


def test_nothing_is_sought_behind_a_change_that_explains_all(tmp_path, monkeypatch):
    """All sets of what changed were sought a second time beside the one that was named, only to find that nothing remains."""
    ranked = []
    monkeypatch.setattr(diagnose, "rank", lambda *given, **more: ranked.append(given[0]) or rank(*given, **more))
    before = [deck(tmp_path, f"b{i}", p, frequencies(p, ITEM), i, ITEM) for i, p in enumerate(PLACES[:3])]
    later = [deck(tmp_path, f"d{i}", p, frequencies(p, ITEM, lost=0.2), 20 + i, ITEM) for i, p in enumerate(PLACES[:4])]
    code, found = asked(tmp_path, *before, *(part for each in later for part in ("--changed", each)))
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["physics"], cause["site"]["text"], len(ranked)) == (1, "stiffness-loss", "spring 4", 1)


@pytest.mark.parametrize(("lost", "at"), [(0.0, 4), (0.15, 3), (0.6, 6)])
def test_what_changed_in_a_model_that_errs(tmp_path, lost, at):
    """Springs scatter by some per cent, so that shapes err by ten times what sensors do, and alike before and after."""
    before, after = measured(tmp_path, "before", 1), measured(tmp_path, "after", 2, lost, at)
    out = tmp_path / "answer.json"
    code = _run(["diagnose", before, "--changed", after, "--common-sd", "2", "-q", "--report", str(out), "--json"])
    found = json.loads(out.read_text())
    if not lost:
        assert (code, found["verdict"]["kind"]) == (0, "nothing-missing")
        return
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["kind"], cause["physics"], cause["site"]["text"]) == (1, "named", "stiffness-loss", f"spring {at}")
    (size,) = found["turns"][0]["candidates"][0]["parameters"]
    assert abs(size["value"] - lost) < 3 * size["sd"] < 0.15


def test_errors_of_one_model_move_what_it_predicts_as_they_should(tmp_path):
    """Both before and after a spring loses half of its stiffness, by differences of exact solutions."""
    problems = [read_deck(measured(tmp_path, *each, errors=0)) for each in (("before", 1), ("after", 1, 0.5))]
    base = Arranged(tuple(reduced(each, each.prior.mean) for each in problems), 0.01, (False, True))
    recipe = next(each for each in base.recipes(registry()["stiffness-loss"]) if each.site(each.grid[0]).text == "spring 4")
    model = Together(base, (recipe,))
    at = model.point(np.concatenate([np.zeros(1), recipe.coordinates(np.array([0.5]))]))
    errors = Errors(model.modes(at), 0.01)
    unit = np.random.default_rng(3).standard_normal((N, N)) * 1e-4
    given, U = base.parts[0].eigenvalues, errors.U
    i, j = np.triu_indices(N)
    E = np.zeros((N, N))
    E[i, j] = E[j, i] = unit[i, j] * np.sqrt(2 * given[i] * given[j]) * 0.01
    E[np.diag_indices(N)] *= np.sqrt(2)
    diagonal = np.flatnonzero((i == j) & (i < 5))  # frequencies of the five measured modes come first
    order = np.concatenate([diagonal, np.setdiff1d(np.arange(len(i)), diagonal)])
    for own, (one, point), part in zip(U, model.parts(at), base.parts, strict=True):
        there = one.added(point.x)[0] + np.diag(given) + E
        values, shapes = np.linalg.eigh(there)
        shapes *= np.sign(np.einsum("ab,ab->b", shapes, point.X))
        data = part.data
        left, _ = data.residual(values[:5], part.sensing @ shapes[:, :5])
        assert left - point.residual == pytest.approx(-own @ unit[i, j][order], abs=2e-3 * np.abs(own @ unit[i, j][order]).max())


@pytest.fixture
def arranged(tmp_path):
    problems = [read_deck(deck(tmp_path, f"e{i}", p, frequencies(p), i)) for i, p in enumerate(PLACES[:4])]
    parts = tuple(reduced(each, each.prior.mean) for each in problems)
    return Arranged(parts[:3], 0.003, (True,) * 3), Arranged(parts[3:], 0.003, (True,))


def test_whitening_is_that_of_the_covariance(arranged):
    base, _ = arranged
    U = np.vstack(base.errors.U)
    values = np.random.default_rng(1).standard_normal((len(U), 3))
    white = base.errors.whitened(values)
    assert white.T @ white == pytest.approx(values.T @ np.linalg.solve(np.eye(len(U)) + U @ U.T, values), rel=1e-10)


def test_predictions_are_those_of_the_joint_distribution(arranged):
    """p(held | fitted) by conditioning the Gaussian of all data, linear in the parameters, written out."""
    base, held = arranged
    one = fit(Together(base), np.zeros(0))
    there = Together(held).point(one.point.x)
    modes = np.arange(1, 6)
    T = one.model.slopes(one.point)
    U = np.vstack([of_frequencies(part.data, modes, 0.003) for part in base.parts])
    B = np.hstack([Together(held).slopes(there), np.vstack([of_frequencies(part.data, modes, 0.003) for part in held.parts])])
    A = np.hstack([T, U])  # all unknowns N(0, 1) before the test, about z = 0
    r = np.concatenate([at.residual for at in one.point.points]) + T @ one.point.x  # linearised about z = 0
    h = there.points[0].residual + B[:, :1] @ one.point.x
    S = np.eye(len(A)) + A @ A.T
    mean = B @ A.T @ np.linalg.solve(S, r)
    covariance = np.eye(len(B)) + B @ B.T - B @ A.T @ np.linalg.solve(S, A @ B.T)
    left = h - mean
    density = -0.5 * (left @ np.linalg.solve(covariance, left) + np.linalg.slogdet(covariance)[1])
    density -= sum(part.data.log_sd for part in held.parts)
    assert predicted(one, held).log_predictive_density == pytest.approx(density, rel=1e-6)


@pytest.mark.parametrize(
    ("change", "code", "told"),
    [
        (("sd: 3 %", "sd: 4 %"), "MD690", "parameters"),
        (("name: k,", "name: stiffness,"), "MD690", "parameters"),
        (("test:\n  modes:", "test:\n  hold_out: {modes: [5]}\n  modes:"), "MD691", "holds out"),
    ],
)
def test_decks_that_are_no_arrangements_are_refused(tmp_path, capsys, change, code, told):
    first, second = (deck(tmp_path, name, PLACES[0], frequencies(PLACES[0]), 1) for name in ("one", "two"))
    text = Path(second).read_text()
    assert change[0] in text
    Path(second).write_text(text.replace(*change))
    assert _run(["diagnose", first, second]) == 4
    said = capsys.readouterr().err
    assert code in said and told in said and "two.yaml:" in said


@pytest.mark.parametrize(
    "arguments",
    [
        ["--plot", "x.pdf"],
        ["-o", "one.yaml"],
        ["--changed", "two.yaml", "--held-out", "two.yaml"],
        ["./one.yaml"],
        ["--held-out", "one.yaml"],
    ],
)
def test_what_has_no_meaning_for_arrangements_is_refused(tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    for name in ("one", "two", "three"):
        deck(tmp_path, name, PLACES[0], frequencies(PLACES[0]), 1)
    assert _run(["diagnose", "one.yaml", "three.yaml", *arguments]) == 2


def test_a_deck_that_changed_may_be_among_the_others():
    """It was a third configuration, and counted twice."""
    apart, among = (Named.of(decks, (), ("two.yaml",)) for decks in (("one.yaml",), ("one.yaml", "./two.yaml")))
    assert apart.having(apart.fitted) == among.having(among.fitted) == (False, True)
    assert len(apart.fitted) == len(among.fitted) == 2


@pytest.mark.proof
def test_a_step_that_leaves_too_much_is_no_name(tmp_path):
    """Items and a spring to the ground where only springs may be named: with one in the model far more is left than noise."""
    decks = [deck(tmp_path, f"n{i}", p, frequencies(p, ITEM, 3e4), i) for i, p in enumerate(PLACES[:6])]
    _, found = asked(tmp_path, *decks, "--candidates", "ground-spring")
    assert found["verdict"]["kind"] == "unknown"
    assert found["turns"] and all(cause["kind"] != "named" for cause in found["verdict"]["causes"])


def test_what_lasts_is_no_change():
    """The mass of sensors was in four of seven that led, between two tests of one tower."""
    every, some = Sought(Choices(), None), Sought(Choices(("sensor-mass", "mass")), None)
    assert set(every.known(False)) == {key for key, one in registry().items() if not one.between} == set(registry()) - {"parameter"}
    lasting = {"sensor-mass", "gravity", "timoshenko", "taper"}
    assert not lasting & set(every.known(True)) and {"mass", "crack", "brace", "parameter"} < set(every.known(True))
    assert set(some.known(True)) == {"sensor-mass", "mass"}
