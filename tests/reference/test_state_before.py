"""What the state before says of theory: by the density written out, and in diagnoses of chains whose springs scatter."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from mouse_cli.cli.main import _run
from mouse_cli.diagnosis.likelihoods.configurations import changes, diagnose
from mouse_cli.diagnosis.likelihoods.configurations.diagnose import Decks
from mouse_cli.diagnosis.likelihoods.configurations.erring import _evidence, before
from mouse_cli.diagnosis.likelihoods.configurations.model import Arranged
from mouse_cli.diagnosis.likelihoods.configurations.shared import Errors
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.formats import read_deck
from mouse_cli.report import arrangements_sentences
from tests.reference.test_arrangements import MASS, SENSORS, K, N, measured


def arranged(folder, tau: float) -> Arranged:
    """A chain before and after a spring has lost a fifth of its stiffness."""
    paths = measured(folder, "before", 1), measured(folder, "after", 2, 0.2)
    problems = map(read_deck, paths)
    return Arranged(tuple(reduced(each, each.prior.mean) for each in problems), tau, (False, True))


def test_the_evidence_is_the_density_of_the_tests_before(tmp_path):
    """Linear in the one parameter, about the value at which the tests are most probable."""
    base = arranged(tmp_path, 0.02)
    model, U = Model(base.parts[0]), Errors(base.errors.modes, 0.02).U[0]
    z = 0.0
    for _ in range(20):
        at = model.point(np.array([z]))
        T = model.jacobian(at)
        r, S = at.residual + T[:, 0] * z, np.eye(len(T)) + T @ T.T + U @ U.T
        z = float(T[:, 0] @ np.linalg.solve(S, r))
    density = multivariate_normal(np.zeros(len(r)), S).logpdf(r) + len(r) / 2 * np.log(2 * np.pi)
    found, chi2 = _evidence(base, [0], 0.02)
    assert found == pytest.approx(density, abs=1e-3) and chi2 == pytest.approx(r @ np.linalg.solve(S, r), rel=1e-3)


@pytest.mark.parametrize(("stated", "least", "most"), [(0.02, 1.0, 1.5), (0.001, 3.0, 8.0)])
def test_theory_errs_as_much_as_the_state_before_asks(tmp_path, stated, least, most):
    """Springs scatter by 3 %: in a mode, which averages over all of them, that is less than 1 % of ln f."""
    found = before(arranged(tmp_path, stated))
    assert least <= found.tau / stated <= most and found.explained
    assert bool(found.remarks) == (found.tau != stated)


def test_what_the_change_does_says_nothing_of_theory(tmp_path):
    base = arranged(tmp_path, 0.02)
    other = read_deck(measured(tmp_path, "later", 3, 0.8))
    parts = base.parts[0], reduced(other, other.prior.mean)
    assert before(Arranged(parts, 0.02, (False, True))) == before(base)
    assert before(Arranged(parts, 0.02, (True, True))) is None


OTHER_MASSES = "nodes: 1-8, mass: [9, 1, 1, 0.1, 5, 1, 0.2, 1]"


def edited(path: str, *change: str) -> None:
    """The deck with one text for another."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    assert change[0] in text
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace(*change))


def answered(folder, *decks: str, more: tuple[str, ...] = ()) -> tuple[int, dict]:
    out = folder / "answer.json"
    code = _run(["diagnose", decks[0], "--changed", decks[1], "-q", "--report", str(out), "--json", *more])
    return code, json.loads(out.read_text())


def test_nothing_is_sought_in_a_model_that_explains_nothing(tmp_path, monkeypatch):
    """Masses that are other ones altogether: no size of errors of theory makes that."""
    monkeypatch.setattr(diagnose, "rank", None)  # of configurations
    decks = [measured(tmp_path, *each) for each in (("before", 1), ("after", 2, 0.3))]
    for path in decks:
        edited(path, "nodes: 1-8, mass: 1.0", OTHER_MASSES)
    code, found = answered(tmp_path, *decks, more=("--candidates", "stiffness-loss,ground-spring", "--causes", "1"))
    assert (code, found["verdict"]["kind"], found["turns"]) == (1, "unknown", [])
    assert not found["state"]["in_all_decks"]
    said = found["verdict"]["sentences"]
    assert "does not explain the state before" in said[0] and any("No change was sought" in each for each in said)


def test_of_several_decks_before_one_is_to_be_diagnosed(tmp_path, monkeypatch):
    monkeypatch.setattr(diagnose, "rank", None)
    decks = [measured(tmp_path, *each) for each in (("before", 1), ("after", 2, 0.3), ("again", 3))]
    for path in decks:
        edited(path, "nodes: 1-8, mass: 1.0", OTHER_MASSES)
    _, found = answered(tmp_path, *decks[:2], more=(decks[2],))
    assert found["state"] is None and any("Diagnose one of the decks before" in each for each in found["verdict"]["sentences"])


