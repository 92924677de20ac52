"""Drives of two masses on a shaft, integrated from event to event: steps that follow the shaft, and initial states whose place no
channel shows.
"""

import json

import numpy as np
import pytest
from click.testing import CliRunner

import mouse_cli
from benchmarks.blind.drives.decks import write
from benchmarks.blind.drives.draws import cases
from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.likelihoods.history.order import begun_again, from_mean
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.polish import Polish
from mouse_cli.updating.recordings.records import records, reduced
from mouse_cli.updating.recordings.segments import segments
from mouse_cli.updating.recordings.series import REACH
from mouse_cli.updating.recordings.study import begin, fitted, study


def test_a_shaft_that_friction_shakes_is_followed_far_above_the_band_of_the_force(tmp_path):
    case = cases(60412, 6, 0)[2]  # velocities at 100 Hz, a force up to 8 Hz
    k, m = case.drive.shaft[0], case.drive.m
    own = study(*(lambda problem: (problem, records(problem)))(mouse_cli.read_deck(str(write(tmp_path, case)))))
    shaft_hz = np.sqrt(k * (1 / m).sum()) / (2 * np.pi)
    series = own.data[0].series
    assert own.band[1] < shaft_hz / 2 and series.factor / series.dt / shaft_hz > 30


def test_no_stretch_begins_at_a_place_that_its_prior_does_not_know(tmp_path):
    case = cases(60412, 6, 0)[5]  # accelerations
    own = study(*(lambda problem: (problem, records(problem)))(mouse_cli.read_deck(str(write(tmp_path, case)))))
    look = own.at(own.places[0], own.data[0].series)
    states, _ = begin(own.base, np.zeros(len(own.base.mean)), own.data, [look])
    assert (np.abs(states) < 5 * look.spread[:, None]).all()
    kept = states[1] - states[0] - (look.states(own.data[0].starts - 12)[1] - look.states(own.data[0].starts - 12)[0])
    assert np.abs(kept).max() < 1e-9


def test_stretches_begin_where_channels_of_place_show_a_mass(tmp_path):
    """Also that of the end of a record, 2 m from its beginning: a stretch at rest stayed at the mean of what is held out."""
    case = cases(210105, 8, 0)[7]  # positions of one mass
    problem = mouse_cli.read_deck(str(write(tmp_path, case)))
    own = study(problem, records(problem))
    (held,) = own.records.held
    stretches = segments(reduced(held, own.model), own.length, 12)
    look = own.at(own.places[0], stretches.series)
    states, _ = begin(own.base, np.zeros(len(own.base.mean)), [stretches], [look])
    assert abs(held.measured.mean()) > 1
    np.testing.assert_allclose(states[0], held.measured[stretches.starts - REACH, 0], atol=1e-5)


def test_accelerations_that_do_not_begin_at_rest_tell_of_speeds_to_and_fro(tmp_path):
    """The speed was off by 0.27 m/s of an rms of 0.17, and friction had the wrong sign in the first look."""
    case = cases(210105, 18, 0)[17]
    problem = mouse_cli.read_deck(str(write(tmp_path, case)))
    own = study(problem, records(problem))
    place = next(one for one in own.places if one.site.ids == ("2TX",))
    at = own.at(place)
    assert not own.look.at_rest and abs(at.local.v.mean()) < 0.05 * at.local.v.std()
    assert np.exp(at.best(registry()["coulomb"], 0).x[-1]) == pytest.approx(case.drive.friction, rel=0.3)


@pytest.mark.proof
def test_a_stretch_at_rest_does_not_hold_up_the_fit_of_the_others(tmp_path):
    """Its speed, which it does not feel, took steps of hundreds of prior sd: a stop beside friction was named at > 0.999."""
    case = cases(210405, 19, 0)[18]
    problem = mouse_cli.read_deck(str(write(tmp_path, case)))
    own = study(problem, records(problem))
    one = fitted(own, own.at(own.places[0]).best(registry()["coulomb"], 0))
    assert one.misfit < 0.1 * one.dof and np.exp(one.x[-1]) == pytest.approx(case.drive.friction, rel=1e-3)


def test_a_law_is_begun_with_all_nuisances_at_their_mean_where_that_costs_less(tmp_path):
    """Friction at the second mass; dampings that act alike stand many sd apart in the first look, and a fit from there ran out of
    steps.
    """
    case = cases(98803, 6, 0)[2]
    own = study(*(lambda problem: (problem, records(problem)))(mouse_cli.read_deck(str(write(tmp_path, case)))))
    place = next(one for one in own.places if one.site.ids == ("2TX",))
    start = own.at(place).best(registry()["coulomb"], 0)
    h, look = start.hypothesis, own.at(place, own.data[0].series)
    assert np.abs(start.x[: h.nuisances]).max() > 5
    first = fitted(own, start)
    mean, (ended, beat) = from_mean(first), next(begun_again(own, first))
    assert not mean.x[: h.nuisances].any() and mean.x[-1] == first.x[-1]
    assert (ended.x == first.x).all() and beat == np.inf
    begun = Polish(h, [part.begun() for part in own.data], look.spread)
    assert not begun.nearer(start.x, *begin(h, start.x, own.data, [look]))[: h.nuisances].any()
    for one in (first, fitted(own, mean)):
        assert np.exp(one.x[-1]) == pytest.approx(case.drive.friction, rel=2e-3)


@pytest.mark.proof
def test_friction_alone_is_named_where_a_fit_runs_out_of_steps(tmp_path):
    """It was friction at both masses, 2 % of it at the wrong one, probability > 0.999."""
    deck = str(write(tmp_path, cases(98803, 6, 0)[2]))
    found = json.loads(CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"]).stdout)["verdict"]
    assert (found["kind"], found["group"], found["site"]["ids"]) == ("named", "friction", ["2TX"])
