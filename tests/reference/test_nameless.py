"""Physics without a name: truths that no mechanism of the library makes, by finite elements and chains written here."""

from dataclasses import replace
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
from hermite_beams import COARSE, LENGTH, Truth, deck
from proofs import proofs
from scipy.linalg import eigh
from scipy.stats import norm

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.nameless import registry as nameless
from mouse_cli.diagnosis.nameless._field import LENGTHS, smooth
from mouse_cli.diagnosis.nameless.fit import _spreads, rivals
from mouse_cli.diagnosis.search.rank import _log_prior, rank
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import AXIAL, BED, MASS, NAMED, NOTHING, STIFFNESS, UNKNOWN, Choices

NAMES = ("tension", "ground-spring", "mass", "stiffness-loss", "taper", "shear")
WAVE = lambda waves, phase: lambda x: 1 + 0.15 * np.sin(2 * np.pi * waves * x + phase)
WAVY = {STIFFNESS: WAVE(2.3, 0.0), MASS: WAVE(1.8, 0.5)}


def found_in(truth: Truth, free: bool, choices: Choices, seed: int = 1):
    return diagnose(assemble(yaml_deck.read(deck(truth, free, seed=seed), "beam.yaml")), choices=choices)


def runs(found) -> bool:
    """Whether the deck with the field in it converges and is not rejected."""
    return found.extended_result.status.key == "converged" and not found.extended_result.rejected


def predicts(held) -> bool:
    """Whether the error of frequencies held out is at least halved, or no more than the field and the test leave open.

    Those are 0.1 % of the test, and at most 0.4 % with what the field does not know.
    """
    before, after = held.baseline.rms_frequency_error, held.revised.rms_frequency_error
    off = np.abs(held.revised.frequencies_hz - held.measured_hz) / held.revised.sd_hz
    within = (held.revised.sd_hz < 4e-3 * held.measured_hz).all() and (off < 2.5).all()
    gained = held.revised.log_predictive_density - held.baseline.log_predictive_density
    return gained > 10 and (after < 0.5 * before or (before < 3e-3 and within))


@pytest.mark.parametrize(("of", "free"), proofs(product((STIFFNESS, MASS), (False, True)), (STIFFNESS, False), (MASS, True)))
def test_what_is_wavy_is_a_field(of, free):
    """15 % up and down: no name, the right field, its largest value at a crest or a trough, of the right sign."""
    truth = Truth(stiffness=WAVY[STIFFNESS]) if of == STIFFNESS else Truth(mass=WAVY[MASS])
    found = found_in(truth, free, Choices(NAMES, causes=1))
    assert found.kind == UNKNOWN and found.exit_code == 1
    assert found.field.property == of and found.field.log_evidence_over_named > 3
    assert max(found.groups, key=lambda pair: pair[1])[0] == f"field-{of}"
    x = np.array([each.site.position[0] for each in found.field.values]) / LENGTH
    value, sd = np.array([(each.value, each.sd) for each in found.field.values]).T
    true = np.array([WAVY[of](each) - 1 for each in x])
    at = int(np.argmax(np.abs(value)))
    assert abs(true[at]) > 0.12 and value[at] * true[at] > 0
    assert np.corrcoef(value, true)[0, 1] > 0.8
    assert (np.abs(value - true) < 3 * sd).mean() > 0.8
    assert predicts(found.field.held_out) and runs(found)


def test_a_bed_under_a_half_that_may_not_be_named():
    """150 EI / L^4 under the left half of a free beam, candidates without `foundation`."""
    truth = Truth(bed=lambda x: 150.0 if x < 0.5 else 0.0)
    found = found_in(truth, True, Choices(NAMES, causes=1))
    assert (found.kind, found.field.property) == (UNKNOWN, BED)
    x, value = np.array([(each.site.position[0] / LENGTH, each.value) for each in found.field.values]).T
    assert abs(value.mean() - 75) < 8 and value[x < 0.5].sum() > 0.75 * value.sum()
    assert x[np.argmax(np.abs(value))] < 0.5
    assert predicts(found.field.held_out) and runs(found)
    assert len(found.extended.parameters) == 2 + COARSE