def test_decks_of_which_one_is_no_structure_are_refused(tmp_path, monkeypatch):
    def fails(deck):
        raise np.linalg.LinAlgError("not positive definite")

    monkeypatch.setattr(diagnose, "meshed", fails)
    assert _run(["diagnose", measured(tmp_path, "before", 1), "--changed", measured(tmp_path, "after", 2, 0.3), "-q"]) == 5


def test_more_than_scatter_is_to_be_found_first(tmp_path):
    """A node that stands on a spring in both states, which is not in the model."""
    base = arranged(tmp_path, 0.01)
    assert before(base).explained
    stiff = K * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
    stiff[-1, -1] = K
    stiff[5, 5] += 0.5 * K
    values, shapes = np.linalg.eigh(stiff)
    test = base.parts[0].data.test
    seen = shapes[np.array(SENSORS) - 1, :5]
    there = replace(test, frequency_hz=np.sqrt(values[:5] / MASS) / (2 * np.pi), shapes=seen / np.abs(seen).max(axis=0))
    held = replace(base, parts=(base.parts[0].with_test(there), base.parts[1]))
    found = before(held)
    assert not found.explained and "No change was sought" in found.refused


def grounded(folder, name: str, seed: int, lost: float = 0.0) -> str:
    """A deck of a chain that stands on a spring at node 6 in both states, with a test that is as accurate as it says."""
    return measured(folder, name, seed, lost, 3, errors=0.1, ground=0.3 * K)


def test_what_the_state_before_lacks_is_found_first_and_the_change_beside_it(tmp_path):
    decks = grounded(tmp_path, "before", 1), grounded(tmp_path, "after", 2, 0.4)
    revised = tmp_path / "revised"
    code, found = answered(tmp_path, *decks, more=("-o", str(revised)))
    state = found["state"]
    assert state["in_all_decks"] and state["verdict"]["kind"] == "named"
    assert (state["verdict"]["physics"], state["verdict"]["site"]["ids"]) == ("ground-spring", ["6TX"])
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["kind"], cause["physics"], cause["site"]["text"]) == (1, "named", "stiffness-loss", "spring 3")
    sentences = found["verdict"]["sentences"]
    assert sentences[0].startswith("The model does not explain the state before. Diagnosed by itself: The model lacks")
    first, then = (read_deck(revised / f"{name}.yaml") for name in ("before", "after"))
    assert len(then.parameters) == len(first.parameters) + 1 == 3


def test_only_what_is_certain_of_the_state_before_goes_into_all_decks(tmp_path):
    """What may act beside it is sought with the change."""
    decks = [read_deck(grounded(tmp_path, *each)) for each in (("before", 1), ("after", 2, 0.4))]
    model = reduced(decks[0], decks[0].prior.mean)
    recipes = tuple(each.recipes(model, each)[0] for each in map(registry().get, ("mass", "ground-spring")))
    both = fit(Model(model, recipes), np.array([0.5, 0.5]))
    parts = Decks(tuple(decks), (False, True), 0.01)
    names = lambda found: [parameter.name for parameter in found.problems[1].parameters[1:]]
    mass, spring = names(changes._with(parts, both, None))
    assert names(changes._with(parts, both, (1,))) == [spring] != [mass]


@pytest.mark.parametrize(("kind", "said"), [("named", "No change was sought beside that"), ("one-of", "is not settled")])
def test_a_change_that_is_not_sought_says_why(tmp_path, monkeypatch, kind, said):
    """Beside what has a name, and yet does not leave a model of the state before; and beside what has none."""
    monkeypatch.setattr(diagnose, "rank", None)
    monkeypatch.setattr(changes, "_of_before", lambda *args: (SimpleNamespace(kind=kind), None))
    monkeypatch.setattr(arrangements_sentences, "of_one", lambda state: ["It lacks this."])
    decks = [measured(tmp_path, *each) for each in (("before", 1), ("after", 2, 0.3))]
    for path in decks:
        edited(path, "nodes: 1-8, mass: 1.0", OTHER_MASSES)
    found = changes.diagnose_changes(Decks(tuple(map(read_deck, decks)), (False, True), 0.01), Decks((), (), 0.01))
    text = " ".join(arrangements_sentences.sentences(found))
    assert said in text and found.shared == () and "Diagnose one of the decks before" not in text


def test_a_change_is_named_where_theory_errs_far_more_than_stated(tmp_path):
    decks = [measured(tmp_path, *each) for each in (("before", 1), ("after", 2, 0.6, 6))]
    code, found = answered(tmp_path, *decks, more=("--common-sd", "0.1"))
    (cause,) = found["verdict"]["causes"]
    assert (code, cause["kind"], cause["physics"], cause["site"]["text"]) == (1, "named", "stiffness-loss", "spring 6")
    assert found["common_sd"] >= 0.003
    assert any("that is allowed for" in text for text in found["remarks"])
