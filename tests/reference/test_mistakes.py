"""Mistakes of units and tables that engineers make, each made in a sound deck: the answer names it with its remedy.

Truth: the mistake itself. The sound decks are a steel cantilever with its closed-form frequencies and shapes (Blevins, Formulas for
Natural Frequency and Mode Shape, table 8-1) and a chain of equal springs and masses (omega_n = 2 sqrt(k/m) sin((2n-1) pi/(4N+2))).
"""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mouse_cli._errors import ERROR, WARNING, DeckError
from mouse_cli.formats import read_deck, read_draft
from mouse_cli.formats.assemble import assemble
from mouse_cli.updating.loop import run
from mouse_cli.updating.prior_model import examine

BETA = np.array([1.87510407, 4.69409113, 7.85475744, 10.99554073])
SIGMA = (np.cosh(BETA) + np.cos(BETA)) / (np.sinh(BETA) + np.sin(BETA))
NODES = (6, 11, 16, 21)


def _listed(values, digits=6) -> str:
    return "[" + ", ".join(f"{v:.{digits}g}" for v in values) + "]"


def _cantilever() -> tuple[np.ndarray, np.ndarray]:
    """Frequencies of 2 m of steel, 50 mm wide and 20 mm high, in Hz; shapes at NODES of 21 nodes."""
    hz = (BETA / 2.0) ** 2 * np.sqrt(2.1e11 * 3.3333333e-8 / (7850 * 1e-3)) / (2 * np.pi)
    x = BETA * (np.array(NODES)[:, None] - 1) / 20
    return hz, (np.cosh(x) - np.cos(x) - SIGMA * (np.sinh(x) - np.sin(x))) / 2


HZ, SHAPES = _cantilever()
BEAM = f"""mouse: 1
title: Steel cantilever
units: SI
model:
  structure:
    nodes: {{line: {{from: 1, to: 21, start: [0, 0], end: [2.0, 0]}}}}
    materials: {{steel: {{E: 2.1e11, nu: 0.3, density: 7850}}}}
    sections: {{flat: {{A: 1.0e-3, Iz: 3.3333333e-8}}}}
    elements:
      - {{id: 1-20, type: beam, nodes: 1-21, material: steel, section: flat}}
    supports: {{1: all}}
    plane: XY
parameters:
  - {{name: E, material: steel, property: E, sd: 5 %}}
  - {{name: mass of the tip half, elements: 11-20, property: density, factor: true, sd: 5 %}}
test:
  modes:
    frequency: {_listed(HZ)}
    frequency_sd: 0.5 %
    dofs: [6TY, 11TY, 16TY, 21TY]
    shapes:
      - {_listed(SHAPES[0])}
      - {_listed(SHAPES[1])}
      - {_listed(SHAPES[2])}
      - {_listed(SHAPES[3])}
    shape_sd: 0.02
"""
IN_MM = (
    BEAM.replace("units: SI", "units: mm-t-N").replace("[2.0, 0]", "[2000, 0]").replace("2.1e11", "2.1e5")
    .replace("7850", "7.85e-9").replace("1.0e-3", "1000").replace("3.3333333e-8", "33333.333")
)  # fmt: skip
CHAIN_HZ = 2 * np.sqrt(2e6 / 5) * np.sin((2 * np.arange(1, 5) - 1) * np.pi / 18) / (2 * np.pi)
MATRICES = f"""mouse: 1
title: Chain of four masses of 5 kg and springs of 2e6 N/m
model:
  stiffness: {{order: 4, entries: [[1,1,4e6], [1,2,-2e6], [2,2,4e6], [2,3,-2e6], [3,3,4e6], [3,4,-2e6], [4,4,2e6]]}}
  mass: {{diagonal: [5, 5, 5, 5]}}
parameters:
  - {{name: first spring, stiffness: [[1, 1, 1]], sd: 1.0e-3}}
test:
  modes: {{frequency: {_listed(CHAIN_HZ)}, frequency_sd: 0.5 %}}
"""
SPRINGS = f"""mouse: 1
title: Chain of four masses and springs
units: SI
model:
  structure:
    nodes: {{line: {{from: 1, to: 5, start: [0, 0], end: [4, 0]}}}}
    elements:
      - {{type: spring, nodes: 1-5, stiffness: {{TX: 2.0e6}}}}
      - {{type: mass, nodes: 2-5, mass: 5.0}}
    supports: {{1: all}}
    directions: [TX]
parameters:
  - {{name: k1, elements: 1, property: TX, sd: 5 %}}
test:
  modes: {{frequency: {_listed(CHAIN_HZ)}, frequency_sd: 0.5 %}}
"""
_FREQUENCY, _CHAIN_K = _listed(HZ), re.search(r"entries: (.*)\}", MATRICES)[1]


