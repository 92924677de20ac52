"""Shells that meet: what CalculiX holds at their common nodes, it lets go where one of the sets is missing."""

import shutil

import numpy as np
import pytest
from test_import import written

from mouse_cli import read_deck, write_deck
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.dynamics.solver import eigensolution
from mouse_cli.importing.calculix import Solver
from mouse_cli.importing.knots import knots
from mouse_cli.importing.read import read
from mouse_cli.importing.run import imported
from mouse_cli.terms.assembly import assembly

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not on the path")


def strips(kind: str, rise: float, thickness: float, parts: str = "AB") -> str:
    """A flat strip A and beside it a strip B, which rises at an angle; both of shells of that type."""
    at = [(x / 4, y / 4, rise * max(y - 2, 0) / 4) for y in range(5) for x in range(9)]
    corners = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))[: 4 if kind == "S4" else 8]
    lines = ["*NODE", *(f"{n}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(at, 1))]
    for row, name in enumerate("AB"):
        lines += [f"*ELEMENT, TYPE={kind}, ELSET={name}"] if name in parts else []
        for e in range(4) if name in parts else ():
            nodes = (1 + 2 * e + i + 9 * (2 * row + j) for i, j in corners)
            lines.append(", ".join(map(str, (10 * row + e + 1, *nodes))))
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2.1e11, 0.3", "*DENSITY", "7850."]
    for name, t in zip("AB", (0.01, thickness), strict=True):
        lines += [f"*SHELL SECTION, ELSET={name}, MATERIAL=STEEL", f"{t}"] if name in parts else []
    return "\n".join([*lines, "*NSET, NSET=ROOT", "1, 3, 19, 21", "*BOUNDARY", "ROOT, 1, 3\n"])


def told(path: str) -> list:
    """What is said of a job where K and M without its sets are not known."""
    model = read(path)
    return list(knots(model, range(len(model.groups))))


def without_b(folder, text: str) -> np.ndarray:
    """Frequencies of an import with K and M less those of set B."""
    from scipy.linalg import eigh

    found = imported(written(folder, text), folder / "deck.yaml", "SI", False, str)
    own = [group.name for group in found.model.groups].index("B")
    names = [tuple(each) for each in found.parts.whole.rows.names.tolist()]
    K, M = ((getattr(found.parts.whole, x) - getattr(found.parts, x)[own]).toarray() for x in "KM")
    kept = [i for i, dof in enumerate(names) if dof not in set(found.model.supports[0].dofs) and K[i, i] > 1e-9 * K.max()]
    return 1 / np.sqrt(eigh(M[np.ix_(kept, kept)], K[np.ix_(kept, kept)], eigvals_only=True)[:-4:-1]) / (2 * np.pi)


@needs_ccx
@pytest.mark.parametrize(("kind", "least", "most"), [("S8R", 1.002, 1.1), ("S4", 1 - 1e-5, 1 + 1e-5)])
def test_shells_that_meet_hold_one_another_in_the_solver(tmp_path, kind, least, most):
    """A strip that rises at a right angle: ccx itself without it, against K less its K."""
    text = strips(kind, 1.0, 0.01)
    alone = strips(kind, 1.0, 0.01, "A") + "*STEP\n*FREQUENCY\n3\n*END STEP\n"
    with Solver("job.inp", None, str) as ccx:
        true = np.sqrt(np.sort(ccx.eigenvalues(alone, "alone"))[:3]) / (2 * np.pi)
    ratio = without_b(tmp_path, text) / true
    assert least < ratio.max() < most
    assert bool(told(written(tmp_path, text))) == (kind == "S8R")


@pytest.mark.parametrize(
    ("rise", "thickness", "says"), [(1.0, 0.01, True), (0.0, 0.02, True), (0.0, 0.01, False), (0.05, 0.01, False)]
)
def test_knots_are_told_where_normals_or_thicknesses_differ(tmp_path, rise, thickness, says):
    """A fold of 3 degrees has one normal in the solver, as a curved shell has."""
    found = told(written(tmp_path, strips("S8R", rise, thickness)))
    assert [each.code for each in found] == (["MD275"] if says else [])
    assert not says or ("S8R of A, B" in found[0].message and "9 nodes" in found[0].message)


@needs_ccx
@pytest.mark.parametrize(("rise", "thickness"), [(1.0, 0.01), (0.0, 0.02)])
def test_without_a_set_the_model_is_that_of_the_solver(tmp_path, rise, thickness):
    """In the deck of the import, in a diagnosis, in the extended deck, and in that deck read back: ccx itself without the set."""
    alone = strips("S8R", rise, thickness, "A") + "*STEP\n*FREQUENCY\n4\n*END STEP\n"
    with Solver("job.inp", None, str) as ccx:
        true = np.sqrt(np.sort(ccx.eigenvalues(alone, "alone"))[:4]) / (2 * np.pi)
    found = imported(written(tmp_path, strips("S8R", rise, thickness)), tmp_path / "deck.yaml", "SI", False, str)
    assert not [each for each in found.remarks if each.code == "MD275"]
    test = f"test:\n  modes:\n    frequency: [{', '.join(map(str, true))}]\n    frequency_sd: 0.1 %\n"
    (tmp_path / "deck.yaml").write_text((tmp_path / "deck.yaml").read_text() + test)
    problem = read_deck(tmp_path / "deck.yaml")
    model = reduced(problem, problem.prior.mean)
    recipe = [each for each in model.recipes(registry()["member"]) if each.site(np.ones(1)).text == "element set B"][-1]
    gone = np.array([recipe.unknowns[0].upper])
    change = recipe.change(gone)
    hz = lambda K, M: np.sqrt(eigensolution(K, M, 12).eigenvalues) / (2 * np.pi)
    like = lambda own: np.abs(own[:, None] / true - 1).min(axis=0).max()  # what is left of B has modes of its own
    assert like(hz(np.diag(model.eigenvalues) + change.K, np.eye(model.r) + change.M)) < 1e-3
    extended = recipe.extend(problem, gone)
    write_deck(extended, tmp_path / "extended.yaml")
    for each in (extended, read_deck(tmp_path / "extended.yaml")):
        assert like(hz(*assembly(each).matrices(each.prior.mean))) < 1e-3
