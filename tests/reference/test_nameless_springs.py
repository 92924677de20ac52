"""Springs and axial forces that no mechanism of the library is: beams of finite elements written in `hermite_beams`."""

from types import SimpleNamespace

import numpy as np
import pytest
from hermite_beams import LENGTH, Truth, deck
from proofs import proofs
from scipy.optimize import minimize

from mouse_cli.diagnosis import diagnose
from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.nameless import fit as fitted
from mouse_cli.diagnosis.nameless import registry
from mouse_cli.diagnosis.nameless._both import both
from mouse_cli.diagnosis.nameless._field import fielded, smooth
from mouse_cli.diagnosis.nameless._tied import tied
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.formats import yaml_deck
from mouse_cli.formats.assemble import assemble
from mouse_cli.model.diagnosis import AXIAL, FORCE, STIFFNESS, UNKNOWN, Choices, Site
from mouse_cli.report.verdict_sentences import sentences

NAMES = ("tension", "compression", "ground-spring", "mass", "stiffness-loss", "crack")


def found_in(truth: Truth, free: bool):
    return diagnose(assemble(yaml_deck.read(deck(truth, free), "beam.yaml")), choices=Choices(NAMES, causes=1))


def halved(held) -> bool:
    """Whether the error of frequencies that were held out is at least halved."""
    return held.revised.rms_frequency_error < 0.5 * held.baseline.rms_frequency_error


@pytest.mark.parametrize("free", proofs([False, True], False))
def test_a_spring_between_distant_places(free):
    """At 0.325 and 0.775 of the length, no nodes of the deck: found there, and in the deck that is written."""
    found = found_in(Truth(ties=((0.325, 0.775, 60.0),)), free)
    assert (found.kind, found.field.property) == (UNKNOWN, FORCE)
    one, other = sorted(found.field.values, key=lambda each: each.site.position[0])
    assert [each.site.position[0] / LENGTH for each in (one, other)] == pytest.approx([0.325, 0.775], abs=0.02)
    assert one.value == -other.value and halved(found.field.held_out)
    assert not found.extended_result.rejected
    k = found.extended_result.revised.theta[-1]
    assert k * LENGTH**3 / (2.1e11 * 0.02 * 0.006**3 / 12) == pytest.approx(60, rel=0.1)


def test_a_spring_against_a_turn():
    """As of an outrigger at 0.6 of a cantilever."""
    found = found_in(Truth(turns=((0.6, 4.0),)), False)
    assert (found.kind, found.field.property, len(found.field.values)) == (UNKNOWN, FORCE, 1)
    assert found.field.values[0].site.position[0] / LENGTH == pytest.approx(0.6, abs=0.02)
    assert halved(found.field.held_out) and not found.extended_result.rejected


@pytest.mark.proof
def test_an_outrigger_on_a_beam_of_uneven_stiffness():
    """Neither of the two explains the data; both at once do, each at its place, and predict modes that no fit has seen."""
    wave = lambda x: 1 + 0.2 * np.sin(2 * np.pi * 1.6 * x + 0.4)
    found = found_in(Truth(stiffness=wave, turns=((0.6, 4.0),)), False)
    assert (found.kind, found.groups[0][0]) == (UNKNOWN, "spring and field-stiffness")
    assert (found.field.property, found.field.beside.property) == (STIFFNESS, FORCE)
    (end,) = found.field.beside.values
    assert end.site.position[0] / LENGTH == pytest.approx(0.6, abs=0.02) and abs(end.value) > 5 * end.sd
    x, value, sd = np.array([(v.site.position[0] / LENGTH, v.value, v.sd) for v in found.field.values]).T
    assert np.corrcoef(value, wave(x))[0, 1] > 0.9
    assert (np.abs(value - wave(x) + 1) < 3 * sd).mean() > 0.8
    assert halved(found.field.held_out) and not found.extended_result.rejected
    assert "A second change is there with it. It acts as one spring against the turn of" in sentences(found)[0]


def test_two_rivals_at_once_and_their_derivatives():
    """K and M are those of both, and so are what they add to first order, by central differences."""
    problem = assemble(yaml_deck.read(deck(Truth(), False), "beam.yaml"))
    model, known = reduced(problem, problem.prior.mean), registry()
    cells = {key: known[key].cells(model) for key in ("force", "compliance", "field-section", "field-bed")}
    rng = np.random.default_rng(3)
    for key, put in (("force", tied), ("compliance", tied), ("field-bed", fielded)):
        sign = (known[key].signs or (0,))[0]
        other = put(model, smooth(known[key], cells[key], 0.3, 0.5, sign), cells[key])
        two = both(other, smooth(known["field-section"], cells["field-section"], 0.1, 0.5), cells["field-section"])
        z, u = 0.3 * rng.standard_normal(two.L.shape[1]), rng.standard_normal((two.r, 2))
        alone = fielded(model, two.nameless, cells["field-section"])
        own = len(alone.of_field)
        parts = (alone.matrices(z[: two.deck + own]), other.matrices(np.delete(z, np.arange(two.deck, two.deck + own))))
        for whole, one, more, bare in zip(two.matrices(z), *parts, model.matrices(z[: two.deck]), strict=True):
            assert whole == pytest.approx(one + more - bare, rel=1e-9, abs=1e-9 * np.abs(whole).max())
        for i, step in enumerate(1e-5 * np.eye(len(z))):
            ends = zip(two.matrices(z + step), two.matrices(z - step), two.moved(z, u), two.slopes(z), strict=True)
            for up, down, moved, slope in ends:
                size = 1e-5 * np.abs(up @ u).max()
                assert moved[i] == pytest.approx((up - down) @ u / 2e-5, rel=1e-4, abs=size)
                assert slope[i] @ u == pytest.approx(moved[i], rel=1e-9, abs=size)


