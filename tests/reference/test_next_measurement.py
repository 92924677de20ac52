"""Predicted separation of two explanations, against dense eigensolutions of both models by scipy."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh
from test_locate import chain, measured, problem

from mouse_cli.diagnosis.likelihoods.modal.baseline import reduced
from mouse_cli.diagnosis.likelihoods.modal.model import Model
from mouse_cli.diagnosis.mechanisms import registry
from mouse_cli.diagnosis.search.fit import fit
from mouse_cli.diagnosis.validate import next_measurement
from mouse_cli.diagnosis.validate.measurements import SHAPE_SD, measurements
from mouse_cli.diagnosis.validate.next_measurement import chosen_places, order, proposals, separated
from mouse_cli.formats import read_deck
from mouse_cli.model.arrays import dense
from mouse_cli.model.diagnosis import Effort, Proposal
from mouse_cli.terms.assembly import assembly

HELD = 4e4  # N/m, of the spring to the ground that the model lacks


@pytest.fixture(scope="module")
def rivals():
    """A spring to the ground at degree of freedom 3, and a mass there, each fitted to two modes that the spring has made."""
    K, M = chain(), np.eye(4)
    deck = problem(K, M, measured(K + HELD * np.outer(np.eye(4)[2], np.eye(4)[2]), M, [0, 3], 2, noise=0.05), sd=0.3)
    base, found = reduced(deck, deck.prior.mean), []
    for name in ("ground-spring", "mass"):
        recipe = registry()[name].recipes(base, registry()[name])[2]
        found.append(
            fit(Model(base, (recipe,)), recipe.coordinates(np.array([3e4 if name == "ground-spring" else 0.2])))
        )
    return found


def predicted(one, spring: bool, numbers, K_added=0.0, M_added=0.0, top=np.inf):
    """ln of modes `numbers` (rad/s), at most `top`, and J C J', by differences: x = [(factor - 1) / sd, ln size]."""

    def log_hz(x):
        at = np.outer(np.eye(4)[2], np.eye(4)[2]) * np.exp(x[1])
        K, M = (1 + 0.3 * x[0]) * chain() + spring * at + K_added, np.eye(4) + (not spring) * at + M_added
        return 0.5 * np.log(np.minimum(eigh(K, M, eigvals_only=True)[numbers], top**2))

    x, step = one.point.x, 1e-5
    J = np.array([(log_hz(x + step * e) - log_hz(x - step * e)) / (2 * step) for e in np.eye(2)]).T
    return log_hz(x), J @ one.covariance @ J.T


def separation(rivals, sd, *how):
    (h, one), (g, other) = (predicted(each, spring, *how) for each, spring in zip(rivals, (True, False), strict=True))
    return 0.5 * (h - g) @ np.linalg.solve(sd**2 * np.eye(len(h)) + one + other, h - g)


def test_a_mode_that_only_one_of_two_has_is_to_be_looked_for(rivals, monkeypatch):
    """Whichever of the two has it; its absence speaks by the nats of `unseen`."""
    own = {id(rivals[1]): (0.58,)}
    monkeypatch.setattr(next_measurement, "unmeasured_hz", lambda one: own.get(id(one), ()))
    monkeypatch.setattr(next_measurement, "unseen", lambda one: 5.4)
    for order_, names in ((rivals, ["a", "b"]), (rivals[::-1], ["b", "a"])):
        (found,) = [each for each in proposals(order_, names) if "whether there is a mode" in each.text]
        assert found.text == "whether there is a mode at about 0.58 Hz, which a lumped mass would make"
        assert (found.separation, found.effort, found.between) == (5.4, Effort.MODES, tuple(names))
    own[id(rivals[0])] = (0.6,)
    assert not [each for each in proposals(rivals, ["a", "b"]) if "whether there is a mode" in each.text]


