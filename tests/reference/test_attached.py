"""What stands beside, what hangs on a mount that turns, and sensors of another node: truths by matrices of numpy."""

import numpy as np
import pytest
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import NAMED, Choices
from tests.reference.test_mounted_mass import HOST, INERTIA, POINTS, RHO, SENSORS, A, E, element

STOREYS, MASS, STIFFNESS = 7, 1000.0, 4e6  # kg, N/m
BESIDE, TIE, OWN = 900.0, 8e5, 6e5  # what stands beside floor 5: kg, N/m, N/m
BODY, TURN, ARM, MOUNT = 0.8, 6e-3, 0.1, 2.4e2  # kg, kg m2, m along Y, N m/rad
MODES = 6


def read(text: str):
    return assemble(yaml_deck.read(text, "deck.yaml"))


def modes(K, M, rows, seed: int, m: int = MODES) -> str:
    """Section `modes` of a test: frequencies and what sensors see of shapes, with noise; `rows` of matrices by sensors."""
    rng = np.random.default_rng(seed)
    rates, X = eigh(K, M)
    hz = np.sqrt(rates[:m]) / (2 * np.pi) * (1 + 1e-3 * rng.standard_normal(m))
    shapes = X[list(rows.values()), :m] / np.abs(X[list(rows.values()), :m]).max(axis=0)
    shapes = shapes + 0.01 * rng.standard_normal(shapes.shape)
    return f"""\
test:
  modes:
    dofs: [{", ".join(rows)}]
    frequency: {hz.tolist()}
    frequency_sd: 0.1 %
    shapes: {shapes.tolist()}
    shape_sd: 0.01
"""


def test_a_building_next_door_is_named_by_its_floor_mass_and_ties():
    n = STOREYS + 1
    K, M = np.zeros((n, n)), np.diag([*[MASS] * STOREYS, BESIDE])
    for i in range(STOREYS):
        K[i, i] += STIFFNESS
        if i:
            K[i - 1 : i + 1, i - 1 : i + 1] += STIFFNESS * np.array([[0, -1], [-1, 0]])
            K[i - 1, i - 1] += STIFFNESS
    K[4, 4], K[-1, -1] = K[4, 4] + TIE, TIE + OWN
    K[4, -1] = K[-1, 4] = -TIE
    deck = f"""\
mouse: 1
model:
  structure:
    nodes: {{{", ".join(f"{i}: [0, {3 * i}]" for i in range(n))}}}
    elements:
      - {{id: 1-{STOREYS}, type: storey, nodes: 0-{STOREYS}, TX: {STIFFNESS}}}
      - {{id: 11-{10 + STOREYS}, type: mass, nodes: 1-{STOREYS}, mass: {MASS}}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: k, elements: 1-{STOREYS}, property: TX, factor: true, sd: 5 %}}
{modes(K, M, {f"{i + 1}TX": i for i in range(STOREYS)}, 3)}"""
    found = diagnose(read(deck), choices=Choices(causes=2))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.ids) == (NAMED, "neighbour", ("5TX",))
    hz = np.sqrt(OWN / BESIDE) / (2 * np.pi)
    truth = {"mass": BESIDE, "frequency by itself": hz, "stiffness of the tie over its own": TIE / OWN}
    sizes = {one.name: one for one in cause.sizes}
    assert set(sizes) == set(truth)
    for name, value in truth.items():
        assert abs(sizes[name].value - value) < 3 * sizes[name].sd < value, name


def bars(n: int) -> tuple[np.ndarray, np.ndarray]:
    """K and M (n, n) of the upright and its arm, held nowhere, in the first of n degrees of freedom."""
    K, M = np.zeros((n, n)), np.zeros((n, n))
    for i in range(len(POINTS) - 1):
        at = slice(3 * i, 3 * i + 6)
        for whole, own in zip((K, M), element(*POINTS[i : i + 2]), strict=True):
            whole[at, at] += own
    return K, M


