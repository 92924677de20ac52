"""Functions of a model with a cause against the beam in closed form, their slopes, and how many lines say the same."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.blind_frf.cases import cases
from benchmarks.blind_frf.decks import write
from benchmarks.blind_frf.exact import Joint, receptance
from mouse_cli.diagnosis.extend.edit import Edit
from mouse_cli.diagnosis.likelihoods.frf.correlated import correlated
from mouse_cli.diagnosis.likelihoods.frf.damping import damping
from mouse_cli.diagnosis.likelihoods.frf.dashpots import dashpots
from mouse_cli.diagnosis.likelihoods.frf.data import FrfData, lines
from mouse_cli.diagnosis.likelihoods.frf.extend import with_loss
from mouse_cli.diagnosis.likelihoods.frf.identified import with_modes
from mouse_cli.diagnosis.likelihoods.frf.judge import Judge
from mouse_cli.diagnosis.likelihoods.frf.lossy import STRUCTURAL, VISCOUS, lossy
from mouse_cli.diagnosis.likelihoods.frf.model import FrfModel
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.study import Study
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.formats import read_deck, yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.block_window import BlockWindow
from mouse_cli.terms.assembly import assembly

K, C, LOSS = 2.0e3, 2.0, 0.3  # N/m, N s/m
X = 0.31  # of the span, not at a node: there a hinge may belong to either element, and matrices jump


@pytest.fixture(scope="module")
def control(tmp_path_factory):
    """A beam without a cause: the case, and its reduced model with its functions as data."""
    case = next(case for case in cases("development", 7, 1) if case.truth == "control")
    path, _ = write(tmp_path_factory.mktemp("frf"), case, (7, 0))
    problem, _ = with_modes(read_deck(path))
    base = reduced(problem, problem.prior.mean, EigenSolver())
    data = FrfData(tuple(lines(test, problem.theory) for test in problem.frf))
    return case, replace(base, data=data), damping(base), base


def model_of(control, recipe):
    """The model with one cause, and x of the deck's own values with the structure's damping all structural, of 0.01."""
    case, base, own, _ = control
    model = FrfModel(base, own, () if recipe is None else (recipe,))
    x = np.zeros(model.k + model.t)
    x[model.of_deck : model.lossy] = (np.log([case.nominal.eta, 1e-12, 1e-12, 1e-12]) - own.mean) / own.sd
    return model, x


def recipe_of(control, name: str):
    """A spring to the ground with a loss of its own, or a dashpot, across the beam; its values at X of the span."""
    case, base, _, modal = control
    x = X * case.nominal.length
    across = lambda recipe: "TY" in recipe.site(recipe.grid[0]).text
    if name == "dashpot":
        return next(filter(across, dashpots(modal))), [C, x]
    candidate = registry()["ground-spring"]
    recipe = lossy(next(filter(across, candidate.recipes(modal, candidate))), name, base.data.middle)
    return recipe, [K, x, LOSS]


def joint_of(control, name: str) -> Joint:
    """The same in closed form."""
    case, base, _, _ = control
    stiffness = {
        "dashpot": lambda w: 1j * w * C,
        STRUCTURAL: lambda w: K * (1 + 1j * LOSS) + 0 * w,
        VISCOUS: lambda w: K * (1 + 1j * LOSS * w / base.data.middle),
    }
    return Joint(X * case.nominal.length, stiffness=stiffness[name])


@pytest.mark.parametrize("name", ["dashpot", STRUCTURAL, VISCOUS])
def test_functions_are_those_of_the_beam_in_closed_form(control, name):
    """Within what 40 elements leave: 3e-5 of the fifth frequency, at a loss factor of 0.01."""
    case, base, _, _ = control
    recipe, values = recipe_of(control, name)
    model, x = model_of(control, recipe)
    x[model.k :] = recipe.coordinates(values)
    block, found = base.data.blocks[0], model.point(x).parts[0].H[:, :, 0]
    beam = replace(case.nominal, joints=(joint_of(control, name),))
    exact = receptance(beam, block.omega / (2 * np.pi), case.force, case.sensors)
    plain = receptance(case.nominal, block.omega / (2 * np.pi), case.force, case.sensors)
    size = np.abs(exact).max(axis=0)
    assert (np.abs(found - exact).max(axis=0) < 0.01 * size).all()
    assert (np.abs(plain - exact).max(axis=0) > 0.3 * size).all()  # the cause matters


@pytest.mark.parametrize("name", ["dashpot", STRUCTURAL, VISCOUS, "crack", "sensor-gain", "oscillator"])
def test_jacobian_is_the_slope_of_the_functions(control, name):
    if name in ("dashpot", STRUCTURAL, VISCOUS):
        recipe, values = recipe_of(control, name)
    else:
        candidate = registry()[name]
        recipe = lossy(candidate.recipes(control[3], candidate)[0], STRUCTURAL, control[1].data.middle)
        values = recipe.grid[len(recipe.grid) // 2].copy()
        values[[unknown.name == "place" for unknown in recipe.unknowns]] = X * control[0].nominal.length
    model, x = model_of(control, recipe)
    x = x + 0.3 * np.cos(np.arange(len(x)))
    x[model.of_deck : model.lossy] = 0.2
    x[model.k :] = recipe.coordinates(values)
    slopes_agree(model, x)


def late_model(control):
    """As `model_of` without a cause, of functions whose responses may be late."""
    case, base, own, _ = control
    return model_of((case, replace(base, data=base.data.delayed()), own, control[3]), None)


def test_jacobian_where_responses_are_late(control):
    model, x = late_model(control)
    x = x + 0.3 * np.cos(np.arange(len(x)))
    x[model.of_deck : model.lossy] = 0.2
    slopes_agree(model, x)


def test_a_delay_turns_the_phase_of_its_row(control):
    """By -omega tau, and no other row; 1 radian at the highest line is one standard deviation."""
    model, x = late_model(control)
    there = x.copy()
    there[model.lossy + model.gains.delays[0][2]] = 0.7
    ratio = (model.point(there).parts[0].H / model.point(x).parts[0].H)[:, :, 0]
    omega = model.base.data.blocks[0].omega
    np.testing.assert_allclose(ratio[:, 2], np.exp(-0.7j * omega / omega.max()), rtol=1e-9)
    np.testing.assert_allclose(np.delete(ratio, 2, axis=1), 1.0, rtol=1e-9)


@pytest.mark.proof
def test_jacobian_of_averages_under_a_window_with_damping_of_each_mode(control):
    """H1 of blocks of 2 s, whose lines are broader than the resonances; the damping of each of five modes is its own."""
    _, base, _, modal = control
    test = replace(modal.problem.frf[0], window=BlockWindow("hann", 2.0))
    data = FrfData((lines(test, modal.problem.theory),), np.full(5, 4e-4))
    model = FrfModel(replace(base, data=data), damping(modal, 5).unevenly(), (recipe_of(control, "dashpot")[0],))
    recipe, values = recipe_of(control, "dashpot")
    x = 0.3 * np.cos(np.arange(model.k + model.t))
    x[model.k :] = recipe.coordinates(values)
    slopes_agree(model, x)


def slopes_agree(model, x):
    """The Jacobian is that of central differences."""
    J, h = model.jacobian(model.point(x)), 3e-4
    for j in range(len(x)):
        step = h * (model.width[j - model.k] if j >= model.k else 1.0) * (np.arange(len(x)) == j)
        slope = (model.point(x - step).residual - model.point(x + step).residual) / (2 * step[j])
        assert np.linalg.norm(J[:, j] - slope) < 2e-3 * np.linalg.norm(slope) + 1e-9 * np.linalg.norm(J), j


def test_a_gain_multiplies_its_row(control):
    model, x = model_of(control, None)
    chain = model.gains.chains.outputs[0][2]
    there = x.copy()
    there[model.lossy + chain] = 1.5
    ratio = model.point(there).parts[0].H / model.point(x).parts[0].H
    expected = np.ones(8)
    expected[2] = np.exp(1.5 * model.gains.sd[chain])
    np.testing.assert_allclose(ratio[:, :, 0], np.broadcast_to(expected, ratio.shape[:2]), rtol=1e-9)


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9])
def test_neighbours_that_err_alike_count_once(control, rho):
    """Of an autoregressive sequence a sum varies (1 + rho) / (1 - rho) times as much as of independent ones (Bartlett 1946)."""
    model, x = model_of(control, None)
    point, block = model.point(x), model.base.data.blocks[0]
    rng, (f, o, i) = np.random.default_rng(3), block.has.shape
    e = np.zeros((f, o, i), complex)
    draw = rng.standard_normal((f, o, i)) + 1j * rng.standard_normal((f, o, i))
    for k in range(f):
        e[k] = rho * e[k - 1] * (k > 0) + draw[k]
    flat = e[block.has]
    one = type("One", (), {"model": model, "point": replace(point, residual=np.concatenate([flat.real, flat.imag]))})
    expected = (1 + rho) / (1 - rho)
    assert correlated(one) == pytest.approx(expected, rel=0.25)


SOFTENED = """mouse: 1
title: cantilever, softened from 1 to 2 m
model:
  structure:
    nodes: {line: {from: 0, to: 4, start: [0, 0, 0], end: [4.0, 0, 0]}}
    elements:
      - {id: 1-4, type: beam, nodes: 0-4, E: 1.0e6, nu: 0.3, density: 1.0, A: 1.0e-2, Iz: 1.0e-4, Iy: 1.0e-4, J: 1.0e-4}
    supports: {0: all}
    plane: XY
