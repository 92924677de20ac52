"""Held rotations of shells, by what their faces move beside the mean. Truth: CalculiX, with which imports agree to 1e-6."""

import numpy as np
import pytest
from test_import import imported, solver, written
from test_thickness import folded, hz, solved

from mouse_cli import DeckError, read_deck
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.importing.read import read
from mouse_cli.terms.assembly import assembly


def strip(
    kind: str = "S4", upright: bool = False, held: str = "CLAMP, 1, 6\n", thickness: float = 0.004, wide: int = 0
) -> str:
    """A plate of 4 by 2 shells, 0.2 by 0.1; CLAMP: its nodes at x = 0, and beyond by so many shells."""
    number: dict[tuple[int, int], int] = {}
    node = lambda x, y: number.setdefault((x, y), len(number) + 1)
    shells = []
    for i, j in np.ndindex(4, 2):
        around = [(0, 0), (2, 0), (2, 2), (0, 2)] + [(1, 0), (2, 1), (1, 2), (0, 1)] * kind.startswith("S8")
        shells.append([node(2 * i + a, 2 * j + b) for a, b in around])
    place = lambda x, y: f"{0.025 * x}, " + (f"0., {0.025 * y}" if upright else f"{0.025 * y}, 0.")
    text = "*NODE\n" + "".join(f"{n}, {place(*at)}\n" for at, n in number.items())
    text += f"*ELEMENT, TYPE={kind}, ELSET=SKIN\n" + "".join(
        f"{e}, {', '.join(map(str, nodes))}\n" for e, nodes in enumerate(shells, 1)
    )
    clamp = ", ".join(str(n) for (x, _), n in number.items() if x <= 2 * wide)
    text += f"*NSET, NSET=CLAMP\n{clamp}\n*MATERIAL, NAME=M\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850.\n"
    return text + f"*SHELL SECTION, ELSET=SKIN, MATERIAL=M\n{thickness}\n*BOUNDARY\n{held}"


CASES = {
    "clamped": {},
    "in the words of Abaqus": {"held": "CLAMP, ENCASTRE\n"},
    "upright": {"upright": True},
    "symmetry": {"held": "CLAMP, 1, 1\nCLAMP, 5, 6\n1, 2, 3\n"},
    "S8R, whose first frequency the solver's iteration leaves open": {"kind": "S8R"},
}


@solver
@pytest.mark.parametrize("name", CASES)
def test_clamped_shells_have_the_frequencies_of_the_solver(name, tmp_path):
    deck, said = imported(tmp_path, strip(**CASES[name]))
    assert "frequencies with supports as the solver's" in said
    rotations = {"upright": ("RX", "RZ"), "symmetry": ("RY",)}.get(name, ("RX", "RY"))
    problem = read_deck(deck)
    labels = [problem.held.structure.labels[i] for i in problem.held.supports[0].dofs]
    assert {label[-2:] for label in labels if "R" in label} == set(rotations)


@solver
def test_a_rotation_of_a_clamp_is_that_of_its_shell(tmp_path):
    """A rigid rotation about the clamp leaves no force: signs and sizes of rotations are those of the shell."""
    for upright in (False, True):
        (tmp_path / str(upright)).mkdir()
        problem = read_deck(imported(tmp_path / str(upright), strip(upright=upright))[0])
        free, at = problem.held.structure, problem.held.structure.geometry
        K = free.K.toarray() if hasattr(free.K, "toarray") else np.asarray(free.K)
        theta = np.array([0.0, 1.0, 0.0]) if not upright else np.array([0.0, 0.0, 1.0])
        known = {label: np.cross(theta, x) for label, x in zip(at.node.tolist(), at.coordinates[at.node], strict=True)}
        u = np.array(
            [
                known[n][d] if d < 3 else theta[d - 3]
                for n, d in zip(at.node.tolist(), at.direction.tolist(), strict=True)
            ]
        )
        clamp = [i for i, label in enumerate(free.labels) if label[-2] == "R"]
        rest = [i for i, label in enumerate(free.labels) if label.endswith("S")]
        u[rest] = -np.linalg.solve(K[np.ix_(rest, rest)], (K[rest] @ np.where(np.isin(np.arange(len(u)), rest), 0, u)))
        assert clamp and np.abs(K @ u).max() < 1e-6 * np.abs(K).max() * np.abs(u).max()


@solver
def test_a_thickness_beside_a_clamp_is_that_of_the_solver(tmp_path):
    deck, _ = imported(tmp_path, strip(thickness=0.01), "--thickness", "SKIN")
    problem = read_deck(deck)
    theta, i = problem.prior.mean.copy(), [p.name for p in problem.parameters].index("thickness of SKIN")
    theta[i : i + 3] = 0.0113 ** np.array([1.0, 3.0, 5.0])
    expected = solved(tmp_path / "other", strip(thickness=0.0113))
    assert np.allclose(hz(*assembly(problem).matrices(theta)), expected, rtol=1e-6)


@solver
def test_a_clamp_on_springs_lets_the_rotations_of_its_nodes_go(tmp_path):
    """Against CalculiX with springs at the nodes of the clamp alone, in the deck of the cause and in few coordinates."""
    deck, _ = imported(tmp_path, strip(wide=1))
    deck.write_text(deck.read_text() + "test:\n  modes:\n    frequency: [80, 300]\n    frequency_sd: 0.1 %\n")
    problem, words = read_deck(deck), "the support CLAMP, all directions"
    model = reduced(problem, problem.prior.mean)
    recipes = model.recipes(registry()["support-translation"])
    recipe = next(each for each in recipes if each.site(np.ones(1)).text == words)
    extended = recipe.extend(problem, np.array([6e5]))
    springs = "".join(
        f"*ELEMENT, TYPE=SPRING1, ELSET=K{d}\n"
        + "".join(f"{100 * d + n}, {n}\n" for n in read(written(tmp_path, strip(wide=1))).nsets["CLAMP"])
        + f"*SPRING, ELSET=K{d}\n{d}\n1.0e5\n"
        for d in (1, 2, 3)
    )
    expected = solved(tmp_path / "springs", strip(wide=1).split("*BOUNDARY")[0] + springs)
    assert np.allclose(hz(*assembly(extended).matrices(extended.prior.mean)), expected, rtol=1e-6)
    change, a = recipe.change(np.array([6e5])), recipe.own
    K, M = (
        np.diag(np.append(model.eigenvalues, np.zeros(a))) + change.K,
        np.diag(np.append(np.ones(model.r), np.zeros(a))),
    )
    assert np.allclose(hz(K, M + change.M, 2), expected[:2], rtol=1e-4)


REFUSED = {
    "where shells meet": folded(0.01).replace("ENDS, 1, 3", "ENDS, 1, 6"),
    "oblique": strip().replace("0.025, 0.0, 0.", "0.025, 0.0, 0.003").replace("0.05, 0.0, 0.", "0.05, 0.0, 0.006"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_clamp_that_the_solver_stiffens_is_refused_by_its_line(name, tmp_path):
    with pytest.raises(DeckError) as refused:
        read(written(tmp_path, REFUSED[name]))
    found = refused.value.diagnostics[0]
    assert found.code == "MD273" and found.help and name in found.message
