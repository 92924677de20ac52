"""What every candidate must keep: its change of the reduced model is what the deck it writes has, and that deck reads back."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search import superposed
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import assembly

STEEL = "materials: {steel: {E: 2.1e+11, nu: 0.3, density: 7850}}"
CANTILEVER = f"""
  structure:
    nodes: {{line: {{from: 1, to: 31, start: [0, 0], end: [1.5, 0]}}}}
    {STEEL}
    sections: {{bar: {{rectangle: [0.02, 0.03]}}}}
    elements:
      - {{id: 1-30, type: beam, nodes: 1-31, material: steel, section: bar}}
"""
MODELS = {
    "cantilever": (
        CANTILEVER + "    supports: {1: all}\n    plane: XY\n",
        [(9, "TY"), (17, "TY"), (24, "TY"), (31, "TY")],
    ),
    "laden": (
        CANTILEVER + "      - {id: 41-42, type: mass, nodes: [12, 21], mass: 0}\n"
        "      - {id: 43, type: mass, nodes: [31], mass: 1.5, Jz: 2.0e-3}\n"
        "    supports: {1: all}\n    plane: XY\n",
        [(9, "TY"), (17, "TY"), (24, "TY"), (31, "TY")],
    ),
    "girder": (
        CANTILEVER + "    supports: {1: [TX, TY], 31: [TY]}\n    plane: XY\n",
        [(4, "TY"), (9, "TY"), (17, "TY"), (24, "TY")],
    ),
    "bedded": (
        CANTILEVER + "      - {id: 51-80, type: foundation, nodes: 1-31, ky: 3.0e+5}\n    plane: XY\n",
        [(1, "TY"), (11, "TY"), (18, "TY"), (31, "TY")],
    ),
    "free": (CANTILEVER + "    plane: XY\n", [(1, "TY"), (11, "TY"), (18, "TY"), (31, "TY")]),
    "portal": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 9, start: [0, 0], end: [0, 2]}}}}
      - {{line: {{from: 11, to: 19, start: [3, 0], end: [3, 2]}}}}
      - {{line: {{from: 20, to: 26, start: [0.375, 2], end: [2.625, 2]}}}}
    {STEEL}
    sections: {{column: {{rectangle: [0.04, 0.05]}}, beam: {{rectangle: [0.05, 0.05]}}}}
    elements:
      - {{id: 1-8, type: beam, nodes: 1-9, material: steel, section: column}}
      - {{id: 11-18, type: beam, nodes: 11-19, material: steel, section: column}}
      - {{id: 21-28, type: beam, nodes: [9, 20-26, 19], material: steel, section: beam}}
    supports: {{1: all, 11: all}}
    plane: XY
""",
        [(5, "TX"), (9, "TX"), (15, "TX"), (23, "TY")],
    ),
    "tee": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 17, start: [0, 2], end: [3, 2]}}}}
      - {{line: {{from: 21, to: 30, start: [1.5, 0], end: [1.5, 1.8]}}}}
    {STEEL}
    sections: {{bar: {{rectangle: [0.04, 0.05]}}}}
    elements:
      - {{id: 1-16, type: beam, nodes: 1-17, material: steel, section: bar}}
      - {{id: 21-30, type: beam, nodes: [21-30, 9], material: steel, section: bar}}
    supports: {{21: all}}
    plane: XY