parameters:
  - {name: E, elements: 1-4, property: E, nominal: 1.0e6, sd: 5 %, transform: log}
"""


@pytest.mark.parametrize(("name", "omega"), [("loss_factor", 1.0), ("stiffness_damping", 3.0)])
def test_the_loss_of_a_softer_stretch_is_in_the_deck(name, omega, tmp_path):
    """Compliance of the tip as of springs in series: integral of x^2 / EI, and f / (1 + i eta) of it over the stretch."""
    (tmp_path / "deck.yaml").write_text(SOFTENED)
    before, f, eta, EI = read_deck(tmp_path / "deck.yaml"), 0.25, 0.02, 1.0e2
    edit = Edit(before)
    edit.bind("stiffness left", [edit.element(2)], ("Iz",), factor=1 / (1 + f))
    deck = with_loss(edit.done(), before, name, eta / omega)
    assert [p.name for p in deck.parameters[2:]] == [f"{name.replace('_', ' ')} of the part that loses energy"]
    whole = assembly(deck)
    (K, _), (C, D) = whole.matrices(deck.prior.mean), whole.damping(deck.prior.mean)
    tip = deck.structure.labels.index("4TY")
    loss = 1j * (0 if D is None else D) + 1j * omega * (0 if C is None else C)
    found = np.linalg.inv(np.asarray((K + loss).todense() if hasattr(K + loss, "todense") else K + loss))[tip, tip]
    whole_beam, stretch = 4**3 / 3, (3**3 - 2**3) / 3  # integrals of x^2, x from the tip
    exact = (whole_beam + stretch * f / (1 + 1j * eta)) / EI
    assert found.real == pytest.approx(exact.real, rel=1e-3)
    assert found.imag == pytest.approx(exact.imag, rel=2e-2)


def test_a_free_structure_has_the_loss_factor_of_its_elastic_modes():
    """Two masses on one spring with a loss factor of 0.02 and nothing else: the motion of both together strains nothing."""
    text = """\