SINGLES = {
    "tension": Truth(tension=8.0),
    "ground-spring": Truth(springs=((0.55, 40.0),)),
    "mass": Truth(masses=((0.7, 0.05),)),
}


@pytest.mark.parametrize(
    ("name", "free"), proofs(product(SINGLES, (False, True)), ("tension", False), ("mass", True), ("ground-spring", False))
)
def test_what_has_a_name_keeps_it(name, free):
    """Fields can do what a mechanism does; they pay for what else they can do."""
    found = found_in(SINGLES[name], free, Choices(NAMES, causes=1))
    assert (found.kind, found.best.physics, found.field) == (NAMED, name, None)
    assert any(group.startswith("field-") for group, _ in found.groups)


@pytest.mark.parametrize("free", [False, True])
def test_a_control_lacks_nothing(free):
    found = found_in(Truth(), free, Choices(NAMES, causes=1))
    assert (found.kind, found.field, found.exit_code) == (NOTHING, None, 0)


# --- chains of springs to one another and unit masses, the first one to the ground

N = 10


def chain(k: np.ndarray, m: np.ndarray, seed: int = 3) -> str:
    """A chain whose deck has springs of 1000 N/m and masses of 1 kg, and whose test is that of k and m."""
    rng, drift = np.random.default_rng(seed), np.eye(N) - np.eye(N, k=-1)
    lam, X = eigh(drift.T @ np.diag(k) @ drift, np.diag(m))
    hz = np.sqrt(lam[:6]) / (2 * np.pi) * (1 + 1e-3 * rng.standard_normal(6))
    X = X[:, :6] / np.abs(X[:, :6]).max(axis=0) + 0.01 * rng.standard_normal((N, 6))
    K = drift.T @ drift * 1000
    entries = ", ".join(f"[{i + 1}, {j + 1}, {K[i, j]}]" for i in range(N) for j in range(i, N) if K[i, j])
    rows = "\n".join(f"      - [{', '.join(f'{value:.6f}' for value in row)}]" for row in X)
    return f"""mouse: 1
model: {{stiffness: {{order: {N}, entries: [{entries}]}}, mass: {{identity: {N}}}}}
parameters: [{{name: all, nominal: 1, sd: 3 %, stiffness: [{entries}]}}]
test:
  modes:
    frequency: [{", ".join(f"{f:.8g}" for f in hz)}]
    frequency_sd: 0.1 %
    dofs: [{", ".join(str(i + 1) for i in range(N))}]
    shapes:
{rows}
    shape_sd: 1 %
"""


def test_a_field_over_the_springs_of_a_chain():
    """A valley of 25 % about spring 6: each spring found, and the common factor of all is no part of it."""
    dip = -0.25 * np.exp(-0.5 * ((np.arange(N) - 5) / 1.8) ** 2) + 0.15 * np.exp(
        -0.5 * ((np.arange(N) - 0.5) / 1.2) ** 2
    )
    problem = assemble(yaml_deck.read(chain(1000 * (1 + dip), np.ones(N)), "chain.yaml"))
    found = diagnose(problem, choices=Choices(("stiffness-loss", "mass", "ground-spring"), causes=1))
    assert (found.kind, found.field.property) == (UNKNOWN, STIFFNESS)
    assert len(found.field.values) == N and found.field.unit == "degrees of freedom"
    value = {each.site.text: (each.value, each.sd) for each in found.field.values}
    for i in range(1, N):
        here, sd = value[f"the spring between {i} and {i + 1}"]
        assert abs(here - dip[i]) < 3 * sd and 0.005 < sd < 0.05
    assert min(value, key=lambda text: value[text][0]) in ("the spring between 5 and 6", "the spring between 6 and 7")
    assert runs(found)


