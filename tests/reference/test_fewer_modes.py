"""Models that have fewer modes than the test where a mass vanishes: no point of these is beside the data.

Two masses on springs, both modes measured, the second mass a parameter: without it one mode is left.
"""

import numpy as np
import pytest

from mouse_cli.diagnosis.effects.sensors import worst_sensors
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import read_deck

DECK = """\
mouse: 1
model:
  stiffness: {dense: [[200.0, -100.0], [-100.0, 100.0]]}
  mass: {diagonal: [1.0, 2.0]}
parameters:
  - {name: m2, nominal: 2.0, sd: 0.1, mass: [[2, 2, 1.0]]}
test:
  modes:
    frequency: [0.9, 2.4]
    frequency_sd: 1 %
    dofs: [1, 2]
    shapes: [[0.6, 1.0], [1.0, -0.3]]
    shape_sd: 0.05
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("deck") / "deck.yaml"
    path.write_text(DECK)
    problem = read_deck(path)
    return reduced(problem, problem.prior.mean)


def test_a_model_of_fewer_modes_is_no_model_of_the_test(model):
    there = model.at(np.array([0.0]))
    assert there.r == 1
    assert Model(there).point(there.z) is None
    assert worst_sensors(there) == []
    assert Model(model).point(model.z) is not None and sorted(worst_sensors(model)) == [0, 1]


@pytest.mark.parametrize("small", [1e-3, 1e-5])
def test_where_causes_are_weighed_a_small_mass_does_not_vanish(model, small):
    """A grid of shares of the mass has no place between nothing and a hundredth of it."""
    one = fit(Model(model), np.zeros(0), np.array([(2 * small - 2.0) / 0.1]), most=0)
    assert one.model.base.parameters(one.point.x)[0] == pytest.approx(2 * small)
    assert Study(model).about(one).model.theta[0] == pytest.approx(2 * small)