def _k(factor: float) -> str:
    return re.sub(r"(-?[24])e6", lambda at: f"{float(at[1]) * 1e6 * factor:.9g}", _CHAIN_K)


CASES = {  # deck, what is changed into what, code, pattern that the remedy must have
    "E in MPa": (BEAM, "E: 2.1e11", "E: 210000", "MD451", r"MPa.*2\.1e\+11"),
    "E in GPa": (BEAM, "E: 2.1e11", "E: 210", "MD451", r"GPa.*2\.1e\+11"),
    "E in kPa": (BEAM, "E: 2.1e11", "E: 2.1e8", "MD450", r"multiply E by 1000"),
    "E in psi": (BEAM, "E: 2.1e11", "E: 30.46e6", "MD451", r"psi.*2\.1\d*e\+11"),
    "E in ksi": (BEAM, "E: 2.1e11", "E: 30458", "MD451|MD450", r"(ksi|kgf/mm2|MPa)"),
    "density in g/cm3": (BEAM, "density: 7850", "density: 7.85", "MD451", r"g/cm3.*7850"),
    "density in t/mm3": (BEAM, "density: 7850", "density: 7.85e-9", "MD451", r"t/mm3.*7850"),
    "density in kg/mm3": (BEAM, "density: 7850", "density: 7.85e-6", "MD451", r"kg/mm3.*7850"),
    "density in kN/m3": (BEAM, "density: 7850", "density: 77", "MD451", r"kN/m3 \(a weight\).*785"),
    "density in N/m3": (BEAM, "density: 7850", "density: 77000", "MD451", r"N/m3 \(a weight\).*785"),
    "density in lb/in3": (BEAM, "density: 7850", "density: 0.2836", "MD451", r"lb/in3.*785"),
    "E and density in units of mm": (
        BEAM, "E: 2.1e11, nu: 0.3, density: 7850", "E: 210, nu: 0.3, density: 7.85",
        "MD451", r"GPa and g/cm3"),
    "nu in percent": (BEAM, "nu: 0.3", "nu: 30", "MD452", r"0\.3"),
    "nu below -1": (BEAM, "nu: 0.3", "nu: -5", "MD452", r"0\.3"),
    "nu above 0.5": (BEAM, "nu: 0.3", "nu: 0.7", "MD452", r"0\.3"),
    "A in mm2": (BEAM, "A: 1.0e-3", "A: 1000", "MD451", r"A in mm2.*0\.001"),
    "A in cm2": (BEAM, "A: 1.0e-3", "A: 10", "MD451", r"A in cm2.*0\.001"),
    "I in mm4": (BEAM, "Iz: 3.3333333e-8", "Iz: 33333", "MD451", r"I in mm4.*3\.3333e-08"),
    "I in cm4": (BEAM, "Iz: 3.3333333e-8", "Iz: 3.3333", "MD451", r"I in cm4.*3\.3333e-08"),
    "section in mm": (BEAM, "A: 1.0e-3, Iz: 3.3333333e-8", "A: 1000, Iz: 33333", "MD451", r"A and I in mm"),
    "section in cm": (
        BEAM, "A: 1.0e-3, Iz: 3.3333333e-8", "A: 10, Iz: 3.3333", "MD450",
        r"areas by 0\.0001 and second moments by 1e-08"),
    "nodes in mm": (BEAM, "[2.0, 0]", "[2000, 0]", "MD450", r"coordinates of the nodes by 0\.001"),
    "nodes in cm": (BEAM, "[2.0, 0]", "[200, 0]", "MD450", r"coordinates of the nodes by 0\.01"),
    "test in rad/s": (BEAM, _FREQUENCY, _listed(HZ * 2 * np.pi), "MD450", r"divide the frequencies by 2 pi"),
    "test in rpm": (BEAM, _FREQUENCY, _listed(HZ * 60), "MD450", r"divide the frequencies by 60"),
    "test in kHz": (BEAM, _FREQUENCY, _listed(HZ / 1000), "MD450", r"multiply the frequencies by 1000"),
    "test as periods": (BEAM, _FREQUENCY, _listed(1 / HZ), "MD322", r"periods in s"),
    "test as eigenvalues": (BEAM, _FREQUENCY, _listed((2 * np.pi * HZ) ** 2), "MD450", r"roots of the frequencies over 2 pi"),
    "chain in rad/s": (SPRINGS, _listed(CHAIN_HZ), _listed(CHAIN_HZ * 2 * np.pi), "MD450", r"divide the frequencies by 2 pi"),
    "matrices in rad/s": (MATRICES, _listed(CHAIN_HZ), _listed(CHAIN_HZ * 2 * np.pi), "MD450", r"divide the frequencies by 2 pi"),
    "5 Hz for 5 %": (BEAM, "frequency_sd: 0.5 %", "frequency_sd: 5", "MD453", r"5 % if a percentage"),
    "0.003 for 0.3 %": (BEAM, "frequency_sd: 0.5 %", "frequency_sd: 0.003", "MD453", r"0\.3 % if a share"),
    "5 for 5 % of shapes": (BEAM, "shape_sd: 0.02", "shape_sd: 5", "MD453", r"5 % if a percentage"),
    "5 for 5 % of E": (BEAM, "property: E, sd: 5 %", "property: E, sd: 5", "MD453", r"write sd: 5 %"),
    "5 for 5 % of a factor": (BEAM, "factor: true, sd: 5 %", "factor: true, sd: 5", "MD453", r"write sd: 5 %"),
    "damping in percent": (BEAM, "test:\n", "modal_damping: {ratio: 2}\ntest:\n", "MD215", r"%"),
    "negative sd": (BEAM, "shape_sd: 0.02", "shape_sd: -0.02", "MD326", r"standard deviation"),
    "decimal comma in a list": (BEAM, _FREQUENCY, _FREQUENCY.replace("26.", "26,"), "MD228", r"26\.\d"),
    "decimal comma in a value": (BEAM, "nu: 0.3", "nu: '0,3'", "MD213", r"decimal point: 0\.3"),
    "a unit after the number": (BEAM, "E: 2.1e11", "E: 210 GPa", "MD213", r"2\.1e\+11"),
    "a FORTRAN exponent": (BEAM, "E: 2.1e11", "E: 2.1d11", "MD213", r"2\.1e11"),
    "plane misspelt": (BEAM, "plane: XY", "plan: XY", "MD210", r"plane"),
    "material misspelt": (BEAM, "material: steel, section", "material: steal, section", "MD402", r"steel"),
    "supports forgotten": (BEAM, "    supports: {1: all}\n", "", "MD330", r"supports"),
    "a node given twice": (
        BEAM, "nodes: {line: {from: 1, to: 21, start: [0, 0], end: [2.0, 0]}}",
        "nodes:\n      - {line: {from: 1, "
        "to: 11, start: [0, 0], end: [1.0, 0]}}\n      - {line: {from: 11, to: 20, start: [1.1, 0], end: [2.0, 0]}}",
        "MD404", "own number"),
    "K in N/mm": (MATRICES, _CHAIN_K, _k(1e-3), "MD450", r"multiply K by 1000"),
    "K in kN/mm": (MATRICES, _CHAIN_K, _k(1e-6), "MD450", r"multiply K by 1e6"),
    "K in kgf/mm": (MATRICES, _CHAIN_K, _k(1 / 9806.65), "MD450", r"9806\.65"),
    "M in t": (MATRICES, "[5, 5, 5, 5]", "[5e-3, 5e-3, 5e-3, 5e-3]", "MD450", r"multiply M by 1000"),
    "M in g": (MATRICES, "[5, 5, 5, 5]", "[5e3, 5e3, 5e3, 5e3]", "MD450", r"divide M by 1000"),
    "M as weights": (MATRICES, "[5, 5, 5, 5]", "[49.03, 49.03, 49.03, 49.03]", "MD450", r"divide M by 9\.80665"),
    "springs in N/mm": (SPRINGS, "TX: 2.0e6", "TX: 2.0e3", "MD450", r"multiply stiffness by 1000"),
    "masses in g": (SPRINGS, "mass: 5.0", "mass: 5.0e3", "MD450", r"multiply mass by 0\.001"),
    "masses as weights": (SPRINGS, "mass: 5.0", "mass: 49.03", "MD450", r"multiply mass by 0\.10197"),
    "E in Pa beside mm": (IN_MM, "E: 2.1e5", "E: 2.1e11", "MD451", r"Pa.*210000"),
    "density in kg/m3 beside mm": (IN_MM, "density: 7.85e-9", "density: 7850", "MD451", r"kg/m3.*7\.85e-09"),
    "nodes in m beside mm": (IN_MM, "[2000, 0]", "[2.0, 0]", "MD450", r"coordinates of the nodes by 1000"),
}  # fmt: skip


