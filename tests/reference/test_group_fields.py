"""Fields over groups of imported matrices: a clamped beam of Hermite elements written here, in six strips of K or of M."""

from types import SimpleNamespace

import numpy as np
import pytest
from proofs import proofs
from scipy.linalg import eigh

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.nameless import registry
from mouse_cli.diagnosis.nameless._correlated import leading, spacing
from mouse_cli.diagnosis.nameless._energy import local_energy
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import MASS, NAMED, NOTHING, STIFFNESS, UNKNOWN, Choices
from mouse_cli.terms.assembly import assembly

LENGTH, EI, LINE_MASS, COUNT, STRIPS, MODES = 2.0, 2000.0, 3.0, 24, 6, 5
MIDDLES = (np.arange(COUNT) + 0.5) / COUNT
WAVE = 1 + 0.2 * np.sin(5 * MIDDLES)
OWN = np.arange(COUNT) * STRIPS // COUNT
NAMES = ("mass", "ground-spring", "stiffness-loss")


def matrices(bending: np.ndarray, mass: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """K and M (48, 48) of EI and mass per length times these factors (24,), without the clamped end."""
    l = LENGTH / COUNT
    unit = np.outer([1, l, 1, l], [1, l, 1, l])
    k = EI / l**3 * unit * np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]])
    m = l / 420 * LINE_MASS * unit
    m = m * np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]])
    K, M = np.zeros((2, 2 * COUNT + 2, 2 * COUNT + 2))
    for e in range(COUNT):
        at = slice(2 * e, 2 * e + 4)
        K[at, at] += bending[e] * k
        M[at, at] += mass[e] * m
    return K[2:, 2:], M[2:, 2:]


def entries(matrix: np.ndarray) -> str:
    n = len(matrix)
    pairs = [(i, j) for i in range(n) for j in range(i, n) if abs(matrix[i, j]) > 1e-12 * matrix.max()]
    return "[" + ", ".join(f"[{i + 1}, {j + 1}, {matrix[i, j]:.10g}]" for i, j in pairs) + "]"


def strips(bending: np.ndarray, mass: np.ndarray, of: str) -> str:
    """The deck of an even beam whose strips are parameters of K or M (`of`), and whose test is that of these factors."""
    even = np.ones(COUNT)
    K0, M0 = matrices(even, even)
    lam, X = eigh(*matrices(bending, mass))
    rng, own = np.random.default_rng(4), np.arange(0, 2 * COUNT, 4)
    hz = np.sqrt(lam[:MODES]) / (2 * np.pi) * (1 + 1e-3 * rng.standard_normal(MODES))
    X = X[own, :MODES] / np.abs(X[own, :MODES]).max(axis=0)
    X = X + 0.01 * rng.standard_normal(X.shape)
    part = lambda g: dict(zip(("stiffness", "mass"), matrices(1.0 * (g == OWN), 1.0 * (g == OWN)), strict=True))[of]
    parameters = "\n".join(
        f"  - {{name: strip {g + 1}, nominal: 1, sd: 3 %, {of}: {entries(part(g))}}}" for g in range(STRIPS)
    )
    rows = "\n".join(f"      - [{', '.join(f'{value:.5f}' for value in row)}]" for row in X)
    order = f"order: {2 * COUNT}"
    return f"""mouse: 1
model: {{stiffness: {{{order}, entries: {entries(K0)}}}, mass: {{{order}, entries: {entries(M0)}}}}}
parameters:
{parameters}
test:
  modes:
    frequency: [{", ".join(f"{f:.8g}" for f in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(str(i + 1) for i in own)}]
    shapes:
{rows}
    shape_sd: 1 %
"""


def found_in(deck: str):
    return diagnose(assemble(yaml_deck.read(deck, "strips.yaml")), choices=Choices(NAMES, causes=1))


@pytest.mark.parametrize("of", proofs([STIFFNESS, MASS], MASS))
def test_a_wave_over_six_strips_is_a_field_of_them(of):
    """20 % up and down, six of the prior sd of a strip."""
    even = np.ones(COUNT)
    found = found_in(strips(WAVE, even, of) if of == STIFFNESS else strips(even, WAVE, of))
    assert (found.kind, found.field.property, len(found.field.values)) == (UNKNOWN, of, STRIPS)
    assert [each.site.text for each in found.field.values] == [
        f"what 'strip {g + 1}' stands for" for g in range(STRIPS)
    ]
    true = np.array([WAVE[g == OWN].mean() for g in range(STRIPS)]) - 1
    value, sd = np.array([(each.value, each.sd) for each in found.field.values]).T
    assert np.corrcoef(value, true)[0, 1] > 0.95
    assert (np.abs(value - true) < 3 * sd).all()
    assert found.extended_result.status.key == "converged" and not found.extended_result.rejected


def test_one_soft_strip_has_a_name():
    dip = np.where(OWN == 2, 0.6, 1.0)
    found = found_in(strips(dip, np.ones(COUNT), STIFFNESS))
    assert (found.kind, found.best.physics) == (NAMED, "stiffness-loss")
    assert found.best.causes[0].site.text == "what 'strip 3' stands for"


def test_even_strips_lack_nothing():
    assert found_in(strips(np.ones(COUNT), np.ones(COUNT), STIFFNESS)).kind == NOTHING