def test_a_field_over_the_masses_of_a_chain():
    heavier = 0.25 * np.sin(np.arange(N) / 1.6)
    problem = assemble(yaml_deck.read(chain(np.full(N, 1000.0), 1 + heavier), "chain.yaml"))
    found = diagnose(problem, choices=Choices(("stiffness-loss", "mass", "ground-spring"), causes=1))
    assert (found.kind, found.field.property, len(found.field.values)) == (UNKNOWN, MASS, N)
    assert np.corrcoef([each.value for each in found.field.values], heavier)[0, 1] > 0.95


def test_fields_are_asked_where_no_candidate_does_better_than_none():
    """Exchanged sensors do not make a chain uneven, and the model as it is leaves far more than chance."""
    heavier = 0.25 * np.sin(np.arange(N) / 1.6)
    problem = assemble(yaml_deck.read(chain(np.full(N, 1000.0), 1 + heavier), "chain.yaml"))
    found = diagnose(problem, choices=Choices(("sensor-swap",), causes=1))
    assert (found.kind, found.field.property) == (UNKNOWN, MASS)
    assert runs(found)


@pytest.mark.parametrize("explained", [True, False])
def test_all_data_together_say_whether_fields_are_asked(explained):
    """Modes leave far more than chance; where functions or recordings are heard, what the model leaves of those decides."""
    heavier = 0.25 * np.sin(np.arange(N) / 1.6)
    problem = assemble(yaml_deck.read(chain(np.full(N, 1000.0), 1 + heavier), "chain.yaml"))

    def by_all(found):
        own = found.baseline
        return replace(found, baseline=replace(own, misfit=float(own.dof))) if explained else found

    fits = rank(reduced(problem, problem.prior.mean), {}, by_all=by_all).fits
    assert any(one.nameless for one in fits) is not explained


def building(k: np.ndarray, m: np.ndarray) -> str:
    """The same as a shear building of storeys and floors that are masses."""
    text = chain(k, m)
    structure = f"""mouse: 1
model:
  structure:
    nodes: {{line: {{from: 0, to: {N}, start: [0, 0, 0], end: [0, 0, {N}]}}}}
    elements:
      - {{id: 1-{N}, type: storey, nodes: 0-{N}, TX: 1000}}
      - {{id: 101-{100 + N}, type: mass, nodes: 1-{N}, mass: 1}}
    supports: {{0: all}}
    directions: [TX]
parameters:
  - {{name: all, elements: 1-{N}, property: TX, sd: 3 %}}
"""
    sensors = ", ".join(f"{i + 1}TX" for i in range(N))
    return structure + text[text.index("test:") :].replace(", ".join(str(i + 1) for i in range(N)), sensors)


def test_a_field_over_storeys():
    """As in the chain; a mode shape of a building has one direction, and so have its storeys."""
    dip = 0.2 * np.sin(np.arange(N) / 1.7)
    problem = assemble(yaml_deck.read(building(1000 * (1 + dip), np.ones(N)), "building.yaml"))
    found = diagnose(problem, choices=Choices(("stiffness-loss", "mass", "ground-spring"), causes=1))
    assert (found.kind, found.field.property) == (UNKNOWN, STIFFNESS)
    value = {each.site.ids[0]: (each.value, each.sd) for each in found.field.values}
    assert sorted(value) == list(range(1, N + 1))
    assert all(abs(value[i + 1][0] - dip[i]) < 3 * value[i + 1][1] for i in range(N))
    assert runs(found)


def test_a_floor_without_two_of_its_masses_has_names():
    """A building that lacks the masses of two floors, which a field of mass does not take."""
    m = np.ones(N)
    m[[2, 6]] = 0.5
    problem = assemble(yaml_deck.read(building(np.full(N, 1000.0), m), "building.yaml"))
    found = diagnose(problem, choices=Choices(("mass-loss", "stiffness-loss", "ground-spring")))
    assert (found.kind, found.best.physics) == (NAMED, "mass-loss + mass-loss")
    assert {cause.site.ids for cause in found.best.causes} == {(103,), (107,)}
    assert all(abs(cause.sizes[0].value - 0.5) < 3 * cause.sizes[0].sd for cause in found.best.causes)