def problem_of(text: str):
    return assemble(read_draft(text.encode(), "deck.yaml"))


def findings(text: str) -> list:
    """All that reading and the first eigensolution say of a deck."""
    told = []
    try:
        problem = problem_of(text)
        told += problem.warnings
        examine(problem)
    except DeckError as error:
        told += error.diagnostics
    return told


@pytest.mark.parametrize("deck", [BEAM, IN_MM, MATRICES, SPRINGS], ids=["beam", "mm", "matrices", "springs"])
def test_the_sound_decks_are_sound(deck):
    assert not findings(deck)
    assert run(problem_of(deck)).exit_code == 0


@pytest.mark.parametrize("name", CASES)
def test_a_mistake_is_answered_with_its_remedy(name):
    deck, sound, mistaken, code, remedy = CASES[name]
    assert deck.count(sound) == 1
    told = findings(deck.replace(sound, mistaken))
    fitting = [d for d in told if re.fullmatch(code, d.code) and re.search(remedy, f"{d.message} {d.help} {d.note}")]
    assert fitting, told
    assert sum(d.severity == ERROR for d in told) <= 1, told  # one cause, one error


@pytest.mark.parametrize(("unrelated", "severity"), [(1, WARNING), (4, ERROR)])
def test_a_mode_that_the_model_has_not_is_an_error_only_where_most_are_such(unrelated, severity):
    """The model may lack what makes one; where most have nothing to do with it the points are in another order."""
    problem = problem_of(BEAM)
    shapes = problem.test.shapes.copy()
    for column in shapes.T[:unrelated]:
        column[:] = np.linalg.svd((column * (1, 1, 1, 0.5))[None, :])[2][-1]  # orthogonal by mass, of which the tip has half
    with_it = replace(problem, test=replace(problem.test, shapes=shapes), run=replace(problem.run, pairing="number"))
    try:
        told = examine(with_it)
    except DeckError as error:
        told = error.diagnostics
    assert [(d.code, d.severity) for d in told] == [("MD331", severity)] and "mouse diagnose" in told[0].help
    with pytest.raises(DeckError):
        run(with_it)


