"""Springs and axial forces that no mechanism of the library is: beams of finite elements written in `hermite_beams`."""

import numpy as np
import pytest
from hermite_beams import LENGTH, Truth, deck

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import AXIAL, FORCE, UNKNOWN, Choices

NAMES = ("tension", "compression", "ground-spring", "mass", "stiffness-loss", "crack")


def found_in(truth: Truth, free: bool):
    return diagnose(assemble(yaml_deck.read(deck(truth, free), "beam.yaml")), choices=Choices(NAMES, causes=1))


def halved(held) -> bool:
    """Whether the error of frequencies that were held out is at least halved."""
    return held.revised.rms_frequency_error < 0.5 * held.baseline.rms_frequency_error


@pytest.mark.parametrize("free", [False, True])
def test_a_spring_between_distant_places(free):
    """At 0.325 and 0.775 of the length, no nodes of the deck: found there, and in the deck that is written."""
    found = found_in(Truth(ties=((0.325, 0.775, 60.0),)), free)
    assert (found.kind, found.field.property) == (UNKNOWN, FORCE)
    one, other = sorted(found.field.values, key=lambda each: each.site.position[0])
    assert [each.site.position[0] / LENGTH for each in (one, other)] == pytest.approx([0.325, 0.775], abs=0.02)
    assert one.value == -other.value and halved(found.field.held_out)
    assert not found.extended_result.rejected
    k = found.extended_result.revised.theta[-1]
    assert k * LENGTH**3 / (2.1e11 * 0.02 * 0.006**3 / 12) == pytest.approx(60, rel=0.1)


def test_a_spring_against_a_turn():
    """As of an outrigger at 0.6 of a cantilever."""
    found = found_in(Truth(turns=((0.6, 4.0),)), False)
    assert (found.kind, found.field.property, len(found.field.values)) == (UNKNOWN, FORCE, 1)
    assert found.field.values[0].site.position[0] / LENGTH == pytest.approx(0.6, abs=0.02)
    assert halved(found.field.held_out) and not found.extended_result.rejected


def test_an_axial_force_that_varies():
    """A pull of 12 EI/L^2 at one end of a cantilever that falls to a push of 6 at the other."""
    pull = lambda x: 12.0 - 18.0 * x
    found = found_in(Truth(tension=pull), False)
    assert (found.kind, found.field.property) == (UNKNOWN, AXIAL)
    x, value, sd = np.array([(v.site.position[0] / LENGTH, v.value, v.sd) for v in found.field.values]).T
    assert np.corrcoef(value, pull(x))[0, 1] > 0.9
    assert (np.abs(value - pull(x)) < 3 * sd).mean() > 0.8
    assert halved(found.field.held_out) and not found.extended_result.rejected