def test_every_kind_of_measurement(rivals):
    """Modes, masses at degrees of freedom 1 to 4 and each of these held: their separations are those of dense models.

    A fifth above the highest measured frequency the band of the test ends.
    """
    top = 1.2 * 2 * np.pi * rivals[0].model.base.data.test.frequency_hz.max()
    every = list(measurements(rivals[0]))
    assert {each.kind for each in every} == {"modes", "mass", "held", "sensor", "repeated"}
    for each in every:
        ours = separated(*rivals, each)
        if each.kind in ("sensor", "repeated"):
            continue
        if each.kind == "modes":
            count = 1 if "frequency" in each.text else int(each.text.split()[-1]) - 2
            if count > 2:
                assert np.isnan(ours)  # the chain has no fifth mode
                continue
            theirs = separation(rivals, each.sd, np.arange(2, 2 + count))
        else:
            at = int(each.text.split("degree of freedom ")[1].split()[0]) - 1
            size = np.outer(np.eye(4)[at], np.eye(4)[at])
            how = (0.0, 0.05 * 4 * size) if each.kind == "mass" else (1e9 * size, 0.0)  # rigid beside springs of 1e5
            theirs = separation(rivals, each.sd, np.arange(2), *how, top)
        assert ours == pytest.approx(theirs, rel=0.1), (
            each.text
        )  # J is a difference over 0.01 sd; what holds gives way a little


def test_sensors_stand_where_there_are_none_yet(rivals):
    """Sensors are at degrees of freedom 1 and 4; a further one is proposed elsewhere, another reading at these."""
    every = list(measurements(rivals[0]))
    assert [each.text for each in every if each.kind == "sensor"] == [
        "the shapes at degree of freedom 2 too",
        "the shapes at degree of freedom 3 too",
    ]
    assert [each.text for each in every if each.kind == "repeated"] == [
        "the shapes at 1 again, by another sensor",
        "the shapes at 4 again, by another sensor",
    ]


def test_the_best_of_each_kind_is_proposed(rivals):
    found = proposals(rivals, ["ground-spring", "mass"])
    every = [(each.kind, separated(*rivals, each)) for each in measurements(rivals[0])]
    best = {kind: np.nanmax([value for other, value in every if other == kind]) for kind, _ in every}
    best["modes"] = next((value for kind, value in every if kind == "modes" and value > 4), best["modes"])
    assert sorted(p.separation for p in found) == pytest.approx(sorted(best.values()))
    assert list(found) == sorted(found, key=order)
    assert all(p.between == ("ground-spring", "mass") for p in found)


def test_what_settles_comes_first_and_with_the_least_effort():
    """D > 4 before D > 1 before the rest; then what takes less; then what separates more."""
    ways = [(0.5, Effort.MODES), (5.0, Effort.SUPPORT), (9.0, Effort.MASS), (3.0, Effort.MODES), (4.5, Effort.MASS)]
    found = sorted((Proposal("", ("a", "b"), d, effort) for d, effort in ways), key=order)
    assert [p.separation for p in found] == [9.0, 4.5, 5.0, 3.0, 0.5]
    assert [p.outlook for p in found] == ["will settle it"] * 3 + ["may settle it", "will not settle it"]


def test_shapes_are_proposed_at_the_fewest_places_that_separate():
    """Two shapes at 5 places that differ at the fourth alone, by 0.5 of the largest component: with another place, which gives the
    scale, it is enough. D = d^2 / (4 s^2) where two readings of sd s differ by d across the direction of the scale."""
    h = np.array([[1.0], [0.9], [0.8], [1.0], [0.7]])
    g = h.copy()
    g[3] = 0.5
    none = np.zeros((5, 5))
    places, D = chosen_places((h.ravel(), none), (-g.ravel(), none), 5, 1)
    assert len(places) == 2
    assert 3 in places
    assert pytest.approx(0.5 * (0.5 / np.sqrt(2) / SHAPE_SD) ** 2, rel=0.01) == D


def test_shapes_that_are_alike_are_no_proof():
    h = np.linspace(0.2, 1.0, 6)
    assert chosen_places((h, np.zeros((6, 6))), (3 * h, np.zeros((6, 6))), 6, 1)[1] == pytest.approx(0.0, abs=1e-3)


