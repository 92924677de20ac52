"""Drives of two masses on a shaft, integrated from event to event: steps that follow the shaft, and initial states whose place no
channel shows.
"""

import numpy as np

import mouse_cli
from benchmarks.blind.drives.decks import write
from benchmarks.blind.drives.draws import cases
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.study import begin, study


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
