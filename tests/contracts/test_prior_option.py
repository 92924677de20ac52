"""--prior: the posterior of one test is the prior of the next; checked by precisions that add up."""

import json

import numpy as np
import pytest

from mouse_cli.cli.main import _run

# lambda = k/m is linear in k, so that Gauss-Newton is exact: precisions add up, and means are weighed by them
ENTRIES = """mouse: 1
title: One mass on a spring
model: {{stiffness: {{dense: [[50000]]}}, mass: {{dense: [[2]]}}}}
parameters: [{{name: k, nominal: 50000, sd: 5000, stiffness: [[1, 1, 1]]}}]
test: {{modes: {{frequency: [{hz}], frequency_sd: {sd}}}}}
run: {{recursion: anchored}}
"""
ELEMENTS = """mouse: 1
title: One mass on a spring
model:
  structure:
    nodes: {{1: [0, 0, 0]}}
    elements:
      - {{id: 1, type: spring, nodes: [1], TX: 50000}}
      - {{id: 2, type: mass, nodes: [1], mass: 2}}
    directions: [TX]
parameters: [{{name: k, elements: 1, property: TX, sd: 5000}}]
test: {{modes: {{frequency: [{hz}], frequency_sd: {sd}}}}}
run: {{recursion: anchored}}
"""
TESTS = ((26.0, 0.3), (25.4, 0.2), (25.7, 0.25))


def run(folder, *arguments: str) -> dict:
    """The JSON document of `mouse run`."""
    assert _run(["run", *arguments, "--json", "-q", "-o", str(folder / "out.json")]) == 0
    return json.loads((folder / "out.json").read_text())


def weighed(tests, variance=5000.0**2, mean=50000.0, loosened=0.0):
    """Mean and sd of k by hand: each test gives k = 2 (2 pi f)^2 with sd 2 k sd(f)/f."""
    for i, (hz, sd) in enumerate(tests):
        variance += loosened**2 if i else 0.0
        value = 2 * (2 * np.pi * hz) ** 2
        own = (2 * value * sd / hz) ** 2
        mean, variance = (mean / variance + value / own) / (1 / variance + 1 / own), 1 / (1 / variance + 1 / own)
    return mean, np.sqrt(variance)


@pytest.fixture(params=[ENTRIES, ELEMENTS], ids=["entries", "elements"])
def decks(request, tmp_path):
    """Three decks that differ in their test alone."""
    for i, (hz, sd) in enumerate(TESTS):
        (tmp_path / f"{i}.yaml").write_text(request.param.format(hz=hz, sd=sd))
    return tmp_path


def sequence(folder, *more: str) -> dict:
    """What is left after all tests, one after another."""
    found = run(folder, str(folder / "0.yaml"))
    for i in range(1, len(TESTS)):
        (folder / "before.json").write_text(json.dumps(found))
        found = run(folder, str(folder / f"{i}.yaml"), "--prior", str(folder / "before.json"), *more)
    return found


def test_precisions_add_up(decks):
    found = sequence(decks)["parameters"][0]
    mean, sd = weighed(TESTS)
    assert found["posterior"] == pytest.approx(mean, rel=1e-9)
    assert found["posterior_sd"] == pytest.approx(sd, rel=1e-9)


def test_what_may_have_changed_is_added_to_the_variance(decks):
    found = sequence(decks, "--loosen", "k=1500")["parameters"][0]
    mean, sd = weighed(TESTS, loosened=1500.0)
    assert found["posterior"] == pytest.approx(mean, rel=1e-9)
    assert found["posterior_sd"] == pytest.approx(sd, rel=1e-9)


def test_modes_are_foreseen_from_the_earlier_test(decks):
    (decks / "first.json").write_text(json.dumps(run(decks, str(decks / "0.yaml"))))
    out = decks / "modes.json"
    assert _run(["modes", str(decks / "1.yaml"), "--prior", str(decks / "first.json"), "--json", "-o", str(out)]) == 0
    mean, sd = weighed(TESTS[:1])
    mode = json.loads(out.read_text())["modes"][0]
    assert mode["hz"] == pytest.approx(np.sqrt(mean / 2) / 2 / np.pi, rel=1e-9)
    assert mode["sd_hz"] == pytest.approx(mode["hz"] * sd / mean / 2, rel=1e-6)


def test_a_converted_deck_holds_the_prior(decks):
    (decks / "first.json").write_text(json.dumps(run(decks, str(decks / "0.yaml"))))
    made = decks / "next.yaml"
    assert _run(["convert", str(decks / "1.yaml"), "--prior", str(decks / "first.json"), "-o", str(made)]) == 0
    mean, sd = weighed(TESTS[:2])
    found = run(decks, str(made))["parameters"][0]
    assert found["posterior"] == pytest.approx(mean, rel=1e-9)
    assert found["posterior_sd"] == pytest.approx(sd, rel=1e-9)


