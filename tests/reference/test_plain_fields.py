"""What a field cannot be, or is where it is plain: a bed of negative stiffness, and a section that changes linearly."""

from dataclasses import replace

import numpy as np
import pytest
from hermite_beams import COARSE, Truth, deck

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.nameless import registry as nameless
from mouse_cli.diagnosis.nameless._field import LENGTHS, smooth
from mouse_cli.diagnosis.nameless.fit import Spread, _integrated, _spreads
from mouse_cli.diagnosis.search.rank import rank
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices

NAMES = ("tension", "ground-spring", "mass", "stiffness-loss", "taper", "shear")


@pytest.mark.parametrize(
    ("truth", "least", "most"), [(Truth(tension=-0.3), -20, -2), (Truth(springs=((0.55, 40.0),)), 0.6, 0.7)]
)
def test_where_there_is_no_bed_one_is_only_added(truth, least, most):
    """What compression does, springs of negative stiffness would do nearly as well; half of what is possible beforehand is none."""
    problem = assemble(yaml_deck.read(deck(truth), "beam.yaml"))
    model = reduced(problem, problem.prior.mean)
    baseline = rank(model, {"shear": registry()["shear"]}, causes=1).baseline
    (bed,) = (each for each in _spreads(model) if each.rival.key == "field-bed")
    either = Spread(bed.rival, tuple(replace(cells, positive=None) for cells in bed.cells))
    added, both = (_integrated(model, baseline, one, Model, np.inf).log_evidence for one in (bed, either))
    assert least < added - both < most


def test_a_bed_that_the_model_has_may_be_softer():
    """Its change is of either sign there."""
    own = f"      - {{id: 1001-{1000 + COARSE}, type: foundation, nodes: 1-{COARSE + 1}, ky: 1.0e+5}}\n"
    problem = assemble(yaml_deck.read(deck(Truth(), more=own), "beam.yaml"))
    assert nameless()["field-bed"].cells(reduced(problem, problem.prior.mean)).positive is None


@pytest.mark.parametrize("share", [LENGTHS[-2], np.inf])
def test_a_section_that_changes_linearly_along_a_beam_is_a_taper(share):
    """A depth that grows by 12 % from the middle to an end keeps its name beside the field that can take it."""
    problem = assemble(yaml_deck.read(deck(Truth()), "beam.yaml"))
    rival = nameless()["field-section"]
    field = smooth(rival, rival.cells(reduced(problem, problem.prior.mean)), 0.1, share)
    assert field.rival.even == ("taper" if np.isinf(share) else "")
    depth = lambda x: 1 + 0.12 * (2 * x - 1)
    if np.isinf(share):
        found = diagnose(
            assemble(yaml_deck.read(deck(Truth(stiffness=lambda x: depth(x) ** 3, mass=depth)), "beam.yaml")),
            choices=Choices(NAMES, causes=1),
        )
        assert (found.kind, found.best.physics, found.field) == (NAMED, "taper", None)
