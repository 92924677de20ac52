"""What a diagnosis by recordings may say: priors, held-out records and what a law leaves, judged as of every other test."""

import json
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.integrate import solve_ivp
from two_masses import linear, record

from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.likelihoods.history import shown as showing
from mouse_cli.diagnosis.likelihoods.history.order import alike
from mouse_cli.diagnosis.likelihoods.history.search import Weighed, _one_less, _quietly, doubled, plainest
from mouse_cli.diagnosis.likelihoods.history.shown import hidden, undamped
from mouse_cli.diagnosis.likelihoods.history.verdict import decided, far, ranked
from mouse_cli.formats import read_deck
from mouse_cli.model.diagnosis import Rest
from mouse_cli.model.record_diagnosis import AS_IT_IS, WITH_CAUSE, Noise, RecordScore
from mouse_cli.report.sections.records import _error, _proof
from mouse_cli.report.verdict_sentences import remains
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.adequacy import missing, shift_p, shifted, unlikely
from mouse_cli.updating.recordings.floors import floor
from mouse_cli.updating.recordings.free_force import Spectrum
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.regression import Regression, Start
from mouse_cli.updating.recordings.series import Series
from mouse_cli.updating.recordings.study import fitted, study
from mouse_cli.updating.recordings.uncertain import UNDAMPED, uncertain
from mouse_cli.updating.recordings.validation import ratio

MASSES = """  - {name: m1, nominal: 1.0, sd: 1 %, mass: [[1, 1, 1]]}
  - {name: m2, nominal: 1.0, sd: 1 %, mass: [[2, 2, 1]]}
test:"""


def softer(u, v):
    """The upper spring, 3e4 N/m, has lost 30 % of its stiffness."""
    return 0.3 * 3e4 * (u[1] - u[0]) * np.array([1.0, -1.0])


def edited(deck: str, pattern: str, by: str) -> str:
    path = Path(deck)
    path.write_text(re.sub(pattern, by, path.read_text()))
    return deck


def without_damping(deck: str) -> str:
    return edited(deck, r"  damping:.*\n", "")


def answer(deck: str, *options: str) -> dict:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", *options])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


@pytest.mark.proof
def test_parameters_pushed_out_of_their_prior_are_no_sound_model(tmp_path):
    """They fit the records to the noise: the misfit of the data alone sees nothing."""
    deck = edited(record(tmp_path, softer), "test:", MASSES)
    problem = read_deck(deck)
    own = study(problem, records(problem))
    baseline = fitted(own, None)
    assert not unlikely(baseline) and missing(baseline) and shift_p(baseline) < 1e-3
    assert far(baseline, 1.0)[0].startswith("k2 is -") and far(baseline, 1.0)[0].endswith("prior sd from its mean")
    assert np.abs(shifted(baseline, 100.0)).max() < np.abs(shifted(baseline)).max()
    found = answer(deck)
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", "spring")
    assert found["verdict"]["site"]["ids"] == [1, 2]
    size = found["candidates"][0]["parameters"][0]
    assert abs(size["value"] - 9000) < 3 * size["sd"]


def damped(u, v):
    """A dashpot between the masses: damping that modes alone do not have."""
    return 8.0 * (v[1] - v[0]) * np.array([-1.0, 1.0])


@pytest.mark.parametrize("law, kind", [(linear, "nothing-missing"), (damped, "nothing-missing"), (softer, "named")])
def test_a_deck_without_damping_is_judged_by_its_stiffness(tmp_path, law, kind):
    few = ("--causes", "1", "--candidates", "spring,dashpot,cubic,oscillator")
    assert answer(without_damping(record(tmp_path, law)), *few)["verdict"]["kind"] == kind


@pytest.mark.parametrize("missing_spring, physics", [(0.0, None), (4000.0, "spring")])
def test_damping_that_a_deck_leaves_out_has_no_name(tmp_path, missing_spring, physics):
    """The deck damps in proportion to stiffness alone; the structure in proportion to mass too, 1.5 % of the first mode."""
    law = lambda u, v: 3.0 * v + np.array([0.0, missing_spring * u[1]])
    found = answer(record(tmp_path, law))["verdict"]
    assert (found["kind"], found["physics"]) == ("named" if physics else "nothing-missing", physics)


