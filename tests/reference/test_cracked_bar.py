"""Homework 4 of the lectures, decks/cracked_bar*.yaml: a crack in a damped bar, found by its modes and by its functions."""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind import cracks
from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import read_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices

DECKS = Path(__file__).resolve().parents[2] / "decks"
_spec = importlib.util.spec_from_file_location("make_cracked_bar", DECKS / "cracked_bar" / "make.py")
make = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(make)
SETTLED = 0.005  # share of a depth that is 1 % of the compliance of the crack, to which its theory is taken to be right


@pytest.fixture(scope="module")
def elements():
    """Hz and deflections at the nodes of Hermite elements with springs across the crack."""
    inputs = {
        "L": make.LENGTH, "elements": 24, "height": make.HEIGHT, "A": make.WIDTH * make.HEIGHT, "I": make.EI / make.E,
        "E": make.E, "density": make.DENSITY, "place": make.PLACE, "depth": make.DEPTH, "axial": False,
        "held": [["TX", "TY"], ["TY"]], "heavy": 0,
    }  # fmt: skip
    return cracks.modes(inputs)


def test_modes_of_the_closed_form_are_those_of_elements(elements):
    """The elements also slide at the crack, which moves mode 3 by 4e-5."""
    hz, shapes = make.modes()
    assert elements[0][:4] == pytest.approx(hz, rel=6e-5)
    w = elements[1][[n - 1 for n in make.NODES], 1, :4]
    at = np.abs(shapes).argmax(axis=0)
    assert w / w[at, range(4)] == pytest.approx(shapes, abs=2e-3)


def test_receptances_of_the_closed_form_are_sums_of_modes(elements):
    """Where the crack loses as much as the bar, modes are real."""
    hz, w = elements
    omega = 2 * np.pi * np.array([[30.0], [100.0], [300.0]])
    line = (w[[n - 1 for n in make.NODES], 1] * w[make.FORCE - 1, 1])[None]
    summed = (line / ((2 * np.pi * hz) ** 2 * (1 + 1j * make.LOSS) - omega**2)[:, None]).sum(axis=2)
    found = make.receptances(omega[:, 0] / (2 * np.pi), loss=make.LOSS)
    assert np.abs(found - summed).max() < 1e-3 * np.abs(summed).max()


def test_the_files_are_those_that_the_script_writes():
    text, written = (DECKS / "cracked_bar.yaml").read_text(), (DECKS / "cracked_bar" / "modes.txt").read_text()
    for line in written.splitlines():
        assert line in text
    hz, shapes = make.modes()
    test = read_deck(DECKS / "cracked_bar.yaml").test
    assert np.abs(test.frequency_hz / hz - 1).max() < 3e-3 and np.abs(test.shapes - shapes).max() < 0.04


@pytest.mark.parametrize("full", [False, True], ids=["bending", "full"])
def test_the_crack_by_modes(full):
    """The same data tell the same crack whether the deck has motion along the bar or not."""
    text = (DECKS / "cracked_bar.yaml").read_text()
    if full:
        text = text.replace("directions: [TY, RZ]", "plane: XY").replace("1: [TY], 25", "1: [TX, TY], 25")
    found = diagnose(assemble(yaml_deck.read(text, "bar.yaml")))
    assert (found.kind, found.best.group) == (NAMED, "local-stiffness")
    crack = next(each for each in found.explanations if [c.physics for c in each.causes] == ["crack"])
    depth, place = crack.causes[0].sizes
    assert abs(depth.value - make.DEPTH) < 3 * depth.sd and depth.sd < 0.03 * make.DEPTH
    assert abs(place.value - make.PLACE) < 3 * place.sd and place.sd < 0.004


def test_the_crack_and_its_loss_by_functions():
    """Damping in no proportion to stiffness: the crack has a loss factor of its own, whose law modes cannot tell."""
    choices = Choices(candidates=("crack", "mass", "ground-spring"))
    found = diagnose(read_deck(DECKS / "cracked_bar_functions.yaml"), choices=choices)
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.law) == (NAMED, "crack", "structural")
    depth, place, loss = cause.sizes
    assert abs(depth.value - make.DEPTH) < 3 * np.hypot(depth.sd, SETTLED * make.DEPTH)
    assert abs(place.value - make.PLACE) < 4 * place.sd and place.sd < 0.001
    assert abs(loss.value - make.OWN_LOSS) < 4 * loss.sd and loss.sd < 0.03 * make.OWN_LOSS