""",
        [(1, "TY"), (5, "TY"), (13, "TY"), (17, "TY"), (26, "TX")],
    ),
    "armed": (
        CANTILEVER + "      - {id: 43, type: mass, nodes: [31], mass: 1.5, Jz: 2.0e-3, offset: [0.02, 0.06, 0]}\n"
        "    supports: {1: all}\n    plane: XY\n",
        [(9, "TY"), (17, "TY"), (24, "TY"), (31, "TY")],
    ),
    "clad": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 9, start: [0, 2], end: [3, 2]}}}}
      - {{line: {{from: 21, to: 26, start: [1.5, 0], end: [1.5, 1.8]}}}}
    {STEEL}
    sections: {{bar: {{rectangle: [0.04, 0.05]}}}}
    elements:
      - {{id: 1-8, type: beam, nodes: 1-9, material: steel, section: bar, nonstructural_mass: 6}}
      - {{id: 21-26, type: beam, nodes: [21-26, 5], material: steel, section: bar, nonstructural_mass: 4}}
    supports: {{21: all}}
    plane: XY
""",
        [(1, "TY"), (3, "TY"), (7, "TY"), (9, "TY"), (24, "TX")],
    ),
    "space": (
        f"""
  structure:
    nodes: {{line: {{from: 1, to: 21, start: [0, 0, 0], end: [1.0, 0.3, 0.2]}}}}
    {STEEL}
    sections: {{bar: {{rectangle: [0.02, 0.035]}}}}
    elements:
      - {{id: 1-20, type: beam, nodes: 1-21, material: steel, section: bar}}
    supports: {{1: all}}
""",
        [(8, "TY"), (8, "TZ"), (14, "TY"), (14, "TZ"), (21, "TY"), (21, "TZ")],
    ),
    "tower": (
        f"""
  structure:
    nodes:
      - {{1: [0, 0, 0], 2: [2, 0, 0], 3: [2, 2.7, 0], 4: [0, 2.7, 0], 5: [0, 0, 3], 6: [2, 0, 3], 7: [2, 2.7, 3], 8: [0, 2.7, 3]}}
      - {{line: {{from: 11, to: 14, start: [0, 0, 0.6], end: [0, 0, 2.4]}}}}
      - {{line: {{from: 21, to: 24, start: [2, 0, 0.6], end: [2, 0, 2.4]}}}}
      - {{line: {{from: 31, to: 34, start: [2, 2.7, 0.6], end: [2, 2.7, 2.4]}}}}
      - {{line: {{from: 41, to: 44, start: [0, 2.7, 0.6], end: [0, 2.7, 2.4]}}}}
      - {{line: {{from: 51, to: 52, start: [0.7, 0, 3], end: [1.3, 0, 3]}}}}
      - {{line: {{from: 61, to: 62, start: [2, 0.9, 3], end: [2, 1.8, 3]}}}}
      - {{line: {{from: 71, to: 72, start: [1.3, 2.7, 3], end: [0.7, 2.7, 3]}}}}
      - {{line: {{from: 81, to: 82, start: [0, 1.8, 3], end: [0, 0.9, 3]}}}}
    {STEEL}
    sections: {{column: {{rectangle: [0.2, 0.25]}}, beam: {{rectangle: [0.15, 0.2]}}}}
    elements:
      - {{id: 11-15, type: beam, nodes: [1, 11-14, 5], material: steel, section: column}}
      - {{id: 21-25, type: beam, nodes: [2, 21-24, 6], material: steel, section: column}}
      - {{id: 31-35, type: beam, nodes: [3, 31-34, 7], material: steel, section: column}}
      - {{id: 41-45, type: beam, nodes: [4, 41-44, 8], material: steel, section: column}}
      - {{id: 51-53, type: beam, nodes: [5, 51-52, 6], material: steel, section: beam}}
      - {{id: 61-63, type: beam, nodes: [6, 61-62, 7], material: steel, section: beam}}
      - {{id: 71-73, type: beam, nodes: [7, 71-72, 8], material: steel, section: beam}}
      - {{id: 81-83, type: beam, nodes: [8, 81-82, 5], material: steel, section: beam}}
      - {{id: 91-94, type: mass, nodes: [5, 6, 7, 8], mass: [900, 1000, 1100, 800]}}
    supports: {{1: all, 2: all, 3: all, 4: all}}
""",
        [(5, "TX"), (5, "TY"), (7, "TX"), (7, "TY"), (8, "TX")],
    ),
    "frame": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 5, start: [0, 0, 0], end: [0, 0, 3]}}}}
      - {{line: {{from: 11, to: 15, start: [4, 0, 0], end: [4, 0, 3]}}}}
      - {{line: {{from: 21, to: 25, start: [4, 5, 0], end: [4, 5, 3]}}}}
      - {{line: {{from: 31, to: 35, start: [0, 5, 0], end: [0, 5, 3]}}}}
      - {{line: {{from: 41, to: 43, start: [1, 0, 3], end: [3, 0, 3]}}}}
      - {{line: {{from: 51, to: 53, start: [4, 1.25, 3], end: [4, 3.75, 3]}}}}
      - {{line: {{from: 61, to: 63, start: [3, 5, 3], end: [1, 5, 3]}}}}
      - {{line: {{from: 71, to: 73, start: [0, 3.75, 3], end: [0, 1.25, 3]}}}}
    {STEEL}
    sections: {{column: {{rectangle: [0.1, 0.12]}}, beam: {{rectangle: [0.08, 0.1]}}, bar: {{rectangle: [0.07, 0.1]}}}}
    elements:
      - {{id: 1-4, type: beam, nodes: 1-5, material: steel, section: column}}
      - {{id: 11-14, type: beam, nodes: 11-15, material: steel, section: column}}
      - {{id: 21-24, type: beam, nodes: 21-25, material: steel, section: column}}
      - {{id: 31-34, type: beam, nodes: 31-35, material: steel, section: column}}
      - {{id: 41-44, type: beam, nodes: [5, 41-43, 15], material: steel, section: beam, nonstructural_mass: 5}}
      - {{id: 51-54, type: beam, nodes: [15, 51-53, 25], material: steel, section: beam}}
      - {{id: 61-64, type: beam, nodes: [25, 61-63, 35], material: steel, section: beam}}
      - {{id: 71-74, type: beam, nodes: [35, 71-73, 5], material: steel, section: bar}}
    supports: {{1: all, 11: all, 21: all, 31: all}}