def test_a_continuum_without_groups_has_parts_at_its_degrees_of_freedom():
    """Together they are K; each is positive, and near its place. Of the mass, groups are the parts."""
    deck = strips(np.ones(COUNT), np.ones(COUNT), MASS)
    problem = assemble(yaml_deck.read(deck, "strips.yaml"))
    model = reduced(problem, problem.prior.mean)
    cells = registry()["field-stiffness"].cells(model)
    parts = [model.assembly.matrices(model.theta)[1] @ model.V @ rows.T for rows, _ in cells.blocks]  # b = M V (V'b)
    assert len(cells) == problem.structure.n and all(size == 1.0 for _, size in cells.blocks)
    assert sum(b @ b.T for b in parts) == pytest.approx(
        problem.structure.K, abs=1e-9 * np.abs(problem.structure.K).max()
    )
    for i, b in enumerate(parts):
        near = np.abs(np.arange(len(b)) - i) <= 4  # two nodes
        assert (b[near] ** 2).sum() > 0.9 * (b**2).sum()
    assert len(registry()["field-mass"].cells(model)) == STRIPS


def test_parts_at_degrees_of_freedom_are_put_into_a_deck():
    """With all of a share alike K is that much more."""
    deck = strips(np.ones(COUNT), np.ones(COUNT), MASS)
    problem = assemble(yaml_deck.read(deck, "strips.yaml"))
    cells = registry()["field-stiffness"].cells(reduced(problem, problem.prior.mean))
    more = cells.extend(problem, np.full(len(cells), 0.1), 0.1)
    assert len(more.parameters) == len(problem.parameters) + len(cells)
    K, M = assembly(more).matrices(more.prior.mean)
    assert pytest.approx(1.1 * problem.structure.K, rel=1e-9, abs=1e-12 * np.abs(K).max()) == K
    assert (problem.structure.M == M).all()


# --- many cells, and few


def test_many_places_in_a_plane_have_the_leading_vectors_of_their_correlation():
    """A grid of 900 places against numpy's eigenvectors of the whole matrix."""
    x, y = np.meshgrid(np.linspace(0, 2, 30), np.linspace(0, 1, 30))
    at = np.stack([x.ravel(), y.ravel()], axis=1)
    A = np.exp(-0.5 * ((at[:, None] - at) ** 2).sum(axis=2) / 0.5**2)
    size, U = np.linalg.eigh(A)
    P = leading(at, 0.5)
    best = (U[:, -P.shape[1] :] * size[-P.shape[1] :]) @ U[:, -P.shape[1] :].T
    assert P.shape[1] <= 16
    assert np.abs(P @ P.T - best).max() < 5e-3


@pytest.mark.parametrize("storeys", [3, 4, 6])
def test_few_cells_are_not_independent(storeys):
    """Storeys next to one another are alike by exp(-1/2) at least: a field of independent ones would not be smooth."""
    at = 3.0 * np.arange(storeys)[:, None]
    assert spacing(at) == pytest.approx(3.0)
    deck = building(storeys)
    problem = assemble(yaml_deck.read(deck, "storeys.yaml"))
    cells = registry()["field-stiffness"].cells(reduced(problem, problem.prior.mean))
    length, P = cells.correlated(0.08)
    assert length == pytest.approx(3.0)
    assert (P @ P.T)[0, 1] == pytest.approx(np.exp(-0.5), abs=0.02)


def building(storeys: int) -> str:
    hz = ", ".join(str(1.0 + i) for i in range(storeys))
    return f"""mouse: 1
model:
  structure:
    nodes: {{line: {{from: 0, to: {storeys}, start: [0, 0, 0], end: [0, 0, {3 * storeys}]}}}}
    elements:
      - {{id: 1-{storeys}, type: storey, nodes: 0-{storeys}, TX: 1000}}
      - {{id: 101-{100 + storeys}, type: mass, nodes: 1-{storeys}, mass: 1}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: all, elements: 1-{storeys}, property: TX, sd: 3 %}}
test:
  modes: {{frequency: [{hz}], frequency_sd: 1 %}}
"""


def test_configurations_share_the_cells_that_all_of_them_have():
    """The second lacks one of four and has another instead: as many, but of three sites alike, in the order of the first."""
    from mouse_cli.diagnosis.nameless._cells import Cells
    from mouse_cli.diagnosis.nameless.fit import _shared
    from mouse_cli.model.site import Site

    def cells(ids: list[int]) -> Cells:
        sites = tuple(Site("element", (i,)) for i in ids)
        blocks = tuple((np.full((1, 2), float(i)), np.eye(1)) for i in ids)
        return Cells(sites, np.array(ids, float)[:, None], "m", blocks, "K")

    first, none, second = _shared([cells([1, 2, 3, 4]), None, cells([2, 5, 4, 1])])
    assert none is None
    for each in (first, second):
        assert [site.ids[0] for site in each.sites] == [1, 2, 4]
        assert [float(rows[0, 0]) for rows, _ in each.blocks] == [1.0, 2.0, 4.0]
    assert _shared([cells([1, 2, 3]), cells([3, 4, 5])]) == (None, None)


def test_no_matrix_of_a_large_model_is_made_dense():
    """Its parts would be as many as its degrees of freedom."""
    large = SimpleNamespace(r=100, problem=SimpleNamespace(structure=SimpleNamespace(n=10**6)))
    assert local_energy(large) is None
