"""Supports of one row that are flexible alike, as those of an abutment or of one side of a building are, beside OpenSees; and
frames of which the deck has one element a member.
"""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import mouse_cli
from benchmarks.blind.case import generator
from benchmarks.blind.space import frames
from benchmarks.blind.space.__main__ import written
from benchmarks.blind.test_data import Config
from mouse_cli.diagnosis.effects.support_sets import support_sets
from mouse_cli.diagnosis.search.pared import _within
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import Choices

STOREYS, HEIGHT = 2, 3.2
TWO_BAYS, ONE_BAY = (0.0, 5.0, 11.0), (0.0, 5.0)
WIDTH, SINKING = 4.0, 2e7  # m; N/m


def block(bays: tuple[float, ...] = TWO_BAYS) -> frames.Frame:
    """These bays by one, of STOREYS."""
    corners, w = [(x, y) for y in (0.0, WIDTH) for x in bays], len(bays)
    n = 2 * w
    points = np.array([(x, y, HEIGHT * k) for k in range(STOREYS + 1) for x, y in corners])
    columns = [(n * k + i, n * k + n + i, 0) for k in range(STOREYS) for i in range(n)]
    pairs = [(i, i + 1) for i in range(n - 1) if i + 1 != w] + [(i, i + w) for i in range(w)]
    beams = [(n * k + a, n * k + b, 1) for k in range(1, STOREYS + 1) for a, b in pairs]
    members = np.array([*columns, *beams])
    sections = np.array([[7.1e-3, 6.2e-5, 9.6e-5], [4.4e-3, 2.2e-5, 3.4e-5]])
    kg = np.where(points[:, 2] > 0, 2500.0, 0.0)
    return frames.Frame(points, members[:, :2], members[:, 2], sections, kg)


def deck(folder: Path, bays: tuple[float, ...], modes: int, springs: list) -> str:
    """Of a block on those springs, [foot, direction, N/m or N m/rad], so many modes to be fitted."""
    frame = block(bays)
    inputs = frame.inputs(generator("test", "row of feet")) | {"springs": springs}
    case = frames.case("rows", 0, frame, inputs, Config(16, 0.002, 0.01, modes), "a row of feet", groups=("support",))
    return str(written(case, folder, 1, folder / "truths")[0])


@pytest.mark.proof
def test_a_row_that_sinks_alike_is_one_flexible_support(tmp_path):
    """Both feet at x = 0: one stiffness, which the row has, not one for each foot."""
    pytest.importorskip("openseespy")
    found = mouse_cli.diagnose(mouse_cli.read_deck(deck(tmp_path, TWO_BAYS, 6, [[foot, 3, SINKING] for foot in (0, 3)])))
    (cause,) = found.best.causes
    assert (found.kind, found.best.physics) == ("named", "support-translation")
    assert cause.site.ids == (1, 4) and cause.site.text.endswith("TZ, all alike")
    (size,) = cause.sizes
    assert size.value == pytest.approx(SINKING, abs=3 * size.sd)


def test_a_foot_that_sinks_is_flexible_along_no_other_axis(tmp_path):
    """It is begun along several axes at once, and keeps those that it needs."""
    pytest.importorskip("openseespy")
    problem = mouse_cli.read_deck(deck(tmp_path, ONE_BAY, 6, [[0, 3, SINKING]]))
    found = mouse_cli.diagnose(problem, choices=Choices(candidates=("support-translation",), causes=1))
    (cause,) = found.best.causes
    assert cause.site.text == "the support of node 1, TZ"
    (size,) = cause.sizes
    assert size.value == pytest.approx(SINKING, abs=3 * size.sd)


def test_fewer_directions_are_tried_one_step_at_a_time():
    """One direction less, or one foot less in all of its directions; of feet that have no such recipe, none."""
    of = lambda *dofs: SimpleNamespace(dofs=dofs)
    one = of("1TZ", "1TX", "1TY")
    others = [of("1TZ"), of("1TZ", "1TY"), of("1TX", "1TY"), of("2TZ"), of("1TZ", "2TZ"), of()]
    assert _within(one, others) == others[1:3]
    feet = of("1TZ", "1RX", "2TZ", "2RX")
    fewer = [of("1TZ", "2TZ"), of("1RX", "2RX"), of("1TZ", "1RX"), of("1TZ")]
    assert _within(feet, [feet, *fewer]) == fewer[:3]


def test_modes_that_are_held_out_are_predicted_for_a_finer_mesh(tmp_path):
    """One element a member: members bend in modes 9 and 10, which that puts 10 % off and more; nothing is missing for all that."""
    pytest.importorskip("openseespy")
    problem = mouse_cli.read_deck(deck(tmp_path, ONE_BAY, 8, []))
    found = mouse_cli.diagnose(problem, choices=Choices(candidates=("mass", "crack", "support-rotation")))
    assert found.kind == "nothing-missing"
    assert found.held_out.baseline.rms_frequency_error < 0.01


def test_rows_are_lines_of_supports_that_are_not_all():
    """Of six feet the sides of each direction; of feet in one line, where each row is one foot, none."""
    problem = assemble(yaml_deck.read(f"mouse: 1\n{frames.deck(block())}", "block.yaml"))
    held = [(node, 4) for node in range(6)]
    _, alike = support_sets(problem.mesh, held, np.ones(6))
    rows = [[0, 1, 2], [0, 3], [1, 4], [2, 5], [3, 4, 5]]
    assert alike == [[[0, 1, 2, 3, 4, 5]], *([row] for row in rows)]
    _, alike = support_sets(problem.mesh, held[:2], np.ones(2))
    assert alike == [[[0, 1]]]


def test_one_support_is_flexible_in_any_of_its_directions_together():
    """A mast turns about both axes, or twists as well; of many supports the two directions that bear most are asked."""
    problem = assemble(yaml_deck.read(f"mouse: 1\n{frames.deck(block())}", "block.yaml"))
    single, alike = support_sets(problem.mesh, [(0, d) for d in (3, 4, 5)], np.array([3.0, 1.0, 2.0]))
    assert single == [[[0]], [[1]], [[2]], [[0], [2]], [[0], [1]], [[2], [1]], [[0], [2], [1]]]
    assert alike == []
    single, _ = support_sets(problem.mesh, [(n, d) for n in range(5) for d in (3, 4, 5)], np.tile([3.0, 1.0, 2.0], 5))
    assert single[15:] == [[[3 * n], [3 * n + 2]] for n in range(5)]