""",
        [(5, "TX"), (5, "TY"), (15, "TX"), (15, "TY"), (25, "TX"), (25, "TY"), (42, "TZ"), (52, "TZ")],
    ),
    "weighed": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 9, start: [0, 0], end: [0, 2]}}}}
      - {{line: {{from: 11, to: 19, start: [3, 0], end: [3, 2]}}}}
      - {{line: {{from: 20, to: 26, start: [0.375, 2], end: [2.625, 2]}}}}
    {STEEL}
    sections: {{column: {{rectangle: [0.04, 0.05]}}, beam: {{rectangle: [0.05, 0.05]}}}}
    elements:
      - {{id: 1-8, type: beam, nodes: 1-9, material: steel, section: column}}
      - {{id: 11-18, type: beam, nodes: 11-19, material: steel, section: column}}
      - {{id: 21-28, type: beam, nodes: [9, 20-26, 19], material: steel, section: beam}}
      - {{id: 31-32, type: mass, nodes: [9, 19], mass: 5000}}
    supports: {{1: all, 11: all}}
    plane: XY
    gravity: [0, -9.81, 0]
""",
        [(5, "TX"), (9, "TX"), (15, "TX"), (23, "TY")],
    ),
    "pinned": (
        f"""
  structure:
    nodes:
      - {{line: {{from: 1, to: 9, start: [0, 0], end: [0, 2]}}}}
      - {{line: {{from: 11, to: 19, start: [3, 0], end: [3, 2]}}}}
      - {{line: {{from: 20, to: 26, start: [0.375, 2], end: [2.625, 2]}}}}
    {STEEL}
    sections: {{bar: {{rectangle: [0.04, 0.05]}}}}
    elements:
      - {{id: 1-8, type: beam, nodes: 1-9, material: steel, section: bar}}
      - {{id: 11-18, type: beam, nodes: 11-19, material: steel, section: bar}}
      - {{id: 21-28, type: beam, nodes: [9, 20-26, 19], material: steel, section: bar}}
    supports: {{1: [TX, TY], 11: [TX, TY]}}
    plane: XY
""",
        [(5, "TX"), (9, "TX"), (15, "TX"), (23, "TY")],
    ),
    "storeys": (
        """
  structure:
    nodes: {line: {from: 0, to: 5, start: [0, 0, 0], end: [0, 0, 15]}}
    elements:
      - {id: 1-5, type: storey, nodes: 0-5, TX: [3.0e+6, 3.0e+6, 2.5e+6, 2.0e+6, 2.0e+6]}
      - {id: 11-15, type: mass, nodes: 1-5, mass: 10000}
    supports: {0: all}
    directions: [TX]
""",
        [(1, "TX"), (3, "TX"), (5, "TX")],
    ),
    "masses": (
        """
  structure:
    nodes: {1: [0, 0, 0], 2: [1, 0, 0], 3: [2, 0, 0], 4: [3, 0, 0]}
    elements:
      - {id: 1-4, type: mass, nodes: 1-4, mass: [1, 1.2, 0.9, 1.1]}
      - {id: 11-13, type: spring, nodes: 1-4, TX: 1000}
      - {id: 14, type: spring, nodes: [1], TX: 1100}
    directions: [TX]
""",
        [(1, "TX"), (2, "TX"), (4, "TX")],
    ),
    "matrices": (
        """
  stiffness: {order: 4, entries: [[1, 1, 2100], [1, 2, -1000], [2, 2, 2000], [2, 3, -1000], [3, 3, 2000],
    [3, 4, -1000], [4, 4, 1000]]}
  mass: {diagonal: [1, 1.2, 0.9, 1.1]}
parameters:
  - {name: k1, nominal: 1100, sd: 100, stiffness: [[1, 1, 1]]}
  - {name: all, nominal: 1, sd: 0.1, stiffness: [[2, 2, 2000], [2, 3, -1000], [3, 3, 2000], [3, 4, -1000], [4, 4, 1000]]}
""",
        [(1, ""), (2, ""), (4, "")],
    ),
    "shells": (
        """
  stiffness: {order: 4, entries: [[1, 1, 2100], [1, 2, -1000], [2, 2, 2000], [2, 3, -1000], [3, 3, 2000],
    [3, 4, -1000], [4, 4, 1000]]}
  mass: {diagonal: [1, 1.2, 0.9, 1.1]}
  sets: {SKIN: {stiffness: {file: K.csv}, mass: {file: M.csv}, thickness: {nominal: 0.003, unit: m, powers: {
    1: {stiffness: {file: K_1.csv}, mass: {file: M.csv}}, 3: {stiffness: {file: K_3.csv}}}}}}
parameters:
  - {name: k1, nominal: 1100, sd: 100, stiffness: [[1, 1, 1]]}
""",
        [(1, ""), (2, ""), (4, "")],
    ),
}
FILES = {  # springs of a set between 2, 3 and 4, and masses of it
    "K.csv": "0,0,0,0\n0,500,-500,0\n0,-500,1200,-700\n0,0,-700,700\n",
    "K_1.csv": "0,0,0,0\n0,100,-100,0\n0,-100,400,-300\n0,0,-300,300\n",
    "K_3.csv": "0,0,0,0\n0,400,-400,0\n0,-400,800,-400\n0,0,-400,400\n",
    "M.csv": "0,0,0,0\n0,0.5,0,0\n0,0,0.5,0\n0,0,0,0.5\n",
}


