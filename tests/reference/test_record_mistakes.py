"""Recordings whose units, kinds, channels or sample rate are misstated, against records that scipy integrated."""

import json
import re

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.signal import butter, lfilter
from two_masses import linear, record

from mouse_cli._errors import DeckError
from mouse_cli.cli.main import cli
from mouse_cli.formats import read_deck
from mouse_cli.updating.recordings.mistakes import check
from mouse_cli.updating.recordings.records import records
from mouse_cli.updating.recordings.saturated import saturated
from mouse_cli.updating.recordings.study import study
from mouse_cli.updating.recordings.update import update_records

G = 9.80665
UNITS = "quantity: acceleration, unit: m/s2"
MISREAD = {  # changes of channels, of the deck, and what the finding says and what it asks for
    "all in g": ({"a1": 1 / G, "a2": 1 / G}, {}, "channels a1, a2 in g", "unit: g"),
    "all in mm/s2": ({"a1": 1e3, "a2": 1e3}, {}, "channels a1, a2 in mm/s2", "unit: mm/s2"),
    "force in lbf": ({"f": 1 / 4.4482216}, {}, "channel f in lbf", "unit: lbf"),
    "exchanged": ({}, {"l: a1": "l: a0", "l: a2": "l: a1", "l: a0": "l: a2"}, "a2 and a1 exchanged", "exchange"),
    "all as velocities": ({}, {UNITS: "quantity: velocity, unit: m/s"}, "a1, a2 as acceleration in m/s2", "quantity: acceleration"),
    "one as velocity": ({}, {f"a2, {UNITS}": "a2, quantity: velocity, unit: m/s"}, "channel a2 as acc", "channel a2"),
    "another kind at a scale": (
        {"a2": 7.3}, {f"a2, {UNITS}": "a2, quantity: displacement, unit: m"}, "acceleration in m/s2, 7.3", "scale it"
    ),
    "in ms": ({}, {"512.0": "0.512"}, "sampled at 512 Hz", "write sample_rate: 512"),
    "half the rate": ({}, {"512.0": "256"}, "sampled at 512 Hz", "write sample_rate: 512"),
    "force at the other mass": ({}, {"[{sensor: 2": "[{sensor: 1"}, "force f at 2", "inputs: {2: f}"),
}  # fmt: skip


def misread(folder, law, channels: dict[str, float], words: dict[str, str]):
    """The problem of a record some of whose channels are multiplied, and some words of whose deck are others."""
    deck = record(folder, law)
    kept = dict(np.load(folder / "run.npz"))
    np.savez(folder / "run.npz", **{name: channels.get(name, 1.0) * x for name, x in kept.items()})
    text = (folder / "deck.yaml").read_text()
    for before, after in words.items():
        text = text.replace(before, after)
    (folder / "deck.yaml").write_text(text)
    return read_deck(deck)


@pytest.mark.parametrize("name", MISREAD)
def test_what_is_misread_is_told_with_what_to_mend(tmp_path, name):
    channels, words, said, help = MISREAD[name]
    problem = misread(tmp_path, linear, channels, words)
    with pytest.raises(DeckError) as refused:
        check(study(problem, records(problem)))
    (found,) = refused.value.diagnostics
    assert found.code == "MD457" and said in found.message and help in found.help and "run.npz" in found.message
    assert found.span.line == 12  # that of the file


def test_sensors_that_lose_what_is_slow_are_told_with_their_corner(tmp_path):
    """AC coupling at 4 Hz, modes at 18 and 44 Hz: a delay of the force was named, P > 0.999, and left a third of the misfit."""
    misread(tmp_path, linear, {}, {})
    with np.load(tmp_path / "run.npz") as run:
        channels = {name: lfilter(*butter(1, 4.0, "high", fs=512), x) if name != "f" else x for name, x in run.items()}
    np.savez(tmp_path / "run.npz", **channels)
    problem = read_deck(str(tmp_path / "deck.yaml"))
    with pytest.raises(DeckError) as refused:
        check(study(problem, records(problem)))
    (found,) = refused.value.diagnostics
    corner = float(re.search(r"if channels a1, a2 lose what is slower than ([\d.]+) Hz", found.message)[1])
    assert found.code == "MD457" and corner == pytest.approx(4.0, rel=0.05)


@pytest.mark.parametrize("level", [1.3, 2.0])
def test_a_channel_that_saturates_is_told_with_its_curve(tmp_path, level):
    """By a hyperbolic tangent that ends at so many rms: m2, 1 % sure, went 12 prior sd off for it, and was to be checked."""
    misread(tmp_path, linear, {}, {})
    kept = dict(np.load(tmp_path / "run.npz"))
    top = level * kept["a2"].std()
    np.savez(tmp_path / "run.npz", **kept | {"a2": top * np.tanh(kept["a2"] / top)})
    problem = read_deck(tmp_path / "deck.yaml")
    own = study(problem, records(problem))
    found = saturated(own)
    largest = np.abs(own.look.measured[:, 1]).max() / top  # of what it can read
    assert found.channel == "a2" and found.times == pytest.approx(np.arctanh(0.8 * largest) / (0.8 * largest), rel=0.1)
    told = json.loads(CliRunner().invoke(cli, ["diagnose", str(tmp_path / "deck.yaml"), "--json", "-q"]).stdout)
    assert told["verdict"]["kind"] == "unknown" and told["cautions"] == [found.said()]


def cubic(u, v):
    return 2e9 * (u[1] - u[0]) ** 3 * np.array([-1.0, 1.0])


@pytest.mark.parametrize(("law", "gain"), [(linear, 1.0), (linear, 1.3), (cubic, 1.0)])
def test_a_gain_or_a_law_saturates_no_channel(tmp_path, law, gain):
    problem = misread(tmp_path, law, {"a2": gain}, {})
    assert saturated(study(problem, records(problem))) is None


def test_an_update_is_refused_likewise(tmp_path):
    problem = misread(tmp_path, linear, {"a1": 1 / G, "a2": 1 / G}, {})
    with pytest.raises(DeckError, match="in g, not in m/s2"):
        update_records(problem, lambda text: None)


@pytest.mark.parametrize(
    "law",
    [
        linear,
        lambda u, v: 2e9 * (u[1] - u[0]) ** 3 * np.array([-1.0, 1.0]),
        lambda u, v: np.array([6.0 * np.tanh(v[0] / 1e-3), 0.0]),
        lambda u, v: np.array([2e4 * u[0], 0.0]),
    ],
)
def test_a_law_is_no_misreading(tmp_path, law):
    """A strong cubic spring, dry friction, and a spring that doubles the stiffness to the ground."""
    problem = misread(tmp_path, law, {}, {})
    check(study(problem, records(problem)))


def test_the_remedy_of_one_channel_names_its_unit(tmp_path):
    from mouse_cli.diagnosis.diagnose import diagnose

    found = diagnose(misread(tmp_path, linear, {"a1": 1e3}, {}))
    assert found.best.causes[0].physics == "sensor-gain"
    assert any("Channel a1 reads" in one and "write unit: mm/s2" in one for one in found.cautions)
