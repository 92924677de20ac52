"""Modes that a mechanism makes and that nobody measured: those that the deck holds out were measured."""

import importlib
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.unseen import unmeasured_hz, unseen
from mouse_cli.formats import read_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices

# masses of 1 kg in a row on four springs of 1000 N/m, held at one end: 2 sqrt(k/m) sin((2 i - 1) pi / 18) rad/s, by sines
NUMBERS = np.arange(1, 5)
HZ = 2 * np.sqrt(1000.0) * np.sin((2 * NUMBERS - 1) * np.pi / 18) / (2 * np.pi)
SHAPES = np.sin(np.outer(NUMBERS, 2 * NUMBERS - 1) * np.pi / 9)
ENTRIES = "[1, 1, 2000], [2, 2, 2000], [3, 3, 2000], [4, 4, 1000], [1, 2, -1000], [2, 3, -1000], [3, 4, -1000]"
DECK = f"""\
mouse: 1
model:
  stiffness: {{order: 4, entries: [{ENTRIES}]}}
  mass: {{diagonal: [1, 1, 1, 1]}}
parameters: [{{name: k, nominal: 1, sd: 5 %, stiffness: [{ENTRIES}]}}]
test:
  modes: {{dofs: [1, 2, 3, 4], frequency: {HZ[:3].tolist()}, frequency_sd: 1 %, shapes: {SHAPES[:, :3].tolist()}, shape_sd: 0.02}}
"""


@pytest.mark.parametrize(("held", "unmeasured"), [("", 1), ("  hold_out: {modes: [3]}\n", 0)])
def test_a_mode_that_is_held_out_was_measured(held, unmeasured):
    """A mechanism brings the third mode below the second: of two fitted ones none is between, if the third is held out."""
    text = (
        DECK
        if held
        else DECK.replace(str(HZ[:3].tolist()), str(HZ[:2].tolist())).replace(
            str(SHAPES[:, :3].tolist()), str(SHAPES[:, :2].tolist())
        )
    )
    problem = assemble(yaml_deck.read(text + held, "chain.yaml"))
    base = reduced(problem, problem.prior.mean)
    bare = Model(base).point(base.z)
    assert bare.modes.tolist() == [0, 1]
    swapped = replace(bare, modes=np.array([0, 2]), seen=bare.seen[:, [0, 2, 1, 3]])
    parts = [(SimpleNamespace(base=base, k=len(base.z)), swapped)]
    one = SimpleNamespace(model=SimpleNamespace(parts=lambda point: parts), point=swapped)
    assert unmeasured_hz(one) == pytest.approx(HZ[1:2][:unmeasured], rel=1e-6)
    assert (unseen(one) > 1) == bool(unmeasured)


def test_an_extended_deck_is_updated_by_the_modes_that_have_to_do_with_it(monkeypatch):
    """A mechanism may turn double modes so that nothing in its prior model is like one: the rest is updated, nothing refused."""
    whole, seen = importlib.import_module("mouse_cli.diagnosis.diagnose"), []

    def all_but_the_last(problem, *_):
        seen.append(problem.test.m)
        return np.arange(problem.test.m) < problem.test.m - (len(seen) > 1)

    for module in (whole, importlib.import_module("mouse_cli.diagnosis.begun")):
        monkeypatch.setattr(module, "related", all_but_the_last)
    problem = read_deck(Path(__file__).parents[2] / "decks" / "ground_spring.yaml")
    found = whole.diagnose(problem, choices=Choices(("ground-spring",), causes=1))
    assert found.kind == NAMED and len(seen) == 2
    assert found.extended_result.problem.test.m == problem.test.m - 1