def plane(body: bool) -> tuple[np.ndarray, np.ndarray]:
    """K and M of the upright and its arm, held at the foot; a body on HOST whose turn is a degree of freedom of its own."""
    n = 3 * len(POINTS) + body
    K, M = bars(n)
    if body:
        x, y, turn = 3 * HOST, 3 * HOST + 1, n - 1
        M[[x, y], [x, y]] += BODY
        M[x, turn] = M[turn, x] = -BODY * ARM  # the centre is above the node
        M[turn, turn] = TURN + BODY * ARM**2
        own = np.ix_([3 * HOST + 2, turn], [3 * HOST + 2, turn])
        K[own] += MOUNT * np.array([[1, -1], [-1, 1]])
    return K[3:, 3:], M[3:, 3:]


def deck_of_plane(measured: str, more: str = "") -> str:
    return f"""\
mouse: 1
model:
  structure:
    nodes: {{{", ".join(f"{i}: {xy.tolist()}" for i, xy in enumerate(POINTS, 1))}}}
    elements:
      - {{id: 1-14, type: beam, nodes: 1-15, E: {E}, A: {A}, Iz: {INERTIA}, density: {RHO}}}
{more}    supports: {{1: all}}
    plane: XY
parameters:
  - {{name: E, elements: 1-14, property: E, sd: 3 %, transform: log}}
{measured}"""


def test_a_body_whose_mount_turns_is_named_with_its_stiffness():
    K, M = plane(True)
    rows = {f"{node + 1}T{'XY'[d]}": 3 * node + d - 3 for node, d in SENSORS}
    rigid = f"      - {{id: 21, type: mass, nodes: [{HOST + 1}], mass: {BODY}, Jz: {TURN}, offset: [0, {ARM}, 0]}}\n"
    rivals = "mount-rotation", "extended-mass", "joint", "rotary-inertia", "sprung-mass"
    found = diagnose(read(deck_of_plane(modes(K, M, rows, 4), rigid)), choices=Choices(rivals, causes=1))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "mount-rotation", "mass 21, about Z")
    (k,) = cause.sizes
    assert abs(k.value - MOUNT) < 3 * k.sd < 0.2 * MOUNT


def test_a_foot_that_lifts_and_turns_is_one_loose_support():
    """It was a translation and a rotation, each of all supports."""
    K, M = bars(3 * len(POINTS))
    lifts, turns = 2e5, 8e2  # N/m, N m/rad
    K[1, 1], K[2, 2] = K[1, 1] + lifts, K[2, 2] + turns
    rows = {f"{node + 1}T{'XY'[d]}": 3 * node + d - 1 for node, d in SENSORS}
    rivals = "loose-support", "support-translation", "support-rotation", "mass"
    found = diagnose(read(deck_of_plane(modes(K[1:, 1:], M[1:, 1:], rows, 6))), choices=Choices(rivals, causes=2))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "loose-support", "the support of node 1, TY and RZ")
    for size, true in zip(cause.sizes, (lifts, turns), strict=True):
        assert abs(size.value - true) < 3 * size.sd < 0.3 * true


@pytest.mark.parametrize(
    ("true", "text"),
    [({"6TX": "8TX", "6TY": "8TY"}, "sensors 6TX and 6TY, at 8TX and 8TY"), ({"12TX": "12TY"}, "sensor 12TX, at 12TY")],
)
def test_sensors_of_another_node_or_direction_are_named(true, text):
    K, M = plane(False)
    labels = ["3TX", "4TX", "6TX", "6TY", "9TX", "9TY", "11TY", "12TX", "15TX", "15TY"]
    place = lambda label: 3 * int(label[:-2]) - 6 + "XY".index(label[-1])
    rows = {label: place(true.get(label, label)) for label in labels}
    rivals = "sensor-node", "sensor-swap", "sensor-turned", "sensor-sign", "mass"
    found = diagnose(read(deck_of_plane(modes(K, M, rows, 5))), choices=Choices(rivals, causes=1))
    (cause,) = found.best.causes
    assert (found.kind, cause.physics, cause.site.text) == (NAMED, "sensor-node", text)