@pytest.mark.parametrize("bare, least, left", [(True, 0.9, ["mass"]), (True, 0.1, None), (False, 0.9, None)])
def test_where_damping_is_assumed_a_dashpot_is_no_rival_of_what_explains_the_records(monkeypatch, bare, least, left):
    """Whether alone or beside a law; of a deck with damping, or where nothing else leaves noise, it stays."""
    monkeypatch.setattr(showing, "adequate", lambda one: one.p > 0.5)
    fits = [
        SimpleNamespace(
            p=p, hypothesis=SimpleNamespace(parts=[SimpleNamespace(law=SimpleNamespace(key=key)) for key in keys])
        )
        for p, keys in [(0.99, ["dashpot"]), (least, ["mass"]), (0.99, ["mass", "dashpot"])]
    ]
    dropped: dict[str, str] = {}
    found = undamped(SimpleNamespace(model=SimpleNamespace(bare=bare)), fits, dropped)
    assert found == (fits if left is None else fits[1:2])
    assert list(dropped) == ([] if left is None else ["dashpot"])


def test_assumed_damping_does_not_follow_the_stiffness(tmp_path):
    problem = read_deck(without_damping(record(tmp_path, linear)))
    model = uncertain(problem, 100.0, np.eye(2))
    z = np.zeros((2, model.linear.k))
    z[1, 0] = -8.0  # 40 % off the first spring
    _, C, K = model.linear.matrices(z)
    np.testing.assert_array_equal(C[0], C[1])
    assert K[1, 0, 0] < K[0, 0, 0] and model.linear.sound(z[1])
    modal = np.linalg.eigvals(np.linalg.solve(np.eye(2), K[0]))
    np.testing.assert_allclose(np.linalg.eigvals(C[0]).sum(), 2 * UNDAMPED * np.sqrt(modal).sum(), rtol=1e-9)


def test_stiffness_and_damping_stay_positive_at_any_distance(tmp_path):
    problem = read_deck(without_damping(record(tmp_path, linear)))
    linear_model = uncertain(problem, 100.0, np.eye(2)).linear
    z = np.zeros(linear_model.k)
    z[[i for i, name in enumerate(linear_model.names) if "mode" in name]] = -50.0
    _, C, _ = linear_model.matrices(z[None])
    assert np.linalg.eigvalsh(C[0]).min() > -1e-9
    z[0] = -61.9  # sd of 5 %: a spring that pushes
    assert not linear_model.sound(z)


def test_a_deck_without_parameters_is_diagnosed(tmp_path):
    deck = edited(record(tmp_path, linear), r"parameters:\n(  - .*\n)+", "")
    assert answer(deck)["verdict"]["kind"] == "nothing-missing"


DRIVE = """mouse: 1
model:
  stiffness: {order: 1, entries: []}
  mass: {diagonal: [10]}
  damping: {order: 1, entries: [[1, 1, 20]]}
test:
  recordings:
    - file: r.npz
      sample_rate: 256
      inputs: [{sensor: 1, channel: f, quantity: force, unit: N}]
      outputs: [{sensor: 1, channel: v, quantity: velocity, unit: m/s}]
"""


def drive(folder: Path, slip: float) -> str:
    """A mass that nothing holds, with dry friction."""
    rng, t = np.random.default_rng(5), np.arange(3072) / 256
    lines = np.fft.rfftfreq(len(t), 1 / 256)
    f = np.fft.irfft(
        np.where((lines > 0.3) & (lines < 8), np.exp(2j * np.pi * rng.uniform(size=len(lines))), 0), len(t)
    )
    f *= 30 / f.std()
    rhs = lambda s, y: [(np.interp(s, t, f) - 20 * y[0] - slip * np.tanh(y[0] / 1e-3)) / 10]
    v = solve_ivp(rhs, (0, t[-1]), [0.0], method="LSODA", t_eval=t, rtol=1e-8, atol=1e-10, max_step=2e-3).y[0]
    np.savez(folder / "r.npz", f=f, v=v + 0.01 * v.std() * rng.standard_normal(len(t)))
    (folder / "deck.yaml").write_text(DRIVE)
    return str(folder / "deck.yaml")


