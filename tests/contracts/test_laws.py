"""What every law of a local force must keep, and what single ones are known for."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mouse_cli.model.diagnosis import Site
from mouse_cli.terms.laws import Scale, registry
from mouse_cli.terms.laws.iwan import sliders
from mouse_cli.updating.recordings.acting import Part
from mouse_cli.updating.recordings.law_forces import stepped

SCALE = Scale(1e5, 1.0, 2e-3, 0.4, (5.0, 100.0), link=1e5)
LAWS = list(registry().values())
NONLINEAR = [law for law in LAWS if not law.linear]
key = lambda law: law.key


def middle(law) -> np.ndarray:
    return np.array([np.sqrt(u.lower * u.upper) for u in law.unknowns(SCALE)])


def along(law, p: np.ndarray, x: np.ndarray, words: dict) -> np.ndarray:
    v, z, found = np.gradient(x) * 1000, np.zeros((law.states, 1)), []
    for xi, vi in zip(x, v, strict=True):
        F, z = law.force(np.array([xi]), np.array([vi]), z, p[:, None], **words)
        found.append(F[0])
    return np.array(found)


@pytest.mark.parametrize("law", LAWS, ids=key)
def test_ranges_and_words(law):
    assert all(0 < u.lower < u.upper for u in law.unknowns(SCALE))
    assert len(law.words) == len(law.variants)
    assert (law.force is None) != (law.matrices is None)


@pytest.mark.parametrize("law", NONLINEAR, ids=key)
def test_force_grows_with_its_homogeneous_parameters(law):
    x = 4e-3 * np.sin(np.linspace(0, 12, 300))
    for words in law.variants:
        force = along(law, middle(law), x, words)
        assert np.abs(force).max() > 0
        np.testing.assert_allclose(along(law, law.scaled(middle(law), 2.5), x, words), 2.5 * force, rtol=1e-12)


@pytest.mark.parametrize("law", NONLINEAR, ids=key)
def test_odd_laws_are_odd_and_the_others_are_not(law):
    x = 4e-3 * np.sin(np.linspace(0, 12, 300))
    for words in law.variants:
        there, back = (along(law, middle(law), sign * x, words) for sign in (1, -1))
        assert np.allclose(there, -back, rtol=1e-12) == law.odd


@pytest.mark.parametrize("law", LAWS, ids=key)
def test_first_search_stays_within_reach_of_the_ranges(law):
    lower, upper = (np.array([getattr(u, end) for u in law.unknowns(SCALE)]) for end in ("lower", "upper"))
    for p in law.inner(SCALE):
        assert p[law.homogeneous[0]] == 1
        free = [i for i in range(len(p)) if i not in law.homogeneous]
        assert (p[free] >= lower[free] * (1 - 1e-9)).all() and (p[free] <= upper[free] * (1 + 1e-9)).all()


@pytest.mark.parametrize("law", [law for law in LAWS if law.linear], ids=key)
def test_linear_laws_are_symmetric_or_do_no_work_and_their_own_coordinates_have_mass(law):
    for words in law.variants:
        K, C, M = law.matrices(middle(law), **words)
        for matrix in (K, C, M):
            assert matrix.shape == K.shape
            np.testing.assert_array_equal(matrix, matrix.T if law.motions == 1 else -matrix.T)
        assert (np.diag(M)[law.motions :] > 0).all()


def test_friction_loop_dissipates_what_it_should():
    kt, Fs, A = 1e5, 40.0, 2e-3
    x = A * np.sin(np.linspace(0, 4 * np.pi, 20001))
    force = along(registry()["friction"], np.array([kt, Fs]), x, {})
    cycle = slice(10000, None)
    assert np.trapezoid(force[cycle], x[cycle]) == pytest.approx(4 * Fs * (A - Fs / kt), rel=1e-3)


def test_a_spring_that_yields_is_as_stiff_as_modelled_and_then_dissipates_as_friction_does():
    ky, Fy, A = 1e5, 40.0, 2e-3
    law, x = registry()["yielding"], A * np.sin(np.linspace(0, 4 * np.pi, 20001))
    assert not along(law, np.array([ky, 1.001 * ky * A]), x, {}).any()
    with_spring = along(law, np.array([ky, Fy]), x, {}) + ky * x
    assert np.abs(with_spring).max() == pytest.approx(Fy)
    assert np.trapezoid(with_spring[10000:], x[10000:]) == pytest.approx(4 * Fy * (A - Fy / ky), rel=1e-3)
    assert law.seen_as(np.array([0.001, 3.0])) == registry()["spring"].group  # what yields at once is a spring that is lost


def test_iwan_slips_at_its_slip_force_and_is_as_stiff_as_said():
    F, K = 60.0, 2e5
    p, law = np.array([F, K, 0.5, 1.5]), registry()["iwan"]
    force = along(law, p, np.linspace(0, 1.0, 2001), {})
    assert force[-1] == pytest.approx(F, rel=0.02)
    _, stiffness = sliders(p)
    assert stiffness.sum() == pytest.approx(K, rel=1e-12)


def test_iwan_dissipates_by_the_power_of_segalman():
    power, law = 0.5, registry()["iwan"]  # 1 + chi: energy of a cycle goes with the amplitude to the power 3 + chi
    p = np.array([60.0, 2e5, power, 1.5])
    longest = sliders(p)[0][-1]
    energy = []
    for A in (0.05 * longest, 0.4 * longest):
        x = A * np.sin(np.linspace(0, 4 * np.pi, 8001))
        energy.append(np.trapezoid(along(law, p, x, {})[4000:], x[4000:]))
    assert np.log(energy[1] / energy[0]) / np.log(8) == pytest.approx(2 + power, rel=0.05)


def test_friction_that_is_not_seen_to_slip_is_a_spring():
    """Its slip force is within two sd of none and of infinite on a logarithmic scale."""
    friction = registry()["friction"]
    assert friction.seen_as(np.array([0.001, 3.0])) == registry()["spring"].group
    assert friction.seen_as(np.array([0.001, 0.1])) == "friction"


@pytest.mark.parametrize("law", [law for law in NONLINEAR if law.states], ids=key)
def test_what_depends_on_parameters_alone_is_found_once_for_all_steps(law):
    calls, x = [], 4e-3 * np.sin(np.linspace(0, 12, 300))
    counted = replace(law, prepare=lambda p: calls.append(p) or (law.prepare or (lambda p: p))(p))
    found = stepped(counted, x, np.gradient(x), middle(law)[:, None], {})
    assert len(calls) == 1
    np.testing.assert_allclose(found[:, 0], np.ravel(along(law, middle(law), x, {})), rtol=1e-12)


@pytest.mark.parametrize(("name", "says"), [("mass", "5TY"), ("oscillator", "5TY"), ("cubic", "between 5TY and the ground")])
def test_what_has_inertia_of_its_own_is_at_its_place_and_a_force_between_that_and_the_ground(name, says):
    place = SimpleNamespace(site=Site("dof", ("5TY",), text="between 5TY and the ground"))
    assert Part(place, registry()[name], 0).site.text == says
