"""Mechanisms that most explanations share: rankings made up here."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from made_up_rankings import BEAM, made_up, ranked
from scipy.stats import binom

from mouse_cli.diagnosis import verdict as decided
from mouse_cli.diagnosis.companions import loose, shared
from mouse_cli.diagnosis.effects.change import PLACE, Unknown
from mouse_cli.diagnosis.verdict import decide
from mouse_cli.model.diagnosis import (
    BY_DECK,
    BY_MODE,
    NAMED,
    ONE_OF,
    UNKNOWN,
    Cause,
    Diagnosis,
    Explanation,
    HeldOut,
    Site,
)
from mouse_cli.model.prediction import Score
from mouse_cli.report.verdict_sentences import sentences


@pytest.fixture(autouse=True)
def _without_modes(monkeypatch):
    """Fits made up here have no modes that could be unmeasured."""
    monkeypatch.setattr(decided, "unmeasured_hz", lambda one: ())


BARE = made_up(misfit=25.0)


def found(*fits, p):
    return shared(ranked(*fits, BARE, p=p), fits[0])


def test_a_crack_that_all_share_is_certain_and_its_companion_open():
    """No group has 0.9, the crack has 0.98: at 0.40, 0.41 and 0.42 m it is one crack."""
    fits = made_up("crack@0.40", "gravity"), made_up("axial", "crack@0.41"), made_up("crack@0.42")
    one = found(*fits, p=(0.46, 0.3, 0.22, 0.02))
    assert one.which == (0,) and one.probability == pytest.approx(0.98)
    assert dict(one.members) == {"crack": 1.0}
    assert [name for name, _ in one.companions] == ["gravity", "axial", "none"]
    assert dict(one.companions)["none"] == pytest.approx(0.22 / 0.98)
    assert decide(ranked(*fits, BARE, p=(0.46, 0.3, 0.22, 0.02)))[0] == NAMED


@pytest.mark.parametrize(("p", "enough"), [((0.5, 0.46, 0.04), False), ((0.5, 0.48, 0.02), True), ((0.95, 0.005, 0.045), True)])
def test_what_acts_beside_open_companions_takes_more(p, enough):
    """0.96 in two sets neither of which is sure is no name; 0.98 is, and so is 0.955 where the companion is as sure."""
    fits = made_up("crack@0.40", "gravity"), made_up("crack@0.41", "axial")
    assert (found(*fits, p=p) is not None) == enough


def test_cracks_elsewhere_are_not_the_same():
    """Neither another fit that has it 0.1 of the span away, nor the share of a fit that stands at a rival site."""
    fits = made_up("crack@0.40", "gravity"), made_up("axial", "crack@0.50"), made_up("crack@0.42")
    assert found(*fits, p=(0.46, 0.3, 0.22, 0.02)) is None
    assert decide(ranked(*fits, BARE, p=(0.46, 0.3, 0.22, 0.02)))[0] == ONE_OF
    alone = made_up("crack@0.42", elsewhere=((made_up("crack@0.9"), 0.5),))
    one = found(made_up("crack@0.40", "gravity"), alone, p=(0.75, 0.22, 0.03))
    assert one is None
    assert found(made_up("crack@0.40", "gravity"), made_up("crack@0.42"), p=(0.75, 0.22, 0.03)) is not None


def test_as_many_as_are_certain_are_named():
    """Crack and mass in all; one crack is not two."""
    fits = made_up("crack@0.4", "mass@0.7", "axial"), made_up("crack@0.4", "mass@0.7")
    one = found(*fits, p=(0.6, 0.37, 0.03))
    assert one.which == (0, 1) and [name for name, _ in one.companions] == ["axial", "none"]
    twice = made_up("crack@0.4", "crack@0.4"), made_up("crack@0.4")
    assert len(found(*twice, p=(0.6, 0.37, 0.03)).which) == 1


def test_two_of_one_kind_share_as_any_two():
    """Their names do not tell their order, and their sites have none."""
    fits = made_up("mass@0.2", "mass@0.7", "axial"), made_up("mass@0.2", "mass@0.7")
    one = found(*fits, p=(0.6, 0.37, 0.03))
    assert one.which == (0, 1) and dict(one.members) == {"mass + mass": 1.0}


def test_what_has_no_name_does_not_share():
    fits = made_up("crack@0.4", "gravity"), made_up(nameless="field-bed"), made_up("crack@0.4")
    assert found(*fits, p=(0.45, 0.2, 0.32, 0.03)) is None


def test_a_certain_mechanism_has_to_explain():
    """What leads leaves too much: no name, whatever is shared."""
    fits = made_up("crack@0.4", "gravity", misfit=60.0), made_up("crack@0.4", "axial", misfit=60.0)
    assert decide(ranked(*fits, BARE, p=(0.6, 0.37, 0.03)))[0] not in (NAMED, ONE_OF)


def test_sites_without_coordinates_are_the_same_by_their_numbers():
    one, other = made_up("mass", "axial"), made_up("mass")
    assert found(one, other, p=(0.6, 0.37, 0.03)).probability == pytest.approx(0.97)


@pytest.mark.parametrize(("sd", "loose_"), [(0.0255, False), (0.0256, True)])
def test_a_place_is_as_certain_as_a_name_or_is_said_to_be_less(sd, loose_):
    """0.95 of a Gaussian is within 1.95996 standard deviations (tables), and 0.05 of the span of 1 m is as near as one site."""
    unknowns = (Unknown("mass", "kg", 0.1, 10.0), Unknown(PLACE, "m", 0.0, 0.8, log=False))
    recipe = SimpleNamespace(candidate=SimpleNamespace(title="a lumped mass"), unknowns=unknowns)
    model = SimpleNamespace(k=1, own=[slice(0, 2)], base=SimpleNamespace(problem=SimpleNamespace(structure=BEAM)))
    one = SimpleNamespace(recipes=(recipe,), model=model, covariance=np.diag([1.0, 4.0, sd**2]))
    assert loose(one) == ((("a lumped mass", pytest.approx(sd)),) if loose_ else ())
    assert loose(one, which=(1,)) == ()
    cause = Cause("mass", "mass", "a lumped mass", Site("node", (), (0.4, 0.0, 0.0), "x = 0.4"), ())
    told = (Explanation((cause,), 20.0, 20, 0.5, 0.0, np.zeros(1), 1.0),)
    problem = SimpleNamespace(units=SimpleNamespace(of=str))
    answer = Diagnosis(problem, NAMED, None, None, told, (("mass", 1.0),), loose=loose(one))
    said = [text for text in sentences(answer) if "position is less certain" in text]
    assert bool(said) == loose_ and all("0.026" in text for text in said)


@pytest.mark.parametrize("share", [0.6, 0.04])
def test_of_a_set_those_are_named_whose_sites_are_sure(monkeypatch, share):
    """A mass at 0.7, and a spring at 0.2 or, with `share` of the evidence, at 0.4: the mass is certain, its companion is where?"""
    monkeypatch.setattr(decided, "held_out", lambda *given: None)
    monkeypatch.setattr(decided, "doubtful", lambda *given: True)
    other = made_up("mass@0.7", "ground-spring@0.4")
    best = made_up("mass@0.7", "ground-spring@0.2", elsewhere=((other, share),))
    verdict = decided.judge(ranked(best, BARE, p=(0.999, 0.001)), True, None)
    assert (verdict.kind, verdict.placed) == (NAMED, True)
    if share > 0.05:
        assert verdict.certain.which == (0,) and dict(verdict.certain.companions) == {"ground-spring": 1.0}
    else:
        assert verdict.certain is None


def test_a_set_of_which_no_site_is_sure_is_at_one_of_several(monkeypatch):
    monkeypatch.setattr(decided, "held_out", lambda *given: None)
    monkeypatch.setattr(decided, "doubtful", lambda *given: True)
    best = made_up("mass@0.7", elsewhere=((made_up("mass@0.2"), 0.5),))
    verdict = decided.judge(ranked(best, BARE, p=(0.999, 0.001)), True, None)
    assert (verdict.kind, verdict.placed, verdict.certain) == (ONE_OF, False, None)


def proof_of(kind: str, covered: float, p: float) -> HeldOut:
    """Eight frequencies that were predicted better with a set of mechanisms, that share of them within their intervals."""
    score = lambda density, covered, p: Score(0.01, density, covered, np.ones(8), np.ones(8), np.ones(8), p=p)
    labels = tuple(f"mode {number}" for number in range(1, 9))
    return HeldOut(kind, labels, np.ones(8), score(-900.0, 0.0, 0.0), score(-90.0, covered, p))


@pytest.mark.parametrize(("within", "refuted"), [(3, True), (4, False), (8, False)])
def test_modes_refute_what_hardly_one_of_them_is_predicted_by(within, refuted):
    """Of eight at most three, by chance in one of 2,300; their misfit has no p-value."""
    proof = proof_of(BY_MODE, within / 8, float("nan"))
    assert proof.refuted == refuted and proof.p == pytest.approx(binom.cdf(within, 8, 0.9))
    assert not proof_of(BY_DECK, within / 8, 0.01).refuted


@pytest.mark.parametrize(("number", "share", "narrow"), [(4, 0.5, False), (4, 0.25, True), (20, 0.65, True)])
def test_intervals_are_too_narrow_where_so_few_would_hardly_lie_within(number, share, narrow):
    proof = replace(proof_of(BY_DECK, share, 0.5), measured_hz=np.append(np.ones(number), np.nan))
    assert (proof.within < 0.01) == narrow


@pytest.mark.parametrize("proof", [proof_of(BY_DECK, 1.0, 1e-9), proof_of(BY_MODE, 0.375, float("nan"))])
@pytest.mark.parametrize(("alone", "named"), [(100.0, True), (900.0, False)])
def test_of_a_set_that_what_is_held_out_refutes_only_that_is_named_which_carries_it(monkeypatch, alone, named, proof):
    """A foot leaves a tenth of the misfit, or nearly all of it: what was put beside it is open, or nothing has a name."""
    monkeypatch.setattr(decided, "held_out", lambda *given: proof)
    monkeypatch.setattr(decided, "averaged", lambda *given: None)
    monkeypatch.setattr(decided, "doubtful", lambda *given: True)
    best = made_up("support@0.0", "local-stiffness@0.6")
    foot, none = made_up("support@0.0", misfit=alone), made_up(misfit=1000.0)
    verdict = decided.judge(ranked(best, foot, none, p=(0.998, 0.001, 0.001)), True, None)
    assert verdict.kind == (NAMED if named else UNKNOWN)
    if named:
        assert verdict.certain.which == (0,) and dict(verdict.certain.companions)["local-stiffness"] > 0.99
    else:
        assert verdict.refuted == ("local-stiffness + support",)
