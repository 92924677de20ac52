"""Records of a damper behind a spring, of a magnet, and of what neither is: two masses, integrated by scipy."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import lsim
from two_masses import DECK, RATE, K, record, shaking

from mouse_cli.cli.main import cli
from mouse_cli.diagnosis.likelihoods.history.search import doubled
from mouse_cli.formats import read_deck
from mouse_cli.terms.laws import registry
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.regression import Start
from mouse_cli.updating.recordings.study import study

SECONDS, FINER = 12.0, 8
STIFF, TIME = 1.2e4, 6e-3  # N/m, s: a corner of 26.5 Hz, between the two modes of the masses


def damped(folder, stiff: float, time: float) -> str:
    """A deck whose record is of the masses with a spring and a dashpot in series between them."""
    rng, t = np.random.default_rng(5), np.arange(int(SECONDS * RATE * FINER)) / (RATE * FINER)
    f = 40 * shaking(t, rng) * np.minimum(t / 0.2, 1)
    A = np.zeros((5, 5))
    A[:2, 2:4] = np.eye(2)
    A[2:4, :2], A[2:4, 2:4] = -1.01 * K, -1.2e-4 * K
    force = stiff * np.array([-1.0, 1.0, 0.0, 0.0, -1.0])  # of u2 - u1 - q
    A[2] += force
    A[3] -= force
    A[4] = force / (stiff * time)
    B = np.array([[0.0], [0.0], [0.0], [1.0], [0.0]])
    _, a, _ = lsim((A, B, A[2:4], B[2:4]), f, t)
    a = a[::FINER]
    a += 0.01 * a.std(axis=0) * rng.standard_normal(a.shape)
    np.savez(folder / "run.npz", f=f[::FINER], a1=a[:, 0], a2=a[:, 1])
    outputs = ", ".join(f"{{sensor: {i}, channel: a{i}, quantity: acceleration, unit: m/s2}}" for i in (1, 2))
    (folder / "deck.yaml").write_text(DECK.format(rate=RATE, outputs=outputs))
    return str(folder / "deck.yaml")


def said(deck: str, *options: str) -> dict:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", *options], catch_exceptions=False)
    return json.loads(done.stdout)


def test_a_damper_behind_a_spring_is_named_and_put_into_the_deck(tmp_path):
    """It was a search of all laws, and nearest a bilinear one at another place, though all of it is linear."""
    revised = str(tmp_path / "more.yaml")
    found = said(damped(tmp_path, STIFF, TIME), "-o", revised)
    assert (found["verdict"]["kind"], found["verdict"]["physics"], found["verdict"]["site"]["ids"]) == ("named", "maxwell", [1, 2])
    stiff, time = (each["value"] for each in found["candidates"][0]["parameters"])
    assert (stiff, time) == (pytest.approx(STIFF, rel=0.02), pytest.approx(TIME, rel=0.02))
    again = said(revised)
    assert again["verdict"]["kind"] == "nothing-missing"
    done = CliRunner().invoke(cli, ["run", revised, "--json", "-q"], catch_exceptions=False)
    assert done.exit_code == 0


@pytest.mark.parametrize(("stiff", "time", "physics"), [(1e7, 6e-6, "dashpot"), (1.2e4, 10.0, "spring")])
def test_a_dashpot_or_a_spring_alone_is_none(tmp_path, stiff, time, physics):
    """So stiff, or so slow, that no record tells of the other part."""
    found = said(damped(tmp_path, stiff, time), "--candidates", "dashpot,spring,maxwell,mass", "--causes", "1")
    assert (found["verdict"]["kind"], found["verdict"]["physics"]) == ("named", physics)


def test_a_magnet_is_a_negative_spring_and_what_softens_further(tmp_path):
    """Bilinear stiffness imitated it by an offset of the force of 45 prior standard deviations."""
    revised = str(tmp_path / "more.yaml")
    deck = record(tmp_path, lambda u, v: np.array([0.0, -2e3 * u[1] - 5e6 * u[1] ** 3]), level=10.0)
    found = said(deck, "--candidates", "negative-spring,cubic,bilinear,quadratic", "-o", revised)
    assert found["verdict"]["kind"] == "named" and found["verdict"]["physics"] == "negative-spring + cubic"
    sizes = [each["value"] for each in found["candidates"][0]["parameters"]]
    assert sizes == [pytest.approx(2e3, rel=0.1), pytest.approx(5e6, rel=0.1)]
    assert said(revised)["verdict"]["kind"] == "nothing-missing"


def test_a_negative_spring_acts_beside_no_other_linear_law(tmp_path):
    """A base that rocks was a negative spring at the roof and one between floors, P > 0.999."""
    problem = read_deck(damped(tmp_path, STIFF, TIME))
    own = study(problem, records(problem))
    ground, other = (next(place for place in own.places if place.ground == held) for held in (True, False))
    first = own.base.placed(ground).at(registry()["negative-spring"], 0)
    beside = lambda key: Start(first.placed(other).at(registry()[key], 0), np.zeros(0), 0.0)
    assert doubled(beside("spring")) and doubled(beside("maxwell")) and not doubled(beside("cubic"))
