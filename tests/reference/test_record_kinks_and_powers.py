"""Laws with a kink off rest, or with a power of their own, on truths that scipy integrated: nothing is named in their place."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from two_masses import record

from mouse_cli.cli.main import cli
from mouse_cli.terms.laws import registry

CABLE, OPENING = 1.0e4, 2.5e-3  # N/m, m
CUBIC = 2.0e2  # N s^3/m^3


def slack(u, v):
    """A cable from the second mass to the ground that goes slack at OPENING."""
    return np.array([0.0, CABLE * max(u[1], -OPENING)])


def cubed(u, v):
    return np.array([0.0, CUBIC * v[1] ** 3])


def answer(deck: str, laws: str) -> dict:
    done = CliRunner().invoke(cli, ["diagnose", deck, "--json", "-q", "--candidates", laws])
    assert done.exit_code in (0, 1), done.output
    return json.loads(done.stdout)


def test_a_cable_that_goes_slack(tmp_path):
    """Its kink is off rest: as another stiffness on one side it took an offset of the force 17 sd from its prior."""
    found = answer(record(tmp_path, slack), "preload,bilinear,one-sided-gap,spring,cubic,quadratic")
    verdict, (stiffness, opening) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "preload", [2])
    assert abs(stiffness["value"] - CABLE) < 4 * stiffness["sd"] and stiffness["sd"] < 0.02 * CABLE
    assert abs(opening["value"] - OPENING) < 4 * opening["sd"] and opening["sd"] < 0.3 * OPENING


def test_damping_by_another_power_than_the_square(tmp_path):
    """The square alone took nine tenths of the misfit, was sure, and something more beside it."""
    found = answer(record(tmp_path, cubed), "quadratic-damping,power-damping,dashpot,friction")
    verdict, (force, exponent) = found["verdict"], found["candidates"][0]["parameters"]
    assert (verdict["kind"], verdict["physics"], verdict["site"]["ids"]) == ("named", "power-damping", [2])
    assert exponent["value"] == pytest.approx(3, abs=0.1) and verdict["rest"] is None
    assert force["value"] == pytest.approx(CUBIC, rel=0.1)


def test_a_preloaded_contact_is_linear_until_it_opens():
    """From rest, where its preload is balanced; of a spring that the model has it takes what is beyond, and no more."""
    law, x, p = registry()["preload"], np.array([-3e-3, -1e-3, 0.0, 4e-3]), np.array([CABLE, OPENING])
    pull = CABLE * np.array([-OPENING, -1e-3, 0.0, 4e-3])
    force = lambda variant, x: law.force(x, 0 * x, None, p, **law.variants[variant])[0]
    assert force(0, x) == pytest.approx(pull) and force(1, -x) == pytest.approx(-pull)
    assert force(2, x) == pytest.approx(pull - CABLE * x) and force(3, -x) == pytest.approx(CABLE * x - pull)
