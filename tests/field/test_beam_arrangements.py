"""Measured: the beam with six masses in twenty known layouts, told from a bare beam by several arrangements in one diagnosis.

Sousa and Machado, doi 10.5281/zenodo.8081690; see test_beam_masses.py for what is known of it.
"""

import json
import re
from itertools import pairwise

import numpy as np
import pytest
from test_beam_masses import AREA, DENSITY, MEASURED, THICKNESS, Beam, L

from mouse_cli.cli.main import _run

SEEN, UNSEEN = range(1, 20, 2), range(2, 21, 2)


BARE = """mouse: 1
title: {title}
units: SI
model:
  structure:
    nodes: {{{nodes}}}
    elements:
      - {{id: 1-35, type: beam, nodes: 0-35, theory: timoshenko, E: 2.1e11, density: {rho}, A: {A:.8g}, Iy: {I:.8g}}}
      - {{id: 41-46, type: mass, nodes: [5, 10, 15, 20, 25, 30], mass: 0}}
    supports: {{0: [TZ, RY]}}
    directions: [TZ, RY]
parameters:
  - {{name: E, elements: 1-35, property: E, sd: 5 %}}
test:
  modes: {{frequency: {frequency}, frequency_sd: 0.4 %}}
"""


def bare_deck(title: str, places: np.ndarray, frequency: np.ndarray) -> str:
    """One layout as a clamped beam: nothing gives way, there is no sensor, and what is attached weighs nothing."""
    ends = np.concatenate([[0.0], places, [L]])
    x = np.append(np.concatenate([np.linspace(a, b, 5, endpoint=False) for a, b in pairwise(ends)]), L)
    nodes = ", ".join(f"{i}: [{v:.6f}, 0, 0]" for i, v in enumerate(x))
    about = {"rho": DENSITY, "A": AREA, "I": AREA * THICKNESS**2 / 12}
    return BARE.format(title=title, nodes=nodes, frequency=np.round(frequency, 3).tolist(), **about)


def asked(beam, *arguments: str) -> dict:
    """What `mouse diagnose` says of decks in the folder of `beam`."""
    out = beam.folder / "told.json"
    assert _run(["diagnose", *arguments, "-q", "--report", str(out)]) == 1
    return json.loads(out.read_text())


@pytest.fixture(scope="module")
def bare(tmp_path_factory):
    """The beam, what several layouts of it lack, and the folder of the decks with that in them."""
    if not MEASURED.exists():
        pytest.skip("the measured data are not beside the project")
    beam = Beam(tmp_path_factory.mktemp("beam"))
    for layout in (*SEEN, *UNSEEN):
        path = beam.folder / f"layout{layout}.yaml"
        path.write_text(bare_deck(f"layout {layout}", beam.places[layout - 1], beam.measured["healthy"][layout - 1]))
    folder = beam.folder / "revised"
    held = [part for k in UNSEEN for part in ("--held-out", str(beam.folder / f"layout{k}.yaml"))]
    fitted = [str(beam.folder / f"layout{k}.yaml") for k in SEEN]
    return beam, asked(beam, *fitted, *held, "-o", str(folder)), folder


@pytest.mark.proof
def test_a_bare_beam_tells_its_masses_and_its_clamp(bare):
    _, found, _ = bare
    masses, clamp, *_ = found["verdict"]["causes"]
    assert (masses["physics"], masses["kind"], masses["site"]["ids"]) == ("items", "named", list(range(41, 47)))
    assert (clamp["group"], clamp["kind"]) == ("support", "named")
    value = {each["name"]: each for each in found["parameters"]}
    each = value["mass of items 41, 42, 43, 44, 45, 46"]
    assert abs(each["posterior"] - 0.0296) < 2 * each["sd"] and each["sd"] < 0.006  # declared as 2.96 % of the beam
    assert abs(value["E"]["posterior"] / 2.1e11 - 1) < 0.05
    before, after = found["held_out"]["baseline"], found["held_out"]["revised"]
    assert after["rms_frequency_error"] < 0.7 * before["rms_frequency_error"]
    assert after["covered"] > 0.8
    assert found["residual"]["p"] > 0.05


@pytest.mark.proof
def test_and_then_which_mass_went(bare):
    """The decks that the first diagnosis wrote are what changed."""
    beam, _, folder = bare
    for layout in SEEN:
        text = (folder / f"layout{layout}.yaml").read_text()
        hz = np.round(beam.measured["damaged"][layout - 1], 3).tolist()
        changed = re.sub(r"frequency: \[[^\]]*\]", f"frequency: {hz}", text)
        (beam.folder / f"changed{layout}.yaml").write_text(changed)
    before = [str(folder / f"layout{k}.yaml") for k in SEEN]
    later = [part for k in SEEN for part in ("--changed", str(beam.folder / f"changed{k}.yaml"))]
    held = [part for k in SEEN[5:] for part in ("--held-out", str(beam.folder / f"changed{k}.yaml"))]
    found = asked(beam, *before, *later, *held)
    (cause,) = found["verdict"]["causes"]
    assert (cause["physics"], cause["site"]["ids"], cause["kind"]) == ("mass-loss", [41], "named")
    (share,) = found["turns"][0]["candidates"][0]["parameters"]
    assert share["value"] + 3 * share["sd"] > 1  # it is gone, whole
    mass = next(each for each in found["parameters"] if each["name"].startswith("mass of items"))
    assert abs(mass["posterior"] - 0.0296) < 2 * mass["sd"]
    before, after = found["held_out"]["baseline"], found["held_out"]["revised"]
    assert after["rms_frequency_error"] < 0.6 * before["rms_frequency_error"]
    assert after["covered"] > 0.8
