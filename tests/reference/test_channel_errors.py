"""Channels of recordings that read a multiple, are turned round or late, against records that scipy integrated, then falsified."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from proofs import proofs
from two_masses import RATE, linear, record

from mouse_cli.cli.main import cli
from mouse_cli.updating.recordings.channels import earlier

A1, A2, F = 0, 1, 2


def late(x: np.ndarray, samples: float) -> np.ndarray:
    """x (t,) so many samples later, by its spectrum between mirrors."""
    whole = np.concatenate([x, x[::-1]])
    turned = np.fft.rfft(whole) * np.exp(-2j * np.pi * np.fft.rfftfreq(len(whole)) * samples)
    return np.fft.irfft(turned, len(whole))[: len(x)]


def falsified(folder: Path, law, **channels) -> dict:
    """The answer to a record some of whose channels went through functions."""
    deck = record(folder, law)
    kept = dict(np.load(folder / "run.npz"))
    np.savez(folder / "run.npz", **kept | {name: of(kept[name]) for name, of in channels.items()})
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q"])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


@pytest.mark.parametrize(
    ("channel", "change", "physics", "value"),
    [
        ("f", lambda x: 1.5 * x, "sensor-gain", 1.5),
        ("a1", lambda x: late(x, 1.3), "sensor-delay", 1.3 / RATE),
        *proofs(
            [
                ("a1", lambda x: 1.3 * x, "sensor-gain", 1.3),
                ("a1", lambda x: 9.80665 * x, "sensor-gain", 9.80665),
                ("a2", lambda x: -x, "sensor-gain", 1.0),
                ("a2", lambda x: late(x, 20), "sensor-delay", 20 / RATE),
                ("f", lambda x: late(x, 2), "sensor-delay", 2 / RATE),
            ]
        ),
    ],
)
def test_an_error_of_one_channel_is_named_as_that(tmp_path, channel, change, physics, value):
    found = falsified(tmp_path, linear, **{channel: change})
    verdict, (size,) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"]) == ("named", physics)
    assert (verdict["site"]["kind"], verdict["site"]["ids"]) == ("sensor", [channel])
    assert size["value"] == pytest.approx(value, rel=2e-3)
    assert verdict["sentences"][0].startswith("The test is at fault, not the model:")


@pytest.mark.proof
def test_a_law_beside_a_late_channel(tmp_path):
    def law(u, v):
        force = 2e8 * (u[1] - u[0]) ** 3
        return np.array([-force, force])

    found = falsified(tmp_path, law, a1=lambda x: late(x, 1.3))
    sizes = {one["name"]: one["value"] for one in found["candidates"][0]["parameters"]}
    assert found["verdict"]["kind"] == "named"
    assert set(found["verdict"]["physics"].split(" + ")) == {"cubic", "sensor-delay"}
    assert sizes["delay"] == pytest.approx(1.3 / RATE, rel=0.01)
    assert sizes["cubic stiffness"] == pytest.approx(2e8, rel=0.02)


def test_a_sine_earlier_is_that_sine_of_later():
    t = np.arange(2000) / 500.0
    x = np.sin(2 * np.pi * 17.3 * t + 0.4)
    found = earlier(np.stack([x, x], axis=1), 1 / 500, np.array([0.00123, 0.0]))
    exact = np.sin(2 * np.pi * 17.3 * (t + 0.00123) + 0.4)
    assert np.abs(found[100:-100, 0] - exact[100:-100]).max() < 2e-3 and (found[:, 1] == x).all()