def deck(name: str, folder) -> "Problem":  # noqa: F821
    """A model of MODELS whose test is its own first three elastic modes."""
    model, sensors = MODELS[name]
    for file, text in FILES.items():
        (folder / file).write_text(text)
    parameters = "" if "parameters:" in model else _PARAMETERS[name]
    rows = "\n".join(f"      - [{1 + i}, {(-1) ** i}, {2 - i}]" for i in range(len(sensors)))
    dofs = ", ".join(f"{node}{direction}" for node, direction in sensors)
    text = (
        f"mouse: 1\ntitle: {name}\nmodel:{model}{parameters}test:\n  modes:\n    number: [1, 2, 3]\n    frequency: [1, 2, 3]\n"
        f"    frequency_sd: 0.5 %\n    dofs: [{dofs}]\n    shapes:\n{rows}\n    shape_sd: 0.03\n"
    )
    path = folder / f"{name}.yaml"
    path.write_text(text)
    problem = read_deck(str(path))
    K, M = (dense(part) for part in assembly(problem).matrices(problem.prior.mean))
    eigenvalues, X = eigh(K, M)
    elastic = np.flatnonzero(eigenvalues > 1e-3 * eigenvalues[min(4, len(X) - 1)])[:3]
    hz = np.sqrt(eigenvalues[elastic]) / (2 * np.pi)
    shapes = problem.test.read(X[:, elastic])
    shapes = shapes / np.abs(shapes).max(axis=0)
    test = replace(problem.test, number=elastic + 1, frequency_hz=hz, frequency_sd_hz=0.005 * hz, shapes=shapes)
    return replace(problem, test=test)