def test_dry_friction_of_a_mass_that_nothing_holds(tmp_path):
    found = answer(drive(tmp_path, 8.0), "--causes", "1", "--candidates", "friction,oscillator,cubic,dashpot")
    verdict, leader = found["verdict"], found["candidates"][0]
    assert (verdict["kind"], verdict["group"], verdict["site"]["ids"]) == ("named", "friction", [1])
    slip = next(one["value"] for one in leader["parameters"] if one["name"] == "slip force")
    assert slip == pytest.approx(8.0, rel=0.1)
    assert verdict["rest"] is None or verdict["rest"]["share"] < 0.1


def test_a_free_mass_lacks_nothing(tmp_path):
    assert answer(drive(tmp_path, 0.0))["verdict"]["kind"] == "nothing-missing"


def test_an_oscillator_slower_than_its_stretch_is_no_finding(tmp_path):
    problem = read_deck(record(tmp_path, linear))
    own = study(problem, records(problem))
    ground = next(place for place in own.places if place.ground)
    start = own.at(ground).best(registry()["oscillator"], 0)
    one = fitted(own, start)
    one.x[-3:] = np.log([0.05, 3.0, 0.02])
    assert hidden(one, 1.0) is None
    assert "longer than the stretch" in hidden(one, 0.3)[1]
    one.x[-3] = one.hypothesis.bounds[1][-3]
    assert "limit of its range" in hidden(one, 1.0)[1]


def test_noise_of_channels_is_no_error_of_a_model():
    """5 % of noise in both: the law takes nine tenths of the rest."""
    of = lambda with_, without: ratio(
        (
            RecordScore(
                "r",
                1.0,
                np.ones(1),
                {AS_IT_IS: np.hypot(0.05, [without]), WITH_CAUSE: np.hypot(0.05, [with_])},
                {},
                np.full(1, 0.05),
            ),
        )
    )
    assert of(0.004, 0.04) == pytest.approx(0.1, rel=1e-6)
    assert np.isnan(of(0.001, 0.002))
    assert of(0.06, 0.03) == pytest.approx(2.0, rel=1e-6)


def test_a_simulation_that_diverges_is_no_error_of_so_many_times():
    one = RecordScore("r", 1.0, np.ones(1), {AS_IT_IS: np.full(1, 0.05), WITH_CAUSE: np.full(1, np.inf)}, {}, None)
    found = replace(one, free=one.short)
    assert _proof(found) == "'r' from 5 % to divergence over 1 s, from 5 % to divergence over the whole."
    loud = replace(found, noise=0.3 * found.signal)  # a quiet end of a record, of which a model can explain little
    assert _proof(loud) == "'r' from 5 % to divergence over 1 s, from 5 % to divergence over the whole; noise alone is 30 %."
    assert _proof(replace(found, noise=0.09 * found.signal)) == _proof(found)
    rows = [[_error(part, name, 0) for name in (AS_IT_IS, WITH_CAUSE)] for part in (found.short, found.free)]
    assert rows == [["0.05", "diverges"]] * 2


def test_floor_of_a_spectrum_is_the_sd_of_white_noise():
    rng = np.random.default_rng(1)
    found = np.mean([floor(rng.standard_normal((4096, 3))) for _ in range(10)], axis=0)
    np.testing.assert_allclose(found, 1.0, rtol=0.03)


@pytest.mark.parametrize("samples", [1, 2, 40])
def test_a_few_samples_have_afloor(samples):
    assert np.isfinite(floor(np.random.default_rng(7).standard_normal((samples, 3)))).all()


def test_candidates_have_one_registry_of_names(tmp_path):
    """Options mean the same for every kind of data; what these data cannot show is refused with what they can."""
    deck = record(tmp_path, linear)
    found = answer(deck, "--candidates", "friction,mass")
    left = {one["physics"]: one["reason"] for one in found["verdict"]["untried"]}
    assert "cubic" in left and "friction" not in left and "left out" in left["cubic"]
    assert {"cubic", "gyroscopic"} == {
        one["physics"] for one in answer(deck, "--without", "cubic")["verdict"]["untried"]
    }
    for options in (("--candidates", "crack"), ("--without", "shear")):
        done = CliRunner().invoke(cli, ["diagnose", deck, "-q", *options])
        assert done.exit_code == 2 and "has no meaning for recordings" in done.output and "friction" in done.output
    modal = str(Path(__file__).parents[2] / "decks" / "ground_spring.yaml")
    done = CliRunner().invoke(cli, ["diagnose", modal, "-q", "--candidates", "friction"])
    assert done.exit_code == 2 and "has no meaning for modes" in done.output and "ground-spring" in done.output
    assert "friction" in CliRunner().invoke(cli, ["list", "candidates"]).output
    assert "Jenkins" in CliRunner().invoke(cli, ["explain", "friction"]).output


