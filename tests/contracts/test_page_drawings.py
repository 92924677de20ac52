"""What pages draw: the structure, its marked places, functions, matrices, records; against decks and closed forms."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import yaml
from page_answers import DECKS, STRUCTURES, Reader, document, made
from report_examples import chain

from mouse_cli import report
from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.model.geometry import Geometry
from mouse_cli.model.structure import Structure
from mouse_cli.page import Part, page
from mouse_cli.page.projection import turned
from mouse_cli.report.frf_document import thinned
from mouse_cli.report.geometry_document import Moved, geometry
from mouse_cli.report.json_values import plain
from mouse_cli.updating.correlate import correlate

LARGEST = 3_000_000


def drawing(name: str) -> dict:
    """The numbers beside the drawing of a page."""
    (stage,) = [e for e in Reader(made(name)).named("svg") if e["attrs"].get("class") == "stage"]
    return json.loads(stage["attrs"]["data-scene"])


@pytest.mark.parametrize("name", STRUCTURES)
def test_every_structure_is_drawn_with_all_its_modes(name):
    geometry = document(name)["geometry"]
    found = Reader(made(name))
    assert len(drawing(name)["p"]) == 3 * len(geometry["positions"])
    assert len(drawing(name)["u"]) == len(geometry["shapes"])
    options = [e["text"] for e in found.named("option")]
    assert [text.partition(",")[0] for text in options] == [str(shape["mode"]) for shape in geometry["shapes"]]
    captions = [e["text"] for e in found.named("figcaption")]
    assert all(any(f"Mode {shape['mode']}, " in text for text in captions) for shape in geometry["shapes"])


def test_test_and_model_stand_on_the_same_points():
    """Squares at the sensors of the deck; where the deck's shape and the model agree they are where the model is."""
    geometry, scene = document("beam")["geometry"], drawing("beam")
    at = {sensor["node"] for sensor in geometry["sensors"]}
    for shape, tested in zip(geometry["shapes"], scene["t"], strict=True):
        assert {node for node, *_ in tested} == at
        for node, *u in tested:
            read = next(t for s, t in zip(geometry["sensors"], shape["test"], strict=True) if s["node"] == node)
            assert u[1] == pytest.approx(1000 * read, abs=1)  # sensors in TY
            assert u[1] == pytest.approx(1000 * shape["displacements"][node][1], abs=40)  # noise of the test


def test_the_sensors_read_what_the_deck_says():
    """`test` is the deck's own column of each mode, up to one factor."""
    deck = yaml.safe_load((DECKS / "cantilever.yaml").read_text())["test"]["modes"]
    geometry = document("beam")["geometry"]
    for shape, column in zip(geometry["shapes"], np.array(deck["shapes"], float).T, strict=True):
        test = np.array(shape["test"])
        assert abs(test @ column) == pytest.approx(np.linalg.norm(test) * np.linalg.norm(column), rel=1e-6)


def test_the_ring_is_at_the_place_that_was_named():
    """3TX of a chain of five equal steps: 0.6 between the ends; it moves with that node alone."""
    scene = drawing("drawn")
    x, y, z, i, j, w = scene["m"][0]
    points = np.array(scene["p"]).reshape(-1, 3)
    assert (x, y, z) == pytest.approx(points[0] + 0.6 * (points[-1] - points[0]), abs=1)
    assert (1 - w) * i + w * j == pytest.approx(3)
    (name,) = [e for e in Reader(made("drawn")).named("text") if "data-mark" in e["attrs"]]
    assert name["text"] == "a spring to the ground"


def test_rivals_are_fainter_the_less_probable():
    rings = [e["attrs"] for e in Reader(made("one-of")).named("circle") if "ring" in e["attrs"].get("class", "")]
    first = rings[: len(drawing("one-of")["m"])]
    assert [ring["class"] for ring in first] == ["ring", *["ring rival"] * (len(first) - 1)]
    faint = [float(ring["stroke-opacity"]) for ring in first[1:]]
    assert len(faint) > 2 and faint == sorted(faint, reverse=True)