def small():
    """Two masses on two springs, fewer cells than a field takes."""
    deck = """mouse: 1
model: {stiffness: {order: 2, entries: [[1, 1, 2000], [1, 2, -1000], [2, 2, 1000]]}, mass: {identity: 2}}
parameters: [{name: all, nominal: 1, sd: 3 %, stiffness: [[1, 1, 2000], [1, 2, -1000], [2, 2, 1000]]}]
test: {modes: {frequency: [3.4, 8.3], frequency_sd: 0.1 %}}
"""
    return assemble(yaml_deck.read(deck, "two.yaml"))


def test_a_model_without_cells_has_no_field():
    """Two springs and two masses; what a force along some motion does is another matter."""
    problem = small()
    model = reduced(problem, problem.prior.mean)
    for rival in nameless().values():
        if getattr(rival, "spreads", None) and rival.property in (STIFFNESS, MASS, BED):
            assert rival.cells(model) is None
    ranking = rank(model, {key: registry()[key] for key in ("mass", "ground-spring")}, causes=1)
    assert not any(each.nameless and each.nameless.rival.property in (STIFFNESS, MASS, BED) for each in ranking.fits)


# --- the prior of a field, and its evidence


@pytest.mark.parametrize("share", [share for share in LENGTHS if np.isfinite(share)])
def test_its_covariance_is_that_of_a_smooth_field(share):
    """s^2 exp(-d^2 / 2 l^2) over a line of cells, but for what its last eigenvectors add: half a per cent in all."""
    problem = assemble(yaml_deck.read(deck(Truth()), "beam.yaml"))
    rival = nameless()["field-stiffness"]
    cells = rival.cells(reduced(problem, problem.prior.mean))
    field = smooth(rival, cells, 0.1, share)
    x = (np.arange(COARSE) + 0.5) / COARSE * LENGTH
    length = share * (x[-1] - x[0])
    exact = 0.01 * np.exp(-0.5 * (x[:, None] - x) ** 2 / length**2)
    assert field.length == pytest.approx(length)
    assert np.trace(exact - field.P @ field.P.T) < 0.005 * np.trace(exact)
    assert np.abs(exact - field.P @ field.P.T).max() < 0.02 * 0.01 + 0.005 * np.trace(exact)


def test_corrosion_takes_stiffness_and_mass_together():
    """15 % of the depth lost in the middle of a long stretch: EI by its cube, mass with it."""
    depth = lambda x: 1 - 0.15 * max(0.0, 1 - ((x - 0.4) / 0.25) ** 2)
    found = found_in(Truth(stiffness=lambda x: depth(x) ** 3, mass=depth), False, Choices(NAMES, causes=1))
    assert (found.kind, found.field.property) == (UNKNOWN, STIFFNESS)
    assert max(found.groups, key=lambda pair: pair[1])[0] == "field-section"
    least = min(found.field.values, key=lambda each: each.value)
    assert abs(least.site.position[0] / LENGTH - 0.4) < 0.1 and abs(least.value - (0.85**3 - 1)) < 3 * least.sd
    before, after = found.field.held_out.baseline, found.field.held_out.revised
    assert after.p > 0.01 and after.log_predictive_density > before.log_predictive_density + 10


def test_an_axial_force_under_an_even_load_is_a_slope():
    """A pull of 4 EI / L^2 at one end, as large a push at the other: what acts, and each mode from the others."""
    found = found_in(Truth(tension=lambda x: 4.0 * (1 - 2 * x)), False, Choices(NAMES, causes=1))
    assert (found.kind, found.field.property, found.field.length) == (UNKNOWN, AXIAL, np.inf)
    x, value = np.array([(each.site.position[0] / LENGTH, each.value) for each in found.field.values]).T
    assert np.abs(value - 4.0 * (1 - 2 * x)).max() < 0.8
    assert found.field.held_out.revised.rms_frequency_error < 0.5 * found.field.held_out.baseline.rms_frequency_error