def turning(deck: str) -> str:
    """The same numbers as two discs on a shaft."""
    deck = edited(deck, "quantity: acceleration, unit: m/s2", "quantity: angular acceleration, unit: rad/s2")
    return edited(deck, "quantity: force, unit: N", "quantity: moment, unit: N m")


def test_rotations_and_moments_judge_as_check_says(tmp_path):
    deck = turning(record(tmp_path, linear))
    checked = CliRunner().invoke(cli, ["check", deck])
    assert checked.exit_code == 0 and "MD640" not in checked.stderr, checked.output
    assert answer(deck)["verdict"]["kind"] == "nothing-missing"


def test_check_says_that_records_without_force_cannot_judge(tmp_path):
    deck = edited(record(tmp_path, linear), "quantity: force, unit: N", "quantity: acceleration, unit: m/s2")
    checked = CliRunner().invoke(cli, ["check", deck])
    assert checked.exit_code == 0 and "MD640" in checked.stderr
    assert "MD640" in str(CliRunner().invoke(cli, ["diagnose", deck]).exception)


@pytest.fixture(scope="module")
def studied(tmp_path_factory):
    """A record with a cubic spring."""

    def law(u, v):
        F = 2e8 * (u[1] - u[0]) ** 3
        return np.array([-F, F])

    problem = read_deck(record(tmp_path_factory.mktemp("cubic"), law))
    return study(problem, records(problem))


@pytest.fixture(scope="module")
def weighed_laws(studied):
    """The model as it is, the law, and a rival at the same place."""
    at = studied.at(next(place for place in studied.places if not place.ground))
    return fitted(studied, None), *(fitted(studied, at.best(registry()[key], 0)) for key in ("cubic", "gap"))


def said(ratio: float, *fits):
    found = Weighed(fits[0], list(fits[1:]))
    return decided(ranked(found), found, ratio)


def test_a_law_that_takes_most_is_named_with_what_remains(weighed_laws):
    baseline, law, rival = weighed_laws
    partly = replace(law, misfit=0.1 * baseline.misfit)
    found = said(0.3, baseline, partly)
    assert found.kind == "named" and found.rest.share == pytest.approx(0.1, abs=0.03) and found.rest.p < 1e-3
    assert remains(Rest(0.09, 0.0)) == "9 % of the misfit remains, p < 1e-6"
    assert said(0.3, baseline, replace(law, misfit=0.6 * baseline.misfit)).kind == "unknown"
    as_good = replace(rival, misfit=partly.misfit, log_evidence=partly.log_evidence)
    assert said(0.3, baseline, partly, as_good).kind == "unknown"


def test_what_no_law_explains_is_judged_as_a_law_would_be(weighed_laws):
    """A sound record left 1.102 times the variance, no law had a log evidence over none, and something was said to be missing."""
    baseline, law, _ = weighed_laws
    sound = replace(baseline, misfit=1.3 * baseline.dof, x=0 * baseline.x)
    worse = replace(law, misfit=sound.misfit, log_evidence=sound.log_evidence - 10)
    assert said(1.0, sound, worse).kind == "nothing-missing"
    assert said(1.0, replace(sound, misfit=1.7 * baseline.dof), worse).kind == "unknown"
    found = Weighed(sound, [worse])
    assert decided(ranked(found), found, 1.0, whole=False).kind == "unknown"  # laws that were left out may explain it


def test_two_laws_or_a_mode_of_its_own_that_leave_something_are_no_name(weighed_laws):
    """Gyroscopic coupling was two oscillators, with 25 % of the misfit left and a probability above 0.999."""
    baseline, law, _ = weighed_laws
    here = law.hypothesis.place
    for hypothesis, key in ((law.hypothesis, "bilinear"), (baseline.hypothesis, "oscillator")):
        other = hypothesis.placed(here).at(registry()[key], 0)
        x = np.concatenate([law.x[: other.nuisances], other.mean[other.nuisances :]])
        partly = replace(law, hypothesis=other, x=x, covariance=np.eye(len(x)), misfit=0.1 * baseline.misfit)
        assert said(0.3, baseline, partly).kind == "unknown"


