"""Bars that carry nothing where the deck has them carry mass; truths by finite elements (Hermite) written in hermite_beams.py."""

import numpy as np
import pytest

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, NOTHING, Choices
from tests.reference.hermite_beams import COARSE, MASS, Truth, deck

FIRST, CARRIED = 19, 0.6  # element from which on the deck has the beam carry that many times its own mass
_ONE = f"      - {{id: 1-{COARSE}, type: beam, nodes: 1-{COARSE + 1}, material: steel, section: bar}}"
_TWO = f"""\
      - {{id: 1-{FIRST - 1}, type: beam, nodes: 1-{FIRST}, material: steel, section: bar}}
      - {{id: {FIRST}-{COARSE}, type: beam, nodes: {FIRST}-{COARSE + 1}, material: steel, section: bar,
         nonstructural_mass: {CARRIED * MASS}}}"""


def problem(left: float):
    """The deck, of a beam that carries a share `left` of what it has."""
    truth = Truth(mass=lambda x: 1 + left * CARRIED * (x > (FIRST - 1) / COARSE))
    return assemble(yaml_deck.read(deck(truth, seed=3).replace(_ONE, _TWO), "deck.yaml"))


@pytest.fixture(scope="module")
def empty():
    choices = Choices(("lighter", "mass", "added-mass", "stiffness-gain", "member", "mass-loss"))
    return diagnose(problem(0.0), choices)


def test_an_empty_pipe_is_named(empty):
    (cause,) = empty.best.causes
    assert (empty.kind, cause.physics, cause.site.ids) == (NAMED, "lighter", tuple(range(FIRST, COARSE + 1)))
    (share,) = cause.sizes
    assert share.value == pytest.approx(1.0, abs=0.05)


def test_the_extended_deck_is_that_of_the_truth(empty):
    extended, at = empty.extended, empty.extended.parameters[-1]
    assert at.name == f"mass left of elements {FIRST} to {COARSE}"
    carrying = [own for own in extended.mesh.elements if np.any(own.properties.get("nonstructural_mass", 0.0))]
    assert [own.ids.tolist() for own in carrying] == [list(range(FIRST, COARSE + 1))]
    assert at.nominal == pytest.approx(0.0, abs=0.05)


def test_a_full_pipe_lacks_nothing():
    found = diagnose(problem(1.0), choices=Choices(("lighter", "mass", "added-mass", "member")))
    assert found.kind == NOTHING
