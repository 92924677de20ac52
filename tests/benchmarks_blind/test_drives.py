"""The blind benchmark of drives: its truths against closed forms and scipy, its decks, its scores, one case of each kind."""

import json

import numpy as np
import pytest
from proofs import proofs
from scipy.integrate import solve_ivp

from benchmarks.blind.drives.__main__ import outcome
from benchmarks.blind.drives.decks import answer, write
from benchmarks.blind.drives.draws import cases, limited, measured
from benchmarks.blind.drives.exact import Drive, run
from benchmarks.blind_records.__main__ import judged
from mouse_cli.formats import read_deck

H = 1e-3


def knots(force: np.ndarray) -> np.ndarray:
    return np.column_stack([force, np.zeros(len(force))])


def test_a_pushed_block_stops_where_its_energy_ends():
    """m a = f - Fc while it is pushed, then -Fc: it stops (f / Fc - 1) T after the push, for good."""
    m, Fc, f, T = 2.0, 3.0, 12.0, 0.5
    t = np.arange(3001) * H
    found = run(Drive(np.array([m]), np.zeros(1), friction=Fc), knots(np.where(t < T - H / 2, f, 0.0)), H)
    v = (f - Fc) / m * (T - H / 2)  # the force falls over the last step: half of it counts
    end = T + v * m / Fc
    assert found["v"][t < T - H, 0].max() == pytest.approx((f - Fc) / m * (T - 2 * H), rel=3e-3)
    assert np.abs(found["v"][t > end + 2 * H]).max() == 0.0
    assert found["x"][-1, 0] == pytest.approx(v * T / 2 + v**2 * m / Fc / 2, rel=5e-3)


def test_stick_and_slip_meet_the_events_of_scipy():
    """One mass, smooth force: pieces of solve_ivp between the same events."""
    m, c, Fc, offset = 1.5, 2.0, 4.0, 0.3
    t = np.arange(2001) * H
    f = 6 * np.sin(2 * np.pi * 1.3 * t) + 2 * np.sin(2 * np.pi * 3.1 * t)
    pull = lambda s: np.interp(s, t, f) + offset
    x, v, now, mode = 0.0, 0.0, 0.0, 0.0
    wanted = np.zeros((len(t), 2))
    while now < t[-1]:
        if mode:
            rhs = lambda s, y, sign=mode: [y[1], (pull(s) - c * y[1] - sign * Fc) / m]
            stop = lambda s, y, sign=mode, begun=now: sign * y[1] if s > begun + 1e-6 else 1.0
        else:
            rhs, stop = (lambda s, y: [0.0, 0.0]), (lambda s, y: Fc - abs(pull(s)))
        stop.terminal, stop.direction = True, -1
        part = solve_ivp(rhs, (now, t[-1]), [x, v], events=stop, rtol=1e-10, atol=1e-12, max_step=H, dense_output=True)
        own = (t >= now) & (t <= part.t[-1])
        wanted[own] = part.sol(t[own]).T
        now, (x, v) = part.t[-1], part.y[:, -1]
        if part.status == 1:
            mode = (np.sign(pull(now)) if abs(pull(now)) > Fc else 0.0) if mode else np.sign(pull(now))
            v = 0.0
    found = run(Drive(np.array([m]), np.array([c]), friction=Fc, offset=offset), knots(f), H)
    np.testing.assert_allclose(found["x"][:, 0], wanted[:, 0], atol=2e-6 * np.abs(wanted[:, 0]).max() + 1e-9)
    np.testing.assert_allclose(found["v"][:, 0], wanted[:, 1], atol=1e-4 * np.abs(wanted[:, 1]).max())


def test_a_shaft_with_play_does_nothing_within_it():
    drive = Drive(np.ones(2), np.zeros(2), shaft=(1e4, 0.0, 1e-3))
    found = run(drive, knots(np.full(800, 0.01)), H)
    apart = found["x"][:, 0] - found["x"][:, 1]
    inside = np.maximum.accumulate(apart) < 1e-3
    t = np.arange(800) * H
    assert inside.any() and (found["x"][inside, 1] == 0).all() and apart.max() > 1e-3
    np.testing.assert_allclose(found["x"][inside, 0], 0.01 * t[inside] ** 2 / 2, atol=1e-12)


@pytest.mark.parametrize(("faults", "sound"), proofs([(3, 1), (6, 2)], (3, 1)))
def test_decks_tell_nothing_of_the_answer(tmp_path, faults, sound):
    for case in cases(5, faults, sound):
        path = write(tmp_path, case)
        assert "friction" not in path.read_text() + path.name and (case.sound == (answer(case)["physics"] is None))
        problem = read_deck(path)
        assert problem.structure.n == case.drive.n and problem.recordings[0].samples.shape[1] == case.drive.n + 1
    assert cases(5, 1, 0)[0].drive.friction != cases(6, 1, 0)[0].drive.friction


def test_positions_are_counts_and_samples_are_limited():
    case = next(one for one in cases(5, 20, 0) if one.quantity == "position")
    _, _, x = measured(case)
    assert np.abs(x / 1e-6 - np.round(x / 1e-6)).max() < 1e-6
    t = np.arange(4000) / 4000
    assert np.abs(limited(np.sin(2 * np.pi * 80 * t)[:, None], 40)[20:-20]).max() < 1e-3
    np.testing.assert_allclose(
        limited(np.sin(2 * np.pi * 5 * t)[:, None], 40)[20:-20, 0], np.sin(2 * np.pi * 5 * t)[::40][20:-20], atol=1e-3
    )


def test_outcomes():
    known = {"physics": "friction", "ids": ["1TX"], "force": 10.0}
    said = lambda kind, group, force=10.0: {
        "verdict": {"kind": kind, "group": group, "site": {"ids": ["1TX"]}},
        "candidates": [{"parameters": [{"name": "slip force", "value": force}]}],
    }
    assert outcome(known, said("named", "friction", 10.4))[0] == "right"
    assert outcome(known, said("named", "friction", 11.0))[0] == "inexact"
    assert outcome(known, said("named", "oscillator"))[0] == "wrong"
    assert outcome(known, said("unknown", None))[0] == "abstained"
    assert outcome(known, said("nothing-missing", None))[0] == "missed"
    assert outcome({**known, "physics": None}, said("nothing-missing", None))[0] == "right"


@pytest.mark.parametrize("name", proofs(["1-friction-0", "1-friction-15", "1-none-0"], "1-friction-15", "1-none-0"))
def test_a_newcomers_drive(tmp_path, name):
    """A drifting mass under an encoder of 1 um; velocities at 100 Hz between rests; a sound one."""
    case = next(one for one in cases(1, 20, 10) if one.name == name)
    known = tmp_path / "answer.json"
    deck = write(tmp_path, case)
    known.write_text(json.dumps(answer(case)))
    assert outcome(*judged((deck, known, tmp_path / "found.json")))[0] == "right"