def test_a_law_that_pairs_hold_which_do_not_do_is_named_with_what_remains(weighed_laws):
    """Friction beside play in a shaft: fits of both ended beside the right play, and all of it was unknown."""
    baseline, law, _ = weighed_laws
    here = law.hypothesis.place
    there = replace(here, site=replace(here.site, text="elsewhere"))
    leaves = lambda misfit: {"misfit": misfit, "log_evidence": law.log_evidence - (misfit - law.misfit) / 2}
    partly = replace(law, **leaves(0.2 * baseline.misfit))

    def pair(first, misfit):
        other = first.placed(there).at(registry()["bilinear"], 0)
        x = np.concatenate([law.x[: other.nuisances], other.mean[other.nuisances :]])
        return replace(law, hypothesis=other, x=x, covariance=np.eye(len(x)), **leaves(misfit))

    held = pair(law.hypothesis, 0.05 * baseline.misfit)
    found = said(0.3, baseline, partly, held)
    assert found.kind == "named" and found.rest.share == pytest.approx(0.2, abs=0.03)
    assert said(0.3, baseline, partly, pair(law.hypothesis, law.misfit)).rest is None  # which explains the records
    elsewhere = pair(law.hypothesis.without_last.placed(there).at(registry()["gap"], 0), 0.05 * baseline.misfit)
    assert said(0.3, baseline, partly, held, elsewhere).kind == "unknown"  # another two leave as little without it


def test_a_law_that_explains_all_needs_no_second_one(studied, weighed_laws):
    """A stop in a ring-down was one stop and another of no size: what a pair gains is to be more than its law alone leaves out."""
    baseline, law, _ = weighed_laws
    there = replace(law.hypothesis.place, site=replace(law.hypothesis.place.site, text="elsewhere"))
    both = law.hypothesis.placed(there).at(registry()["bilinear"], 0)
    x = np.concatenate([law.x, both.mean[len(law.x) :]])
    pair = replace(law, hypothesis=both, x=x, covariance=np.eye(len(x)))
    groups = lambda gain: dict(ranked(Weighed(baseline, [law, replace(pair, log_evidence=law.log_evidence + gain)])).groups)
    assert set(groups(2.0)) == {"none", "smooth-stiffness"} and len(groups(20.0)) == 3
    (alone,) = _one_less(studied, pair)
    assert alone.hypothesis.parts == law.hypothesis.parts and alone.misfit == pytest.approx(law.misfit, rel=1e-2)


def test_laws_that_explain_the_records_by_parameters_far_off_give_way_to_those_that_do_not(weighed_laws):
    """Friction behind a spring, with a storey 12 sd off, left less than a spring that yields; each end of one fit counts once."""
    baseline, law, rival = weighed_laws
    x = np.concatenate([[-12.2], law.x[1:3], rival.x[3:]])
    strained = replace(rival, x=x, misfit=law.misfit, log_evidence=law.log_evidence + 900)
    assert strained.hypothesis is not law.hypothesis and far(strained, 1.0)
    assert said(0.3, baseline, law, strained).kind == "named" and said(0.3, baseline, strained).kind == "unknown"
    again = replace(law, log_evidence=law.log_evidence - 0.1)
    found = ranked(Weighed(baseline, [again, law]))
    assert len(found.fits) == 2 and any(one is law for one in found.fits)


def test_what_leaves_noise_with_strained_parameters_asks_for_a_second_law(weighed_laws):
    """A cubic spring beside a mass that the deck does not have, its masses 1 % sure: one of these was 9 sd off, and all unknown."""
    _, law, _ = weighed_laws
    quiet = Noise(np.ones(2), 0.0, 0.5, 0.0)
    assert _quietly(replace(law, x=0 * law.x), quiet) and not _quietly(law, None)
    assert not _quietly(replace(law, x=np.concatenate([[-9.0], law.x[1:]])), quiet)