DECKS = sorted((Path(__file__).resolve().parents[2] / "decks").glob("*.yaml"))


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.stem)
def test_sample_decks_are_not_taken_for_mistakes(path):
    problem = read_deck(str(path))
    assert not [d for d in problem.warnings if d.code.startswith("MD45")]
    examine(problem)


def test_a_run_that_ends_below_zero_names_the_property():
    """A rod of 1e3 N/m beside a spring of 1e4 N/m on 1 kg, and a test of 9e3 N/m: E would have to be -1e9 Pa."""
    text = """mouse: 1
units: SI
model:
  structure:
    nodes: {1: [0, 0], 2: [1, 0]}
    elements:
      - {id: 1, type: rod, nodes: [1, 2], E: 1.0e+9, A: 1.0e-6}
      - {id: 2, type: spring, nodes: [2], stiffness: {TX: 1.0e+4}}
      - {id: 3, type: mass, nodes: [2], mass: 1.0}
    supports: {1: all}
    directions: [TX]
parameters: [{name: E of the rod, elements: 1, property: E, sd: 1.0e+11}]
test: {modes: {frequency: [15.0988], frequency_sd: 0.1 %}}
"""
    result = run(problem_of(text))
    assert result.status.key == "impossible" and result.exit_code == 1
    assert "E of the rod became -9.99" in result.status.sentence and "diagnose" in result.status.advice


@pytest.mark.parametrize("short", [1.0, 0.92])
def test_matrices_in_declared_units_are_no_weights_in_others(short):
    """Angular frequencies of a structure 8 % slower than its model lie nearer to 32.174^1/2 than to 2 pi: no lbf beside metres."""
    deck = MATRICES.replace("model:", "units: SI\nmodel:", 1).replace(_listed(CHAIN_HZ), _listed(2 * np.pi * short * CHAIN_HZ))
    (found,) = (each for each in findings(deck) if each.code == "MD450")
    assert "rad/s" in found.message and "2 pi" in found.help and "lbf" not in f"{found.message}{found.note}"


@pytest.mark.parametrize(
    ("units", "E", "density", "means"),
    [("SI", 210000.0, 7.85e-9, "mm-t-N"), ("mm-t-N", 7e10, 2700.0, "SI"), ("SI", 2.1e11, 7850.0, ""),
     ("mm-t-N", 2.1e5, 7.85e-9, ""), ("SI", 90e6, 30.0, "")],
)  # fmt: skip
def test_a_deck_in_other_units_than_its_job_is_told(units, E, density, means):
    """Steel, aluminium and a foam: their E and density by the names that an import gives to parameters."""
    text = f"""
mouse: 1
units: {units}
model:
  stiffness: {{order: 2, entries: [[1, 1, 2], [1, 2, -1], [2, 2, 1]]}}
  mass: {{identity: 2}}
parameters:
  - {{name: E of M, nominal: {E}, sd: 5 %, stiffness: [[1, 1, 1.0e-12]]}}
  - {{name: density of M, nominal: {density}, sd: 1 %, mass: [[1, 1, 1.0e-12]]}}
"""
    said = [each for each in findings(text) if each.code == "MD451"]
    assert [each.help.split(",")[0] for each in said] == ([f"write units: {means}"] if means else [])
