"""Slopes that lead a fit of a law, taken in coarser steps than what is compared."""

from pathlib import Path

import numpy as np
import pytest
from two_masses import linear, record

import mouse_cli
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.polish import Polish
from mouse_cli.updating.recordings.records import records, steps
from mouse_cli.updating.recordings.simulator import Simulator
from mouse_cli.updating.recordings.study import begin, study


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    folder = tmp_path_factory.mktemp("records")
    return study(problem := mouse_cli.read_deck(str(Path(record(folder, linear)))), records(problem))


def hypothesis(own, law: str):
    h = own.base.placed(own.places[0]).at(registry()[law], 0)
    return h, h.mean


@pytest.mark.parametrize(("law", "jumps"), [("cubic", False), ("coulomb", True)])
def test_they_agree_with_those_of_all_steps_and_forces_that_jump_have_no_others(own, law, jumps):
    h, x = hypothesis(own, law)
    spread = own.at(own.places[0]).spread
    states, internal = begin(h, x, own.data, [own.at(own.places[0], data.series) for data in own.data])
    its = Simulator(h, own.data)
    its.internal = internal
    assert its.jumps == jumps and own.data[0].coarser.series.factor < own.data[0].series.factor
    taken, fine = its.slopes(x, states, spread), its._differences(x, states, spread, local=True)
    for a, b in ((taken.J, fine.J), (taken.X * spread, fine.X * spread)):
        if jumps:
            np.testing.assert_array_equal(a, b)
        else:
            assert 0 < np.abs(a - b).max() < 0.02 * np.abs(b).max()


def test_no_mode_is_folded_into_the_band(own):
    series = own.look
    for top_hz in (0.5, 1.3, 3.6):  # times the sample rate
        taken = steps(series, 0.2 / series.dt, top_hz / series.dt).coarser.factor
        assert taken - top_hz >= 0.5 or taken == steps(series, 0.2 / series.dt, top_hz / series.dt).factor


def test_a_rejected_step_that_promises_nothing_ends_a_fit(own, monkeypatch):
    h, spread = own.base, own.at(own.places[0]).spread
    looks = [own.at(own.places[0], data.series) for data in own.data]
    settled = Polish(h, own.data, spread).fit(np.zeros(len(h.mean)), *begin(h, np.zeros(len(h.mean)), own.data, looks))
    tried = []
    refuse = lambda self, at, dx, ds: tried.append(1) or type(at)(at.x, at.states, at.left, np.inf)
    monkeypatch.setattr(Polish, "_tried", refuse)
    again = Polish(h, own.data, spread).fit(settled.x, settled.states)
    assert len(tried) == 1 and again.cost == settled.cost


def test_a_fit_with_a_law_that_stays_astray_is_dropped_and_one_without_is_not(own):
    look = own.at(own.places[0])

    def ended(h, x, times: float):
        """The fit that takes no step from `times` the motion that the record shows, and the square of what the record has."""
        states, internal = begin(h, x, own.data, [look for _ in own.data])
        its = Polish(h, own.data, look.spread)
        return its.fit(x, times * states, internal, steps=0), float((its.simulator.measured**2).sum())

    with_law, bare = hypothesis(own, "spring"), (own.base, np.zeros(len(own.base.mean)))
    assert ended(*with_law, 1.0)[0] is not None
    assert ended(*with_law, 1e2)[0] is None
    one, loud = ended(*bare, 1e2)
    assert one.cost > 100 * loud