def test_rivals_without_a_name_share_their_prior():
    """0.1 of all together, however many there are."""
    fits = [SimpleNamespace(recipes=(), nameless=SimpleNamespace(rival=one)) for one in nameless().values()]
    fits.append(SimpleNamespace(recipes=(), nameless=None))
    assert sum(np.exp(_log_prior(one, fits)) for one in fits[:-1]) == pytest.approx(0.1)
    assert np.exp(_log_prior(fits[-1], fits)) == pytest.approx(0.3)


def test_two_rivals_without_a_name_have_the_prior_of_a_second():
    """A seventh of that of one, all pairs together, and none of the prior of those alone."""
    of = lambda one, parts: SimpleNamespace(recipes=(), nameless=SimpleNamespace(rival=replace(one, parts=parts)))
    every = list(nameless().values())
    alone, pairs = [of(one, 1) for one in every], [of(one, 2) for one in every[:4]]
    total = lambda own: sum(np.exp(_log_prior(one, [*alone, *pairs])) for one in own)
    assert (total(alone), total(pairs)) == pytest.approx((0.1, 0.1 / 7))


@pytest.mark.proof
def test_its_evidence_is_the_mean_over_spreads_and_lengths():
    """Not the best of the grid, which would be chosen by the data: at least what the best leaves when all weigh alike."""
    problem = assemble(yaml_deck.read(deck(Truth(stiffness=WAVY[STIFFNESS])), "beam.yaml"))
    model = reduced(problem, problem.prior.mean)
    baseline = rank(model, {"tension": registry()["tension"]}, causes=1).baseline
    for one in rivals(model, baseline):
        if one.nameless.rival.property not in (STIFFNESS, MASS, BED):
            continue
        count = len(LENGTHS) * len(one.nameless.rival.spreads)
        own = one.model.base.data.slack
        best = -0.5 * one.misfit - 0.5 * np.linalg.slogdet(one.hessian)[1] - own + positive(one)
        assert best - np.log(count) - 1e-6 <= one.log_evidence <= best + 1e-6


def positive(one) -> float:
    """ln of how much more probable a positive sum of the values of a bed is by the data than beforehand; else 0."""
    if one.nameless.rival.property != BED:
        return 0.0
    own = slice(one.model.base.first.deck, one.model.base.first.deck + one.nameless.P.shape[1])
    total = one.nameless.P.sum(axis=0)
    return float(np.log(2) + norm.logcdf(total @ one.point.x[own] / np.sqrt(total @ one.covariance[own, own] @ total)))


@pytest.mark.parametrize("key", ["field-stiffness", "field-mass", "field-section", "field-bed", "force", "compliance"])
def test_what_a_field_moves_is_what_differences_of_its_matrices_do(key):
    """Central differences of K and M, times a motion, along the deck's parameters and the field."""
    problem = assemble(yaml_deck.read(deck(Truth(), True), "beam.yaml"))
    (field,) = (each for each in _spreads(reduced(problem, problem.prior.mean)) if each.rival.key == key)
    base = field.over(reduced(problem, problem.prior.mean), *field.grid[0])
    random, h = np.random.default_rng(0), 1e-5
    z, u = random.normal(size=base.L.shape[1]) / 3, random.normal(size=(base.r, 3))
    for j, found in enumerate(zip(*base.moved(z, u), strict=True)):
        step = h * (np.arange(len(z)) == j)
        ends = [base.matrices(z + side * step) for side in (1, -1)]
        for own, above, below in zip(found, *ends, strict=True):
            true = (above - below) @ u / (2 * h)
            assert np.abs(own - true).max() <= 1e-5 * max(np.abs(above @ u).max(), np.abs(true).max())
