"""Sizes of laws between shafts are of moments and angles."""

from types import SimpleNamespace

import pytest

from mouse_cli.model.explanation import Cause, Size
from mouse_cli.model.site import Site
from mouse_cli.model.units import SYSTEMS
from mouse_cli.updating.recordings.rotations import spelled


def deck(labels, quantity="acceleration", weights=None, units="SI"):
    channel = SimpleNamespace(quantity=quantity, weights=weights or {})
    record = SimpleNamespace(channels=(channel,))
    return SimpleNamespace(structure=SimpleNamespace(labels=labels), recordings=(record,), units=SYSTEMS[units])


@pytest.mark.parametrize(
    ("problem", "units"),
    [
        (deck(("1", "2")), ["N/m", "m"]),
        (deck(("1", "2"), "angular velocity", {0: 1.0, 1: 1.0}), ["N m/rad", "rad"]),
        (deck(("1", "2"), "moment", {0: 1.0}), ["N/m", "m"]),  # of one of them nothing says so
        (deck(("1RX", "2RX")), ["N m/rad", "rad"]),
        (deck(("1RX", "2RX"), units="mm-t-N"), ["N mm/rad", "rad"]),
    ],
)
def test_units_follow_what_moves(problem, units):
    sizes = (Size("stiffness", "N/m", 180.0, 1.0, 1.0, 1e3), Size("clearance", "m", 4e-3, 1e-5, 1e-4, 1e-1))
    cause = Cause("play", "clearance", "play", Site("dof", tuple(problem.structure.labels)), sizes)
    assert [size.unit for size in spelled(cause, problem).sizes] == units