_E = "parameters:\n  - {name: E, material: steel, property: E, sd: 3 %}\n"
_PARAMETERS = dict.fromkeys(
    ("cantilever", "bedded", "girder", "free", "portal", "tee", "space", "tower", "frame", "weighed", "pinned", "armed"), _E
)
_PARAMETERS["laden"] = _E + "  - {name: tip, elements: 43, property: mass, sd: 30 %}\n"
_PARAMETERS["frame"] = _E + "  - {name: load, elements: 41-44, property: nonstructural_mass, sd: 20 %}\n"
_PARAMETERS["clad"] = (
    _E + "  - {name: cladding, elements: 1-8, property: nonstructural_mass, factor: true, nominal: 1.1, sd: 5 %}\n"
    "  - {name: lining, elements: 21-26, property: nonstructural_mass, nominal: 5, sd: 5 %}\n"
)
_PARAMETERS["storeys"] = "parameters:\n  - {name: storey, elements: 1-5, property: TX, factor: true, sd: 10 %}\n"
_PARAMETERS["masses"] = "parameters:\n  - {name: k, elements: 11-13, property: TX, sd: 10 %}\n"
SUPPORTS = {"support-rotation", "support-translation", "rocking"}
OWN = {
    "tee": {"joint"},
    "frame": SUPPORTS | {"member", "added-mass", "taper", "turned-section"},
    "weighed": SUPPORTS,
    "pinned": {"support-restraint"},
    "girder": {"eccentric-bearing"},
    "bedded": {"void"},
    "armed": {"sprung-mass", "item-offset", "mass-loss", "mount-rotation"},
    "clad": {"added-mass", "floor-mass", "taper"},
}
CASES = [(name, key) for name in MODELS for key in registry() if key in OWN.get(name, {key})]
LONG = {  # structures whose like, a smaller one, has the same mechanisms, but for these
    "tower": {"thermal", "semi-rigid", "floor-mass"},
    "frame": SUPPORTS | {"member"},
    "laden": {"items", "item-offset", "sprung-mass", "mass-loss"},
    "free": {"inclined-spring", "mass", "crack"},
}
SHORT = [(name, key) for name, key in CASES if key in LONG.get(name, {key})]


class Reduction(dict):
    """The reduced model of each of MODELS, when first asked for."""

    def __init__(self, folder):
        self.folder = folder

    def __missing__(self, name):
        problem = deck(name, self.folder)
        self[name] = reduced(problem, problem.prior.mean)
        return self[name]


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    return Reduction(tmp_path_factory.mktemp("models"))


def sizes(recipe):
    """Values of the unknowns inside their ranges, the smaller causes first."""
    bounds = recipe.bounds
    for share, place in ((0.25, 0.37), (0.5, 0.71)):
        at = [
            low + (place if unknown.unit == "m" and not unknown.log else share) * (high - low)
            for unknown, (low, high) in zip(recipe.unknowns, bounds, strict=True)
        ]
        yield recipe.values(np.array(at))


def changed(model, recipe, values):
    """K, M and sensing of the reduced model with the mechanism."""
    K, M, S = Model(model, (recipe,)).added(np.append(model.z, recipe.coordinates(values)))
    K[: model.r, : model.r] += np.diag(model.eigenvalues)
    M[: model.r, : model.r] += np.eye(model.r)
    S[:, : model.r] += model.sensing
    return K, M, S


def lowest(K, M, seen):
    """The four lowest eigenvalues that are no rigid motions, and seen seen' (s, s) of each cluster of them."""
    about = eigh(K, M, eigvals_only=True)
    shift = (
        2 * abs(about[0]) + 0.01 * about[min(4, len(about) - 1)]
    )  # of the inverse pencil, exact beside very stiff springs
    inverse, X = eigh(M, K + shift * M)
    eigenvalues, X = 1 / inverse[::-1] - shift, X[:, ::-1] / np.sqrt(inverse[::-1])
    first = int((eigenvalues < 1e-4 * eigenvalues[4 if len(X) > 6 else -1]).sum())
    found, X = eigenvalues[first : first + 4], X[:, first:]
    ends = [i + 1 for i in range(len(found)) if first + i + 1 == len(eigenvalues) or _apart(eigenvalues, first + i)]
    clusters = [seen(X[:, a:b]) for a, b in zip([0, *ends], ends, strict=False)]
    return found, [part @ part.T for part in clusters]


def _apart(eigenvalues, i):
    return eigenvalues[i + 1] > 1.01 * eigenvalues[i]