def test_a_chain_without_positions_is_drawn_over_its_degrees_of_freedom():
    """Ring at degree of freedom 2; one dot and one square at each of four."""
    found = Reader(made("named"))
    figures = [e for e in found.named("svg") if e["attrs"]["aria-labelledby"].startswith("mode-")]
    assert len(figures) == 4
    circles = [e["attrs"] for e in found.named("circle") if "figure" in e["path"]]
    rings = [c for c in circles if c.get("class") == "ring"]
    dots = [c["cx"] for c in circles if c.get("class") == "after" and c["r"] == "3"]
    assert len(rings) == 4 and {ring["cx"] for ring in rings} == {dots[1]}


def test_views():
    for turn, tilt in ((0, 0), (30, 24), (-135, 80)):
        matrix = turned(turn, tilt)
        assert matrix @ matrix.T == pytest.approx(np.eye(2), abs=1e-12)
    assert turned(0, 90)[1] == pytest.approx([0, 1, 0], abs=1e-12)  # from above: y is up


def test_curves_are_those_of_the_file():
    """20 log10 of what the deck's file holds, every line of it; in the page measured, before and after of each function."""
    rows = (DECKS / "chain_functions" / "functions.csv").read_text().splitlines()[1:]
    table = np.array([[complex(cell.replace("j", "") + "j") for cell in row.split(",")[1:]] for row in rows])
    hz = np.array([float(row.split(",")[0]) for row in rows])
    (fitted,) = document("drawn")["frf"]
    for pair in fitted["curves"]:
        curve = np.array(pair["measured"])
        column = ("1TX", "3TX", "5TX").index(pair["output"])
        inside = np.isin(hz, curve[:, 0])
        assert inside.sum() == len(curve) > 250
        assert curve[:, 1] == pytest.approx(20 * np.log10(np.abs(table[inside, column])), abs=0.006)
    drawn = [e for e in Reader(made("drawn")).named("polyline") if "points" in e["attrs"]]
    for looks in ("measured", "prior", "revised"):
        of = [e for e in drawn if e["attrs"]["class"] == f"line {looks}" and len(e["attrs"]["points"]) > 99]
        assert len(of) >= 3


def test_thinned_curves_keep_their_peaks():
    rng = np.random.default_rng(3)
    x, y = np.arange(50_000.0), rng.standard_normal(50_000)
    y[[1234, 40_000]] = 90.0, -70.0
    found = thinned(x, y)
    assert len(found) <= 600 and (np.diff(found[:, 0]) > 0).all()
    assert [1234.0, 90.0] in found.tolist() and [40_000.0, -70.0] in found.tolist()


def test_matrices_before_and_after_the_cause():
    """The diagonals of the drawn matrices are the MAC values of the document."""
    told = document("named")
    found = Reader(made("named"))
    for key in ("baseline", "extended"):
        (desc,) = [e["text"] for e in found.named("desc") if e["attrs"]["id"] == f"matrix-{key}-description"]
        values = [float(x) for x in re.findall(r"mode \d+ ([01]\.\d{3})", desc)]
        assert values == pytest.approx([mode["mac"] for mode in told[key]["modes"]], abs=6e-4)
    assert len([e for e in found.named("rect") if "tile" in e["attrs"].get("class", "")]) == 32


def test_places_along_a_line():
    """ln P over position, highest at 0.3 m; a structure in space has bars alone."""
    found = Reader(made("drawn"))
    (desc,) = [e["text"] for e in found.named("desc") if e["attrs"]["id"] == "place-along-description"]
    assert "the best is at 0.3" in desc
    assert "place-along" not in made("one-of")


@pytest.mark.parametrize(
    "change",
    [
        {"positions": [[0, 0]]},
        {"positions": [[0, 0, None]]},
        {"positions": [[0, 0, "1"]]},
        {"positions": "many"},
        {"lines": [[0, 99]]},
        {"lines": [[-1, 0]]},
        {"lines": [[0, 1, 2]]},
        {"elements": [[7]]},
        {"elements": [[7, 1e9]]},
        {"sensors": [{"dof": 1, "node": 77}]},
        {"shapes": [{"mode": 1, "displacements": [[0, 0, 0]]}]},
        {"shapes": [{"mode": 1, "displacements": [[0, 0, 1e200]] * 13}]},
    ],
)
def test_damaged_geometry_is_told(change):
    whole = document("beam")
    with pytest.raises(DeckError) as error:
        page(Part({**whole, "geometry": {**whole["geometry"], **change}}, "damaged.json"))
    assert [d.code for d in error.value.diagnostics] == ["MD922"]