def test_a_second_law_is_sought_beside_the_plainest_of_those_that_leave_alike(weighed_laws):
    """Microslip, with four sizes, left 1 % less than friction beside play, and cost ten times as much."""
    _, law, rival = weighed_laws
    assert len(rival.hypothesis.unknowns) > len(law.hypothesis.unknowns)
    less = lambda one, misfit: replace(one, misfit=misfit, x=0 * one.x)
    assert plainest([less(law, 1000.0), less(rival, 990.0)]).hypothesis is law.hypothesis
    assert plainest([less(law, 1000.0), less(rival, 700.0)]).hypothesis is rival.hypothesis


def test_what_predicts_worse_or_leaves_its_prior_is_no_name(weighed_laws):
    baseline, law, _ = weighed_laws
    assert said(0.3, baseline, law).kind == "named" and said(0.3, baseline, law).rest is None
    worse = said(1.2, baseline, law)
    assert worse.kind == "unknown" and worse.refuted == ("smooth-stiffness",) and "1.2 times" in worse.cautions[0]
    assert "whose simulation with it diverges" in said(np.inf, baseline, law).cautions[0]
    distant = said(0.3, baseline, replace(law, x=np.concatenate([[-6.3], law.x[1:]])))
    assert distant.kind == "unknown" and "k1 is -6.3 prior sd from its mean" in distant.cautions[0]


def test_two_laws_of_one_group_at_one_place_are_one(weighed_laws):
    """Dry friction with and without a spring before it slip alike: their forces add up to one, and no record tells their shares."""
    here = weighed_laws[1].hypothesis.place
    there = replace(here, site=replace(here.site, text="elsewhere"))
    first = weighed_laws[0].hypothesis.placed(here).at(registry()["coulomb"], 0)
    beside = lambda key, place: Start(first.placed(place).at(registry()[key], 0), np.zeros(0), 0.0)
    assert doubled(beside("coulomb", here)) and doubled(beside("friction", here))
    assert not doubled(beside("friction", there)) and not doubled(beside("spring", here))
    spring = lambda first, variant, place: Start(first.placed(place).at(registry()["spring"], variant), np.zeros(0), 0.0)
    for key, amounts in (("yielding", 0), ("friction", 1)):  # a part that yields and as much of a spring beside it is friction
        first = weighed_laws[0].hypothesis.placed(here).at(registry()[key], 0)
        assert [doubled(spring(first, i, here)) for i in (0, 1)] == [i == amounts for i in (0, 1)]
        assert not doubled(spring(first, amounts, there))
    first = weighed_laws[0].hypothesis.placed(here).at(registry()["cubic"], 0)  # the odd term of a series
    assert doubled(beside("cubic", here)) and not doubled(beside("quadratic", here))


def test_laws_like_one_that_is_adequate_are_fitted_too(weighed_laws):
    """Of noisy records an adequate law may be wrong: the same law elsewhere and other laws at its site are fitted before a name."""
    here = weighed_laws[1].hypothesis.place
    there = replace(here, site=replace(here.site, text="elsewhere"))
    bare = weighed_laws[0].hypothesis
    at = lambda key, place: Start(bare.placed(place).at(registry()[key], 0), np.zeros(0), 0.0)
    gap, cubic, far_gap, _ = order = [at(key, place) for place in (here, there) for key in ("gap", "cubic")]
    assert alike(order, [gap], ("gap", here.site.text)) == [cubic, far_gap]
    assert alike(order, [gap, cubic, far_gap], ("gap", here.site.text)) == []
    assert alike(order, [gap], ("gap", "nowhere")) == [far_gap]


def test_a_part_too_short_for_its_edges_keeps_no_sample(weighed_laws):
    """As of a stretch that figures show: its regression divided by the mean of nothing, and all that it found was nan."""
    base = weighed_laws[1].hypothesis.without_last  # with a place
    short, at = np.ones((40, 2)), np.eye(2)
    series = Series(
        "short", 1e-3, short[:, :1], short, np.ones(2), at[:, :1], at, np.zeros(2, int), 0 * at[:, :1], slow=40
    )
    found = Regression(Spectrum(series, base.linear), base)
    assert not len(found.y) and found.sd == 1.0 and np.isfinite(found.begin(np.zeros(0), np.zeros(0))[0]).all()