def test_correlations_are_taken_over(tmp_path):
    """Two springs in series, of which one frequency knows the sum of compliances only: what is left of it is correlated."""
    deck = """mouse: 1
title: Two springs in a row
model:
  structure:
    nodes: {{0: [0, 0, 0], 1: [1, 0, 0], 2: [2, 0, 0]}}
    elements:
      - {{id: 1, type: spring, nodes: [0, 1], TX: 1000}}
      - {{id: 2, type: spring, nodes: [1, 2], TX: 2000}}
      - {{id: 3-4, type: mass, nodes: [1, 2], mass: 1}}
    supports: {{0: all}}
    directions: [TX]
parameters: [{parameters}]
test: {{modes: {{frequency: [{hz}], frequency_sd: 0.5 %}}}}
run: {{recursion: anchored}}
"""
    both = ["{name: a, elements: 1, property: TX, sd: 10 %}", "{name: b, elements: 2, property: TX, sd: 10 %}"]
    (tmp_path / "0.yaml").write_text(deck.format(parameters=", ".join(both), hz=3.3))
    first = run(tmp_path, str(tmp_path / "0.yaml"))
    assert (
        abs(first["covariance"][0][1])
        > 0.1 * first["parameters"][0]["posterior_sd"] * first["parameters"][1]["posterior_sd"]
    )
    (tmp_path / "first.json").write_text(json.dumps(first))
    third = "{name: c, elements: 3-4, property: mass, sd: 1 %}"
    (tmp_path / "1.yaml").write_text(deck.format(parameters=", ".join([both[1], third, both[0]]), hz=3.4))
    made = tmp_path / "next.yaml"
    assert _run(["convert", str(tmp_path / "1.yaml"), "--prior", str(tmp_path / "first.json"), "-o", str(made)]) == 0
    from mouse_cli.formats import read_deck

    prior = read_deck(made).prior
    expected = np.zeros((3, 3))
    expected[np.ix_([2, 0], [2, 0])] = first["covariance"]
    expected[1, 1] = 0.01**2
    np.testing.assert_allclose(prior.dense(), expected, rtol=1e-9, atol=1e-12)


def rejected(capsys, *arguments: str) -> str:
    """What standard error says of arguments that are refused."""
    assert _run(list(arguments)) == 4
    return capsys.readouterr().err


def test_the_same_data_are_not_used_twice(decks, capsys):
    deck = str(decks / "0.yaml")
    run(decks, deck)
    assert "MD442" in rejected(capsys, "run", deck, "--prior", str(decks / "out.json"))


def test_what_is_no_result_is_refused(decks, capsys):
    deck, other = str(decks / "1.yaml"), decks / "other.json"
    for text in ("not JSON", "[1]", '{"schema": "mouse.modes/1"}'):
        other.write_text(text)
        assert "MD440" in rejected(capsys, "run", deck, "--prior", str(other))
    assert "MD440" in rejected(capsys, "run", deck, "--prior", str(decks / "absent.json"))


def test_names_have_to_agree(decks, capsys):
    found = run(decks, str(decks / "0.yaml"))
    deck, first = str(decks / "1.yaml"), decks / "first.json"
    first.write_text(json.dumps(found))
    assert "MD441" in rejected(capsys, "run", deck, "--prior", str(first), "--loosen", "c=3")
    found["parameters"][0]["name"] = "another"
    first.write_text(json.dumps(found))
    assert "MD441" in rejected(capsys, "run", deck, "--prior", str(first))


def test_a_limit_and_a_missing_covariance_are_refused(decks, capsys):
    found = run(decks, str(decks / "0.yaml"))
    deck, first = str(decks / "1.yaml"), decks / "first.json"
    for change in ({"covariance": None}, {"parameters": [found["parameters"][0] | {"at_limit": True}]}):
        first.write_text(json.dumps(found | change))
        assert "MD440" in rejected(capsys, "run", deck, "--prior", str(first))


def test_an_untrusted_result_is_taken_with_a_warning(decks, capsys):
    found = run(decks, str(decks / "0.yaml"))
    first = decks / "first.json"
    first.write_text(json.dumps(found | {"exit_code": 1, "message": "The cycles did not converge."}))
    assert _run(["run", str(decks / "1.yaml"), "--prior", str(first)]) == 0
    assert "MD443" in capsys.readouterr().err


@pytest.mark.parametrize("loosen", ["k", "k=-1", "k=nan", "k=1e308", "=3", "k=x"])
def test_loosen_is_a_name_and_a_number(decks, loosen):
    (decks / "first.json").write_text(json.dumps(run(decks, str(decks / "0.yaml"))))
    arguments = ["run", str(decks / "1.yaml"), "--prior", str(decks / "first.json"), "--loosen", loosen]
    assert _run(arguments) == 2


def test_loosen_needs_a_prior(decks):
    assert _run(["run", str(decks / "1.yaml"), "--loosen", "k=3"]) == 2