@pytest.mark.parametrize("key", ["force", "compliance"])
@pytest.mark.parametrize("beside", [False, True])
def test_how_a_change_of_rank_one_bends(key, beside):
    """Second derivatives of K, by differences of the first where there is no change yet; beside a field by unknowns of both."""
    problem = assemble(yaml_deck.read(deck(Truth(), False), "beam.yaml"))
    model, known = reduced(problem, problem.prior.mean), registry()
    cells = {name: known[name].cells(model) for name in (key, "field-section")}
    one = tied(model, smooth(known[key], cells[key], 0.3, 0.5, known[key].signs[0]), cells[key])
    if beside:
        one = both(one, smooth(known["field-section"], cells["field-section"], 0.1, 0.5), cells["field-section"])
    z, u, h = np.zeros(one.L.shape[1]), np.eye(one.r)[:, :5], 1e-6 * np.eye(one.L.shape[1])
    for i, j, bent in zip(*one.second_slopes(z, u), strict=True):
        up, down = (one.moved(z + step, u)[0][i] for step in (h[j], -h[j]))
        assert bent == pytest.approx((up - down) / 2e-6, abs=1e-3 * np.abs(bent).max())


def test_a_descent_past_where_a_change_of_rank_one_vanishes():
    """Both motions end at one optimum, which another optimiser does not leave: steps by slopes alone cross zero to and fro."""
    problem = assemble(yaml_deck.read(deck(Truth(tension=lambda x: -2.0 + 0 * x), False), "beam.yaml"))
    model, rival = reduced(problem, problem.prior.mean), registry()["force"]
    field = smooth(rival, cells := rival.cells(model), 1.0, np.inf, rival.signs[0])
    trial = Model(tied(model, field, cells))
    ends = [fit(trial, np.zeros(0), np.append(np.zeros(model.L.shape[1]), 0.1 * w)) for w in np.eye(2)]
    assert ends[0].misfit == pytest.approx(ends[1].misfit, rel=1e-6)
    cost = lambda x: trial.point(x).chi2 + x @ x
    assert minimize(cost, ends[0].point.x, method="Nelder-Mead").fun > (1 - 1e-6) * ends[0].misfit


def test_an_axial_force_that_varies():
    """A pull of 12 EI/L^2 at one end of a cantilever that falls to a push of 6 at the other."""
    pull = lambda x: 12.0 - 18.0 * x
    found = found_in(Truth(tension=pull), False)
    assert (found.kind, found.field.property) == (UNKNOWN, AXIAL)
    x, value, sd = np.array([(v.site.position[0] / LENGTH, v.value, v.sd) for v in found.field.values]).T
    assert np.corrcoef(value, pull(x))[0, 1] > 0.9
    assert (np.abs(value - pull(x)) < 3 * sd).mean() > 0.8
    assert halved(found.field.held_out) and not found.extended_result.rejected


@pytest.mark.parametrize(
    ("values", "order", "shown"),
    [
        ((0.1, 0.4), ("field-stiffness", "field-bed"), True),
        ((0.3, 0.4), ("field-bed", "field-stiffness"), True),
        ((0.1, 0.1), ("field-bed", "field-stiffness"), False),
    ],
)
def test_of_two_rivals_at_once_that_which_is_shown_is_told_first(monkeypatch, values, order, shown):
    """None of the values of the first differs from 0 by two standard deviations (of 0.1), or one does."""
    sizes = {"field-bed": values[0], "field-stiffness": values[1]}
    cells = SimpleNamespace(sites=(Site("node", (1,)),), unit="m")
    named = lambda key: SimpleNamespace(rival=SimpleNamespace(property=key), cells=cells, spread=1.0, length=1.0)
    base = SimpleNamespace(other=SimpleNamespace(nameless=named("field-stiffness")))
    one = SimpleNamespace(nameless=named("field-bed"), model=SimpleNamespace(base=base))
    of = lambda key: (np.array([sizes[key]]), np.array([0.1]))
    monkeypatch.setattr(fitted, "mean_values", lambda one: of("field-bed"))
    monkeypatch.setattr(fitted, "values_of_other", lambda one: of("field-stiffness"))
    ranking = SimpleNamespace(fits=(one,), log_odds=(3.0,), named=[0])
    found = fitted.field_of(ranking, one)
    assert (found.property, found.beside.property) == order and fitted.significant(one) == shown