@pytest.mark.parametrize(("name", "key"), proofs(CASES, *SHORT))
def test_the_deck_with_the_cause_is_the_reduced_model_with_it(models, name, key, tmp_path):
    model = models[name]
    recipes = registry()[key].recipes(model, registry()[key])
    if not recipes:
        pytest.skip("this structure has no place for it")
    for recipe in recipes[:: max(1, len(recipes) // 3)]:
        assert recipe.candidate.key == key
        assert recipe.grid.shape[1] == len(recipe.unknowns)
        for values in sizes(recipe):
            K, M, S = changed(model, recipe, values)
            assert np.allclose(K, K.T, rtol=1e-9, atol=1e-9 * np.abs(K).max())
            assert np.allclose(M, M.T, rtol=1e-9, atol=1e-12 * np.abs(M).max())
            assert np.linalg.eigvalsh(M).min() > 0
            assert recipe.site(values).text
            if np.linalg.eigvalsh(K)[0] < -1e-9 * np.abs(K).max():
                continue  # it would buckle
            extended = recipe.extend(model.problem, values)
            total = [dense(part) for part in assembly(extended).matrices(extended.prior.mean)]
            expected, seen = lowest(K, M, lambda X, S=S: S @ X)
            found, read = lowest(*total, extended.test.read)
            assert found == pytest.approx(expected, rel=1e-3), (recipe.site(values), values)
            scale = max(np.abs(part).max() for part in seen)
            for one, other in zip(read, seen, strict=True):
                assert one == pytest.approx(other, abs=0.02 * max(np.abs(other).max(), 1e-3 * scale)), (
                    recipe.site(values),
                    values,
                )
            path = tmp_path / "extended.yaml"
            write_deck(extended, str(path))
            again = read_deck(str(path))
            back = assembly(again).matrices(again.prior.mean)
            for one, other in zip(total, back, strict=True):
                assert dense(other) == pytest.approx(one, rel=1e-9, abs=1e-9 * np.abs(one).max())
            assert [p.name for p in again.parameters] == [p.name for p in extended.parameters]


def test_twice_the_size_makes_twice_of_what_is_proportional_to_it(models):
    """Its derivative is taken for what it is itself."""
    keys = set()
    for model in map(models.__getitem__, MODELS):
        recipes = [recipe for candidate in registry().values() for recipe in candidate.recipes(model, candidate)]
        for recipe in (each for each in recipes if each.linear is not None):
            values, keys = recipe.grid[0], keys | {recipe.candidate.key}
            one, two = (
                recipe.change(values * factor ** (np.arange(len(values)) == recipe.linear)) for factor in (1, 2)
            )
            for name in ("K", "M", "sensing", "C", "D"):
                part, twice = getattr(one, name), getattr(two, name)
                assert (part is None and twice is None) or np.allclose(twice, 2 * part, rtol=1e-12, atol=0)
            assert one.softening is None and recipe.rate(recipe.linear, 0.3, 1e-5) in ([(0.3, 1.0)], [(0.3, 1 / 0.3)])
    assert {"mass", "ground-spring", "added-mass", "foundation", "tension"} <= keys


def test_every_candidate_acts_somewhere(models):
    """Under names of its own: what acts at one place is known by that among all of a candidate."""
    acting = set()
    for name, model in ((name, models[name]) for name in MODELS):
        for key, candidate in registry().items():
            places = Counter(superposed.text(recipe) for recipe in candidate.recipes(model, candidate))
            assert all(count == 1 for count in places.values()), (name, key, places.most_common(3))
            acting |= {key} if places else set()
    assert acting == set(registry())


@pytest.mark.parametrize(
    "keys", [("support-rotation",), ("support-translation",), ("support-rotation", "support-translation")]
)
def test_supports_give_way_at_other_parameters_as_they_do_in_the_deck(models, keys):
    """Beside all coordinates of a model the mass of a support is a small difference: parameters of mass must move it too."""
    model = models["laden"]
    recipes = tuple(registry()[key].recipes(model, registry()[key])[-1] for key in keys)
    values = [next(sizes(recipe)) for recipe in recipes]
    c = [recipe.coordinates(found) for recipe, found in zip(recipes, values, strict=True)]
    z = np.array([-1.5, 1.2])
    altered, x = Model(model, recipes), np.concatenate([z, *c])
    at, deck = altered.point(x), model.problem
    for recipe, found in zip(recipes, values, strict=True):
        deck = recipe.extend(deck, found)
    theta = np.concatenate([model.parameters(z), deck.prior.mean[2:]])
    expected = eigh(*(dense(part) for part in assembly(deck).matrices(theta)), eigvals_only=True)
    assert at.eigenvalues[:20] == pytest.approx(expected[:20], rel=1e-5)
    step = 3e-3
    for j in range(len(x)):
        sides = [altered.point(x + sign * step * np.eye(len(x))[j]) for sign in (1, -1)]
        by_differences = (sides[1].residual - sides[0].residual)[:3] / (
            2 * step
        )  # lengths of shapes follow, after Kaufman
        assert altered.jacobian(at)[:3, j] == pytest.approx(
            by_differences, rel=1e-4, abs=1e-4 * np.abs(by_differences).max()
        )


PAIRS = [
    ("cantilever", ("crack", "mass")),
    ("cantilever", ("timoshenko", "support-rotation")),
    ("cantilever", ("support-translation", "support-rotation")),
    ("cantilever", ("support-translation", "mass")),
    ("portal", ("joint", "stiffness-loss")),
    ("space", ("tension", "crack")),
    ("matrices", ("oscillator", "ground-spring")),
    ("matrices", ("stiffness-loss", "oscillator")),
    ("free", ("added-mass", "sensor-place")),
]


@pytest.mark.parametrize(("name", "keys"), PAIRS)
def test_two_causes_in_one_deck(models, name, keys, tmp_path):
    model = models[name]
    recipes = tuple(registry()[key].recipes(model, registry()[key])[0] for key in keys)
    values = [next(sizes(recipe)) for recipe in recipes]
    c = [recipe.coordinates(found) for recipe, found in zip(recipes, values, strict=True)]
    expected = Model(model, recipes).point(np.concatenate([model.z, *c])).eigenvalues
    extended = model.problem
    for recipe, found in zip(recipes, values, strict=True):
        extended = recipe.extend(extended, found)
    write_deck(extended, str(tmp_path / "two.yaml"))
    again = read_deck(str(tmp_path / "two.yaml"))
    total = [dense(part) for part in assembly(again).matrices(again.prior.mean)]
    found = eigh(*total, eigvals_only=True)[: len(expected)][:7]
    assert found == pytest.approx(expected[:7], rel=2e-3, abs=1e-5 * found[-1])


@pytest.mark.parametrize(("name", "key", "value"), [("cantilever", "ground-spring", 0), ("cantilever", "support-rotation", 0),
    ("matrices", "ground-spring", 0), ("portal", "joint", 0), ("space", "tension", 0), ("masses", "mass", 0)])  # fmt: skip
def test_what_was_found_is_what_is_estimated_next(models, name, key, value):
    recipe = registry()[key].recipes(models[name], registry()[key])[0]
    found = next(sizes(recipe))
    extended = recipe.extend(models[name].problem, found)
    new = extended.parameters[-1]
    assert new.nominal == pytest.approx(found[value])
    assert (new.transform, new.sd) == ("log", pytest.approx(new.nominal))
    assert extended.prior.mean[-1] == new.nominal
    changed_value = extended.prior.mean * np.append(np.ones(len(extended.parameters) - 1), 1.2)
    one, other = (assembly(extended).matrices(theta) for theta in (extended.prior.mean, changed_value))
    assert any(not np.allclose(dense(a), dense(b), rtol=1e-12, atol=0) for a, b in zip(one, other, strict=True))


def test_a_member_that_is_gone_is_called_missing(models):
    """With its mass, and next to all of it: one that only lost its stiffness, or half of both, is softer.

    At one place they are told apart in words.
    """
    model = models["frame"]
    every = [(recipe.site(recipe.grid[0]).text, recipe) for recipe in model.recipes(registry()["member"])]
    places = [text.rpartition(", its ")[::2] for text, _ in every]
    assert {which for place, which in places if place == places[0][0]} == {"stiffness alone", "mass alike"}
    found = {text.endswith("its mass alike"): recipe for text, recipe in every}
    titles = {(alike, share): one.title(np.array([share])) for alike, one in found.items() for share in (0.5, 0.995)}
    assert titles == {(False, 0.5): "", (False, 0.995): "", (True, 0.5): "", (True, 0.995): "a missing member"}


def test_a_part_that_has_lost_all_of_its_stiffness_bears_nothing(models):
    """What gains any is no such part."""
    for key, title in (("stiffness-loss", "a part that bears nothing"), ("stiffness-gain", "")):
        model = models["matrices"]
        recipe = model.recipes(registry()[key])[0]
        assert [recipe.title(np.array([share])) for share in (0.5, 0.995)] == ["", title]
