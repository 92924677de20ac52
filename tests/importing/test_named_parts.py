"""Supports and element sets of imported matrices in a diagnosis: what a cause does in few coordinates, in its deck, and by hand."""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.sparse import csr_matrix, save_npz

from mouse_cli import DeckError, diagnose, read_deck, write_deck
from mouse_cli.diagnosis.cautions import on_set
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.likelihoods.modal.sets import sets_in
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Choices, Site
from mouse_cli.model.held import ElementGroup
from mouse_cli.terms.assembly import assembly

NODES, FEET = 12, {"FOOT_1": (1, 2, 3), "FOOT_2": (4, 5)}
BRACES = {"BRACE": ((6, 10), (7, 11), (8, 12), (6, 11)), "FRAME": None}  # pairs of nodes; None: all others
SENSORS = [f"{n}T{d}" for n in (6, 7, 9, 10, 12) for d in "XYZ"]


def truss() -> tuple[np.ndarray, dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Coordinates (12, 3); K and M (36, 36) of each set: bars of k = 1e6 N/m and 2 kg between all nodes."""
    rng = np.random.default_rng(5)
    x = rng.uniform(0, 1, (NODES, 3))
    K = {name: np.zeros((3 * NODES, 3 * NODES)) for name in BRACES}
    M = {name: np.zeros((3 * NODES, 3 * NODES)) for name in BRACES}
    for i in range(NODES):
        for j in range(i):
            name = "BRACE" if (j + 1, i + 1) in BRACES["BRACE"] else "FRAME"
            along = (x[i] - x[j]) / np.linalg.norm(x[i] - x[j])
            b = np.zeros(3 * NODES)
            b[3 * i : 3 * i + 3], b[3 * j : 3 * j + 3] = along, -along
            K[name] += 1e6 * np.outer(b, b)
            own = [*range(3 * i, 3 * i + 3), *range(3 * j, 3 * j + 3)]
            M[name][own, own] += 1.0
    return x, K, M


def deck(folder: Path, K: np.ndarray | None = None, M: np.ndarray | None = None, more: str = "") -> Path:
    """The deck of the truss; its test is of the structure K, M without supports at 1 to 5 held, or of the truss itself."""
    x, stiff, heavy = truss()
    whole = {"K": sum(stiff.values()), "M": sum(heavy.values())}
    files = (
        whole
        | {f"K_{name}": each for name, each in stiff.items()}
        | {f"M_{name}": each for name, each in heavy.items()}
    )
    for name, matrix in files.items():
        save_npz(folder / f"{name}.npz", csr_matrix(matrix))
    (folder / "dofs.csv").write_text("".join(f"{n},T{d}\n" for n in range(1, NODES + 1) for d in "XYZ"))
    (folder / "nodes.csv").write_text("".join(f"{n},{','.join(map(repr, at.tolist()))}\n" for n, at in enumerate(x, 1)))
    held = np.arange(3 * 5) if K is None else np.zeros(0, int)
    free = np.setdiff1d(np.arange(3 * NODES), held)
    K, M = (whole["K"], whole["M"]) if K is None else (K, M)
    kept = free[np.diag(K)[free] < 1e19]
    w, V = eigh(K[np.ix_(kept, kept)], M[np.ix_(kept, kept)])
    at = [int(np.flatnonzero(kept == 3 * (int(s[:-2]) - 1) + "XYZ".index(s[-1]))[0]) for s in SENSORS]
    shapes = V[at, :8] / np.abs(V[at, :8]).max(axis=0)
    shapes = shapes + 0.005 * np.random.default_rng(1).standard_normal(shapes.shape)
    rows = "".join("      - [" + ", ".join(f"{v:.5f}" for v in row) + "]\n" for row in shapes)
    sets = "".join(
        f"    {name}: {{stiffness: {{file: K_{name}.npz}}, mass: {{file: M_{name}.npz}}}}\n" for name in BRACES
    )
    feet = "".join(
        f"    {name}: {{nodes: [{', '.join(map(str, own))}], directions: [TX, TY, TZ]}}\n" for name, own in FEET.items()
    )
    (folder / "truss.yaml").write_text(
        "mouse: 1\nunits: SI\nmodel:\n  stiffness: {file: K.npz}\n  mass: {file: M.npz}\n  dofs: {file: dofs.csv}\n"
        f"  nodes: {{file: nodes.csv}}\n  supports:\n{feet}{more}  sets:\n{sets}"
        "parameters:\n  - {name: E, nominal: 1, sd: 5 %, stiffness: {file: K.npz}}\n"
        "  - {name: density, nominal: 1, sd: 1 %, mass: {file: M.npz}}\n"
        f"test:\n  modes:\n    frequency: [{', '.join(f'{f:.6g}' for f in np.sqrt(w[:8]) / 2 / np.pi)}]\n"
        f"    frequency_sd: 0.1 %\n    dofs: [{', '.join(SENSORS)}]\n    shapes:\n{rows}    shape_sd: 0.5 %\n"
    )
    return folder / "truss.yaml"


def springs(K: np.ndarray, name: str, k: float) -> np.ndarray:
    """K with springs k / count at each direction of the nodes of one foot, and the other feet held."""
    found = K.copy()
    for foot, nodes in FEET.items():
        own = [3 * (n - 1) + d for n in nodes for d in range(3)]
        found[own, own] += k / len(nodes) if foot == name else 1e20
    return found


def test_a_cause_is_the_same_in_few_coordinates_in_its_deck_and_read_back(tmp_path):
    problem = read_deck(deck(tmp_path))
    model = reduced(problem, problem.prior.mean)
    tried = 0
    stiff = ("support-translation", "support-rotation", "stiffness-loss", "stiffness-gain", "member", "material")
    keys = (*stiff, "added-mass", "lighter")
    for key in keys:
        for i, recipe in enumerate(model.recipes(registry()[key])):
            values = np.array([np.exp(np.mean(u.bounds)) if u.log else np.mean(u.bounds) for u in recipe.unknowns])
            change = recipe.change(values)
            r, a = model.r, recipe.own
            K, M = np.diag(np.append(model.eigenvalues, np.zeros(a))), np.diag(np.append(np.ones(r), np.zeros(a)))
            K, M = K + (0 if change.K is None else change.K), M + (0 if change.M is None else change.M)
            extended = recipe.extend(problem, values)
            there = assembly(extended).matrices(extended.prior.mean)
            expected = eigh(*map(dense, there), eigvals_only=True)[:8]
            assert np.allclose(eigh(K, M, eigvals_only=True)[:8], expected, rtol=1e-6), recipe.site(values).text
            if i == 0:
                write_deck(extended, tmp_path / "again.yaml")
                again = read_deck(tmp_path / "again.yaml")
                back = map(dense, assembly(again).matrices(again.prior.mean))
                assert np.allclose(eigh(*back, eigvals_only=True)[:8], expected, rtol=1e-9)
            tried += 1
    assert tried > 20


def test_nothing_is_left_of_a_set_that_is_missing_however_stiff_its_material_turns_out(tmp_path):
    """The truss without its brace, by hand, all else 1.1 times as stiff: the recipe, and the deck that it makes, at E = 1.1."""
    problem = read_deck(deck(tmp_path))
    theta = np.array([1.1, 1.0])
    model = reduced(problem, problem.prior.mean).at(theta)
    recipe = next(
        each for each in model.recipes(registry()["member"]) if each.site(np.ones(1)).text == "element set BRACE"
    )
    _, K, M = truss()
    kept = np.arange(15, 36)
    assert [recipe.title(np.array([share])) for share in (0.5, 0.995)] == ["", "a missing part"]
    expected = eigh(1.1 * K["FRAME"][np.ix_(kept, kept)], M["FRAME"][np.ix_(kept, kept)], eigvals_only=True)
    gone = recipe.unknowns[0].upper
    change = recipe.change(np.array([gone]))
    found = eigh(np.diag(model.eigenvalues) + change.K, np.eye(model.r) + change.M, eigvals_only=True)
    assert np.allclose(found, expected, rtol=1e-5)
    extended = recipe.extend(problem, np.array([gone]))
    there = assembly(extended).matrices(np.array([*theta, 1 - gone]))
    assert np.allclose(eigh(*map(dense, there), eigvals_only=True), expected, rtol=1e-5)


@pytest.mark.parametrize("beside", [(), ("support-translation",)])
def test_what_is_missing_follows_the_parameters_from_where_it_was_weighed(tmp_path, beside):
    """Weighed at E = 1, the truss without its brace has all of its modes at E = 1.1 too, by hand; slopes of ln f by differences."""
    model = reduced(problem := read_deck(deck(tmp_path)), np.ones(2))
    of = lambda key, text: next(
        each for each in model.recipes(registry()[key]) if text in each.site(np.ones(len(each.unknowns))).text
    )
    causes = Model(model, (of("member", "set BRACE"), *(of(key, "all directions") for key in beside)))
    z = np.linalg.solve(model.L, np.array([1.1, 1.0]) - problem.prior.mean)
    if not beside:
        _, K, M = truss()
        kept = np.arange(15, 36)
        expected = eigh(1.1 * K["FRAME"][np.ix_(kept, kept)], M["FRAME"][np.ix_(kept, kept)], eigvals_only=True)
        at = causes.point(np.append(z, causes.bounds[0, 1]))
        assert np.allclose(at.eigenvalues, expected, rtol=1e-5)
    x = np.concatenate([z, causes.bounds.mean(axis=1)])
    for j, slope in enumerate(causes.jacobian(causes.point(x)).T):
        step = 1e-5 * np.eye(len(x))[j]
        there = [causes.point(x + sign * step) for sign in (1, -1)]
        moved = 0.5 * np.subtract(*(np.log(each.eigenvalues[each.modes]) for each in there)) / model.data.sd_log
        assert np.allclose(slope[:8], moved / 2e-5, rtol=1e-4, atol=1e-5 * np.abs(slope).max())


def chain(
    folder: Path, K: np.ndarray, M: np.ndarray, sets: dict[str, tuple[np.ndarray, np.ndarray]], gone: tuple[str, ...] = ()
) -> None:
    """The deck of a chain with K and M of its sets; its parameter is the stiffness of the first. Its test: without those gone."""
    n, first = len(K), next(iter(sets))
    whole = {"K": K, "M": M} | {f"{x}_{name}": each[i] for name, each in sets.items() for i, x in enumerate("KM")}
    for name, matrix in whole.items():
        save_npz(folder / f"{name}.npz", csr_matrix(matrix))
    sensors = range(5, min(n, 240), 20)
    there = (whole - sum(sets[name][i] for name in gone) for i, whole in enumerate((K, M)))
    w, V = eigh(*there, subset_by_index=[0, 5])
    rows = "".join("      - [" + ", ".join(f"{v:.6f}" for v in V[i]) + "]\n" for i in sensors)
    listed = "".join(f"    {one}: {{stiffness: {{file: K_{one}.npz}}, mass: {{file: M_{one}.npz}}}}\n" for one in sets)
    (folder / "chain.yaml").write_text(
        f"mouse: 1\nunits: SI\nmodel:\n  stiffness: {{file: K.npz}}\n  mass: {{file: M.npz}}\n  sets:\n{listed}"
        f"parameters:\n  - {{name: E, nominal: 1, sd: 5 %, stiffness: {{file: K_{first}.npz}}}}\n"
        f"test:\n  modes:\n    frequency: [{', '.join(f'{f:.8g}' for f in np.sqrt(w) / 2 / np.pi)}]\n"
        f"    frequency_sd: 0.1 %\n    dofs: [{', '.join(str(i + 1) for i in sensors)}]\n    shapes:\n{rows}"
        "    shape_sd: 1 %\n"
    )


def coupled(n: int, k: np.ndarray) -> np.ndarray:
    """K (n, n) of springs k (n,) from each mass to the one before, the first to the ground."""
    B = np.eye(n) - np.eye(n, k=-1)
    return B.T @ (k[:, None] * B)


def in_few(folder: Path, candidate: str, where: int, share: float, E: float) -> np.ndarray:
    """Lowest eigenvalues (6,) of the chain without a share of a set, in the few coordinates of a diagnosis."""
    problem = read_deck(folder / "chain.yaml")
    model = reduced(problem, np.array([E]))
    assert model.r < problem.structure.n
    change = model.recipes(registry()[candidate])[where].change(np.array([share]))
    mass = np.eye(model.r) if change.M is None else np.eye(model.r) + change.M
    return eigh(np.diag(model.eigenvalues) + change.K, mass, eigvals_only=True)[:6]


def test_few_coordinates_hold_what_a_large_model_does_without_a_set(tmp_path):
    """A stiff set beside 20 springs of a chain: its modes without the set, at E = 0.9, by hand."""
    own = np.isin(np.arange(240), range(100, 120))
    frame, brace, light = coupled(240, np.full(240, 1e6)), coupled(240, 1e8 * own), np.diag(0.5 * own)
    chain(tmp_path, frame + brace, np.eye(240) + light, {"BRACE": (brace, light)})
    found = in_few(tmp_path, "member", 0, 1 - 1e-9, 0.9)
    assert np.allclose(found, eigh(frame, np.eye(240), subset_by_index=[0, 5], eigvals_only=True), rtol=1e-4)


def test_few_coordinates_hold_the_modes_without_all_sets_that_the_test_misses(tmp_path):
    """Two of four ribs of a net, side by side: what vibrates between those that stay does so in no structure without one alone."""
    a, b = 24, 30
    M, K = np.eye(a * b), np.kron(np.eye(a), coupled(b, np.full(b, 1e6))) + np.kron(coupled(a, np.full(a, 1e6)), np.eye(b))
    on = [np.diag((np.arange(b) == column).astype(float)) for column in (5, 11, 17, 23)]
    ribs = {
        f"RIB_{i}": (np.kron(coupled(a, np.full(a, 1e8)), at), np.kron(np.eye(a), 0.5 * at)) for i, at in enumerate(on)
    }
    whole = [each + sum(own[i] for own in ribs.values()) for i, each in enumerate((K, M))]
    gone = ("RIB_1", "RIB_2")
    chain(tmp_path, *whole, ribs, gone)
    problem = read_deck(tmp_path / "chain.yaml")
    model = reduced(problem, problem.prior.mean)
    lost = [dict(zip(ribs, sets_in(model, name).projected, strict=True)) for name in "KM"]
    few = [np.diag(model.eigenvalues) - sum(lost[0][name] for name in gone), np.eye(model.r) - sum(lost[1][name] for name in gone)]
    right = [each - sum(ribs[name][i] for name in gone) for i, each in enumerate(whole)]
    found, exact = (eigh(*each, subset_by_index=[0, 5], eigvals_only=True) for each in (few, right))
    assert np.allclose(found, exact, rtol=1e-3)


def test_what_is_left_of_a_missing_set_is_more_than_rounding(tmp_path):
    """Of matrices with 14 digits (1e-14 of the largest entry) the deck without a branch has no negative stiffness."""
    n, at = 60, [0, *range(30, 60)]
    spine, branch, light = np.pad(coupled(30, np.full(30, 1e12)), (0, 30)), np.zeros((n, n)), np.zeros((n, n))
    branch[np.ix_(at, at)], light[at[1:], at[1:]] = coupled(31, np.append(0, np.full(30, 1e9))), 1.0
    noise = np.full(n, 1e-14 * spine.max())
    chain(tmp_path, spine + branch, np.diag(np.arange(n) < 30) + light, {"BRANCH": (branch + np.diag(noise), light)})
    problem = read_deck(tmp_path / "chain.yaml")
    (recipe,) = reduced(problem, problem.prior.mean).recipes(registry()["member"])
    deck = recipe.extend(problem, np.array([recipe.unknowns[0].upper]))
    for matrix in assembly(deck).matrices(deck.prior.mean):
        assert np.linalg.eigvalsh(dense(matrix)).min() > 0


@pytest.mark.parametrize("share", [0.5, 0.8, 0.95])
def test_few_coordinates_hold_a_set_that_is_soft_and_as_heavy_as_it_was(tmp_path, share):
    """One of 20 branches of 30 masses on a chain of 100 has low modes of its own: they are, by hand, within a fifth of the sd."""
    n, parts = 700, []
    spine = np.pad(coupled(100, np.full(100, 1e8)), (0, 600))
    for i in range(20):
        at = [5 * i, *range(100 + 30 * i, 130 + 30 * i)]
        K, M = np.zeros((n, n)), np.zeros((n, n))
        K[np.ix_(at, at)], M[at[1:], at[1:]] = coupled(31, np.append(0, np.full(30, 2e6))), 1.0
        parts.append((K, M))
    K, M = spine + sum(K for K, _ in parts), np.diag(np.arange(n) < 100) + sum(M for _, M in parts)
    chain(tmp_path, K, M, {f"BRANCH_{i}": each for i, each in enumerate(parts)})
    right = eigh(K - share * parts[5][0], M, subset_by_index=[0, 5], eigvals_only=True)
    assert np.allclose(in_few(tmp_path, "stiffness-loss", 5, share, 1.0), right, rtol=4e-4)


@pytest.mark.parametrize(("words", "loose"), [("all directions", (1, 2, 3)), ("node 2 of it, all directions", (2,))])
def test_a_foot_on_springs_is_what_springs_at_its_nodes_make(tmp_path, words, loose):
    """Springs in the matrices themselves, by hand, against the recipe of the named support, or of a part of it."""
    problem = read_deck(deck(tmp_path))
    model = reduced(problem, problem.prior.mean)
    recipe = next(
        each
        for each in model.recipes(registry()["support-translation"])
        if each.site(np.ones(1)).text == f"the support FOOT_1, {words}"
    )
    extended = recipe.extend(problem, np.array([3e6]))
    found = eigh(*map(dense, assembly(extended).matrices(extended.prior.mean)), eigvals_only=True)[:8]
    _, K, M = truss()
    K, M = springs(sum(K.values()), "FOOT_1", 3e6 * 3 / len(loose)), sum(M.values())
    held = [3 * (n - 1) + d for n in FEET["FOOT_1"] if n not in loose for d in range(3)]
    K[held, held] += 1e20
    kept = np.diag(K) < 1e19
    assert np.allclose(found, eigh(K[kept][:, kept], M[kept][:, kept], eigvals_only=True)[:8], rtol=1e-8)


def test_a_foot_that_is_stiff_in_itself_may_be_as_soft_as_what_it_stands_on(tmp_path):
    """Bars within the foot do nothing against its motion as a whole: t'Kt, of the bars to other nodes, bounds its resistance."""
    _, K, M = truss()
    x, whole = truss()[0], sum(K.values())
    for i, j in ((0, 1), (0, 2), (1, 2)):
        b = np.zeros(3 * NODES)
        b[3 * i : 3 * i + 3] = (x[i] - x[j]) / np.linalg.norm(x[i] - x[j])
        b[3 * j : 3 * j + 3] = -b[3 * i : 3 * i + 3]
        whole = whole + 1e12 * np.outer(b, b)
    path = deck(tmp_path)
    save_npz(tmp_path / "K.npz", csr_matrix(whole))
    text = path.read_text()
    path.write_text(text[: text.index("  sets:")] + text[text.index("parameters:") :])
    problem = read_deck(path)
    model = reduced(problem, problem.prior.mean)
    own = [
        each for each in model.recipes(registry()["support-translation"]) if "FOOT_1, all" in each.site(np.ones(1)).text
    ]
    along = [np.isin(np.arange(3 * NODES), [d, 3 + d, 6 + d]).astype(float) for d in range(3)]
    inertia = (2 * np.pi * problem.test.frequency_hz[0]) ** 2
    bound = min(t @ whole @ t + inertia * (t @ sum(M.values()) @ t) for t in along)
    assert own[0].unknowns[0].lower < 1.01e-3 * bound


@pytest.mark.parametrize("what", ["brace missing", "brace of steel", "foot loose", "control"])
def test_what_is_missing_is_named_as_the_model_names_it(tmp_path, what):
    _, K, M = truss()
    stiffer, denser = {"brace missing": (0.02, 0.02), "brace of steel": (3.0, 2.9)}.get(what, (1.0, 1.0))
    stiff = K["FRAME"] + stiffer * K["BRACE"]
    heavy = M["FRAME"] + denser * M["BRACE"]
    found = diagnose(read_deck(deck(tmp_path, springs(stiff, "FOOT_2" if what == "foot loose" else "", 2e6), heavy)))
    sites = [cause.site.text for cause in found.explanations[0].causes]
    if what == "control":
        assert found.kind == "nothing-missing"
    else:
        assert found.kind == "named"
        assert sites == ["the support FOOT_2, all directions" if what == "foot loose" else "element set BRACE"]
        assert (found.best.physics == "material") == (what == "brace of steel")
    if what == "brace of steel":
        for size, truth in zip(found.best.causes[0].sizes, (stiffer, denser), strict=True):
            assert abs(size.value - truth) < 3 * size.sd < 0.5


def test_a_support_in_one_direction_that_is_gone_lets_each_of_its_nodes_go(tmp_path):
    """A hanger that holds two nodes in TY: without it they move each for itself, which is no motion of one body."""
    _, K, M = truss()
    free = sum(K.values())
    free[range(9), range(9)] += 1e20
    path = deck(tmp_path, free, sum(M.values()))
    held = "FOOT_2: {{nodes: [4, 5], directions: [{}]}}".format
    path.write_text(path.read_text().replace(held("TX, TY, TZ"), held("TY")))
    found = diagnose(read_deck(path), choices=Choices(candidates=("support-translation", "member", "oscillator"), causes=1))
    assert found.kind == "named" and [each.site.text for each in found.best.causes] == ["the support FOOT_2, TY at each node"]


def test_a_point_mass_of_the_model_that_is_heavier_has_one_name(tmp_path):
    """4 kg at node 12 weigh 8: a lumped mass there and more of the set are one, which was once told as one of two."""
    _, K, M = truss()
    dot = np.zeros((3 * NODES, 3 * NODES))
    dot[range(33, 36), range(33, 36)] = 4.0
    path = deck(tmp_path, springs(sum(K.values()), "", 0), sum(M.values()) + 2 * dot)
    save_npz(tmp_path / "M.npz", csr_matrix(sum(M.values()) + dot))
    save_npz(tmp_path / "M_DOT.npz", csr_matrix(dot))
    path.write_text(path.read_text().replace("  sets:\n", "  sets:\n    DOT: {mass: {file: M_DOT.npz}, nodes: [12]}\n"))
    found = diagnose(read_deck(path), choices=Choices(candidates=("mass", "added-mass", "lighter"), causes=1))
    assert found.kind == "named" and found.best.physics == "mass"
    (cause,) = found.best.causes
    assert cause.site.text == "element set DOT" and abs(cause.sizes[0].value - 1) < 3 * cause.sizes[0].sd < 0.2
    assert not any("node 12" in each.causes[0].site.text for each in found.explanations if each.physics == "mass")


@pytest.mark.parametrize(
    "more", ["    TWICE: {nodes: [3], directions: [TX]}\n", "    ABSENT: {nodes: [77], directions: [TX]}\n"]
)
def test_supports_that_fit_nothing_are_refused(tmp_path, more):
    with pytest.raises(DeckError) as refused:
        read_deck(deck(tmp_path, more=more))
    assert [each.code for each in refused.value.diagnostics] == ["MD276"]


def test_shapes_that_point_to_a_node_of_a_set_do_not_speak_against_it():
    """A spring of the job at node 190 that is softer acts at 190TZ."""
    groups = (ElementGroup("FOOT", nodes=(190,)), ElementGroup("LUG", nodes=(1, 2)))
    foot, lug = (Site("dof", (), None, f"element set {name}") for name in ("FOOT", "LUG"))
    there = Site("dof", ("190TZ",), (0.0, 0.0, 0.0), "degree of freedom 190TZ")
    assert on_set(foot, there, groups) and not on_set(lug, there, groups)