def test_supports_of_a_model_are_released_once(tmp_path, monkeypatch):
    """A column between two clamps, two masses as rivals on it: each model makes its supports once, however many are let go."""
    path = tmp_path / "column.yaml"
    path.write_text(COLUMN.replace("{1: all}", "{1: all, 7: all}"))
    deck = read_deck(str(path))
    base, mass, asked = reduced(deck, deck.prior.mean), registry()["mass"], []
    recipe = mass.recipes(base, mass)[0]
    found = [fit(Model(base, (recipe,)), recipe.coordinates(np.array([1.0, at])), most=3) for at in (0.5, 2.5)]
    counted = lambda of: lambda model, candidate: asked.append(candidate.key) or of(model, candidate)
    made = registry()
    for name in ("support-translation", "support-rotation"):
        made[name] = replace(made[name], recipes=counted(made[name].recipes))
    monkeypatch.setattr("mouse_cli.diagnosis.validate.measurements.registry", lambda: made)
    several = [each for each in measurements(found[0]) if each.kind == "released"]
    assert len(several) > 1
    for each in several:
        separated(*found, each)
    assert len(asked) <= 2 * len({id(one.model.base) for one in found})
    assert all("TY" not in each.text for each in several)  # what bears the weight


def test_nobody_lets_a_tower_go_from_its_foot(tmp_path):
    path = tmp_path / "column.yaml"
    path.write_text(COLUMN)
    deck, mass = read_deck(str(path)), registry()["mass"]
    base = reduced(deck, deck.prior.mean)
    recipe = mass.recipes(base, mass)[0]
    one = fit(Model(base, (recipe,)), recipe.coordinates(np.array([1.0, 0.5])), most=3)
    assert not [each for each in measurements(one) if each.kind == "released"]


def test_a_sensor_on_a_support_reads_what_the_deck_with_that_support_on_a_spring_does(tmp_path):
    """Where no cause lets it move it reads nothing, and is proposed for the sake of one that does."""
    path = tmp_path / "column.yaml"
    seen = "frequency_sd: 1 %, dofs: [4TX, 7TX], shapes: [[0.4, -0.7], [1, 1]], shape_sd: 1 %}"
    path.write_text(COLUMN.replace("frequency_sd: 1 %}", seen))
    deck = read_deck(str(path))
    base = reduced(deck, deck.prior.mean)

    def fitted(physics: str, *values: float):
        recipe = registry()[physics].recipes(base, registry()[physics])[0]
        return fit(Model(base, (recipe,)), recipe.coordinates(np.array(values)), most=0)

    free, held = fitted("support-translation", 2e6), fitted("mass", 1.0, 2.5)
    assert "support" not in {each.kind for each in measurements(held)}
    (sensor,) = [each for each in measurements(held, free) if each.kind == "support"]
    (tip,) = [each for each in measurements(free) if each.text == "the shapes at 7TX again, by another sensor"]
    assert sensor.text == "the shapes at the support of node 1 too" and free.sites[0].text == "the support of node 1, TX"
    modes = free.point.modes
    read = lambda one: sensor.read(one.point, one, modes).reshape(-1, len(modes))[0]
    assert not read(held).any()
    on_spring = free.recipes[0].extend(deck, np.array([2e6]))
    K, M = map(dense, assembly(on_spring).matrices(on_spring.prior.mean))
    X = eigh(K, M)[1][:, modes]
    rows = [on_spring.structure.labels.index(label) for label in ("1TX", "7TX")]
    np.testing.assert_allclose(read(free) / tip.read(free.point, free, modes), X[rows[0]] / X[rows[1]], rtol=0.02)


COLUMN = """\
mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 7, start: [0, 0], end: [0, 3]}}
    elements:
      - {id: 1-6, type: beam, nodes: 1-7, E: 2.1e+11, G: 8.1e+10, density: 7850, A: 0.01, Iz: 1.0e-5, Iy: 1.0e-5, J: 1.0e-5}
    supports: {1: all}
    plane: XY
test:
  modes: {number: [1, 2], frequency: [20, 130], frequency_sd: 1 %}
"""
