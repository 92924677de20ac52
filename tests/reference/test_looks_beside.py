"""First looks in few coordinates beside a mechanism that these do not know well: shear of a stubby bar."""

import numpy as np
import pytest

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.formats import read_deck

HZ = [700.7, 1860.0, 3526.2, 5445.1, 7685.5, 10248.3]  # clamped at both ends, five heights long: Timoshenko's, not Euler's
DECK = f"""mouse: 1
title: a stubby bar
model:
  structure:
    nodes: {{line: {{from: 1, to: 31, start: [0, 0], end: [0.5, 0]}}}}
    materials: {{metal: {{E: 2.1e+11, nu: 0.3, density: 7850}}}}
    sections: {{bar: {{rectangle: [0.034869, 0.095357]}}}}
    elements: [{{id: 1-30, type: beam, nodes: 1-31, material: metal, section: bar}}]
    supports: {{1: all, 31: all, 2-30: [TX]}}
    plane: XY
parameters: [{{name: E, material: metal, property: E, sd: 5 %, transform: log}}]
test: {{modes: {{frequency: {HZ}, frequency_sd: 0.2 %}}}}
"""


def test_a_look_leaves_what_all_coordinates_leave_where_it_begins(tmp_path):
    """It left three times as much, more than most partners would have taken, so that no partner was tried that helps."""
    (tmp_path / "deck.yaml").write_text(DECK)
    problem = read_deck(tmp_path / "deck.yaml")
    study = Study(reduced(problem, problem.prior.mean))
    coarse, (shear,) = study.coarse, study.recipes("timoshenko")
    assert coarse is not study
    x = np.concatenate([np.zeros(study.k), shear.coordinates(np.array([3.0]))])
    own = coarse.own((shear,))
    at, few = study.kind(study.model, (shear,)).point(x), coarse.kind(coarse.model, own).point(x)
    assert few.chi2 > 1.5 * at.chi2
    T, adapted = coarse._adapted(x, own)
    step = adapted @ np.concatenate([at.residual, x[: study.k]])
    left, z = at.residual - T @ step, step[: study.k]
    assert coarse.predicted(few, x, own) == pytest.approx(left @ left + z @ z)