def test_elements_that_a_cause_takes_up_are_held_out_in_colour():
    """A stretch of bars: its lines are drawn once more, and the ring is at its middle element."""
    whole = document("beam")
    site = {"kind": "element", "ids": [3, 4, 5], "position": None, "text": "elements 3 to 5"}
    verdict = {"kind": "named", "physics": "tension", "probability": 0.9, "sites": [site]}
    found = Reader(page(Part({**whole, "schema": "mouse.diagnosis/1", "verdict": verdict}, "stretch.json")))
    (scene,) = [json.loads(e["attrs"]["data-scene"]) for e in found.named("svg") if "data-scene" in e["attrs"]]
    assert scene["s"] == [2, 3, 3, 4, 4, 5]
    points = np.array(scene["p"]).reshape(-1, 3)
    assert scene["m"][0][:3] == pytest.approx((points[3] + points[4]) / 2, abs=1)


def test_marks_of_sensors_and_items():
    """A sensor by its name, masses without lines one by one; what is nowhere has no mark."""
    whole = document("beam")
    for kind, ids, nodes in (
        ("sensor", ["7TY"], [6]),
        ("element", [20, 21], [0, 12]),
        ("structure", [], []),
        ("node", [99], []),
    ):
        site = {"kind": kind, "ids": ids, "position": None, "text": "there"}
        verdict = {"kind": "named", "physics": "x", "probability": 0.9, "sites": [site]}
        found = Reader(page(Part({**whole, "schema": "mouse.diagnosis/1", "verdict": verdict}, "marks.json")))
        (scene,) = [json.loads(e["attrs"]["data-scene"]) for e in found.named("svg") if "data-scene" in e["attrs"]]
        points = np.array(scene["p"]).reshape(-1, 3)
        assert np.array([mark[:3] for mark in scene["m"]]).reshape(-1, 3) == pytest.approx(points[nodes], abs=1)


def test_no_shape_and_one_node_are_drawn():
    whole = document("beam")
    one = {"positions": [[1, 2, 3]], "nodes": [5], "lines": [], "elements": [], "sensors": [], "shapes": []}
    Reader(page(Part({**whole, "geometry": one}, "one.json")))
    still = [{**shape, "displacements": [[0, 0, 0]] * 13} for shape in whole["geometry"]["shapes"]]
    Reader(page(Part({**whole, "geometry": {**whole["geometry"], "shapes": still}}, "still.json")))


def large(nodes: int, modes: int) -> dict:
    """The geometry of a square net of nodes that moves in waves."""
    from scipy.sparse import eye_array

    side = int(nodes**0.5)
    grid, n = np.arange(side * side).reshape(side, side), side * side
    positions = np.array([(i / 7, j / 7, 0.0) for i in range(side) for j in range(side)])
    pairs = [(grid[:-1], grid[1:]), (grid[:, :-1], grid[:, 1:])]
    lines = np.concatenate([np.column_stack([a.ravel(), b.ravel()]) for a, b in pairs])
    of = Geometry(np.arange(1, n + 1), positions, np.arange(n), np.full(n, 2), lines)
    structure = Structure(eye_array(n).tocsr(), eye_array(n).tocsr(), geometry=of)
    wave, none = lambda k: np.sin(k * positions[:, 0]) * np.cos(positions[:, 1]), np.zeros(0)
    waves = [Moved(k, 1.0 * k, wave(k), none, none) for k in range(1, modes + 1)]
    return plain(geometry(replace(chain(), structure=structure, test=None), waves))


def test_large_structures_stay_small():
    found = large(40_000, 20)
    assert found["of"] == 40_000 and len(found["positions"]) <= 1500
    assert len(found["lines"]) > len(found["positions"]) - 2  # still one piece
    text = page(Part({**document("beam"), "geometry": found}, "large.json"))
    assert len(text.encode()) < LARGEST
    assert f"Drawn with {len(found['positions'])} of 40000 nodes." in text


def test_sensors_of_a_model_of_matrices_are_named_by_numbers():
    """Its document writes degrees of freedom as numbers, as its deck does."""
    found = json.loads(json.dumps(report.document(correlate(read_deck(DECKS / "sound_chain.yaml")))))
    assert [sensor["name"] for sensor in found["sensors"]] == [1, 2, 3, 4]
    assert "COMAC" in page(Part(found, "chain.json"))
