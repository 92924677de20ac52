"""Supports of one row that are flexible alike, as those of an abutment or of one side of a building are, beside OpenSees."""

import numpy as np
import pytest

import mouse_cli
from benchmarks.blind.case import generator
from benchmarks.blind.space import frames
from benchmarks.blind.space.__main__ import written
from benchmarks.blind.test_data import Config
from mouse_cli.diagnosis.effects.support_sets import support_sets
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble

STOREYS, BAY, HEIGHT = 2, (5.0, 4.0), 3.2
FEW, TURN = (0, 2), 8e6  # feet at x = 0; N m/rad


def tower() -> frames.Frame:
    """One bay by one, of STOREYS."""
    corners = [(x, y) for y in (0.0, BAY[1]) for x in (0.0, BAY[0])]
    points = np.array([(x, y, HEIGHT * k) for k in range(STOREYS + 1) for x, y in corners])
    columns = [(4 * k + i, 4 * k + 4 + i, 0) for k in range(STOREYS) for i in range(4)]
    beams = [(4 * k + a, 4 * k + b, 1) for k in range(1, STOREYS + 1) for a, b in ((0, 1), (2, 3), (0, 2), (1, 3))]
    members = np.array([*columns, *beams])
    sections = np.array([[7.1e-3, 6.2e-5, 9.6e-5], [4.4e-3, 2.2e-5, 3.4e-5]])
    kg = np.where(points[:, 2] > 0, 2500.0, 0.0)
    return frames.Frame(points, members[:, :2], members[:, 2], sections, kg)


def test_a_row_that_turns_alike_is_one_flexible_support(tmp_path):
    """Two of four feet, about one axis: one stiffness, which the row has, not one for each foot."""
    pytest.importorskip("openseespy")
    frame = tower()
    inputs = frame.inputs(generator("test", "row of feet")) | {"springs": [[foot, 5, TURN] for foot in FEW]}
    config = Config(14, 0.002, 0.01, frames.FITTED)
    case = frames.case("rows", 0, frame, inputs, config, "a row of feet", groups=("support",))
    path, _ = written(case, tmp_path, 1, tmp_path / "truths")
    found = mouse_cli.diagnose(mouse_cli.read_deck(str(path)))
    (cause,) = found.best.causes
    assert (found.kind, found.best.physics) == ("named", "support-rotation")
    assert cause.site.ids == tuple(foot + 1 for foot in FEW) and cause.site.text.endswith("RY, all alike")
    (size,) = cause.sizes
    assert size.value == pytest.approx(TURN, abs=3 * size.sd)


def test_rows_are_lines_of_supports_that_are_not_all():
    """Of four feet the two sides of each direction; of feet in one line, where each row is one foot, none."""
    problem = assemble(yaml_deck.read(f"mouse: 1\n{frames.deck(tower())}", "tower.yaml"))
    held = [(node, 4) for node in range(4)]
    _, alike = support_sets(problem.mesh, held, np.ones(4))
    assert alike == [[[0, 1, 2, 3]], [[0, 1]], [[0, 2]], [[1, 3]], [[2, 3]]]
    _, alike = support_sets(problem.mesh, held[:2], np.ones(2))
    assert alike == [[[0, 1]]]