mouse: 1
model:
  stiffness: {order: 2, entries: [[1, 1, 1000], [1, 2, -1000], [2, 2, 1000]]}
  mass: {identity: 2}
  structural_damping: {order: 2, entries: [[1, 1, 20], [1, 2, -20], [2, 2, 20]]}
test:
  modes: {number: [2], frequency: [7.1], frequency_sd: 1 %}
"""
    problem = assemble(yaml_deck.read(text, "free.yaml"))
    found = damping(reduced(problem, problem.prior.mean))
    assert found.stated == pytest.approx(0.02)
    assert np.isfinite(found.mean).all()


RAFT = """\
mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 25, start: [0, 0, 0], end: [8, 0, 0]}}
    materials: {concrete: {E: 3.0e+10, nu: 0.3, density: 2450, loss_factor: 0.02}}
    sections: {raft: {rectangle: [2.0, 0.35]}}
    elements:
      - {id: 1-24, type: beam, nodes: 1-25, material: concrete, section: raft}
      - {id: 31-54, type: foundation, nodes: 1-25, kz: 6.0e+7, loss_factor: 0.08}
    directions: [TZ, RY]
parameters:
  - {name: bed, elements: 31-54, property: kz, factor: true, sd: 8 %}
test:
  modes: {frequency: [20, 25, 40], frequency_sd: 1 %}
"""


def test_a_first_look_has_the_local_losses_of_the_deck_in_its_own_coordinates():
    """A raft whose soil loses more than its concrete: a first look in fewer coordinates ended in a ValueError."""
    problem = assemble(yaml_deck.read(RAFT, "raft.yaml"))
    base = reduced(problem, problem.prior.mean)
    few = Study(base).coarse.model
    assert few.r < base.r
    found, own = Judge(None, damping(base))._damping(few), damping(few)
    for name in ("rows", "own", "viscous"):
        assert (getattr(found, name) == getattr(own, name)).all()
    assert Judge(None, damping(base))._damping(base).rows.shape[1] == base.r


@pytest.mark.filterwarnings("error")
def test_a_step_that_goes_too_far_is_no_model_and_no_warning(control):
    model, x = model_of(control, None)
    for far in (1e6, 1e200):
        there = x.copy()
        there[model.of_deck : model.k] = far
        assert model.point(there) is None
    assert model.point(x) is not None
