"""Cracked beam, thin layer, spot weld and the generic frame element of lecture 21-1, against closed forms."""

import mpmath
import numpy as np
import pytest
from element_meshes import elements, mesh

from mouse_cli.model.arrays import dense
from mouse_cli.terms.assembly import Assembly
from mouse_cli.terms.build import built

E, NU, A, I, LENGTH, HEIGHT = 2.1e11, 0.3, 6e-4, 4.5e-8, 0.4, 0.03
G = E / (2 * (1 + NU))


def stiffness(key: str, points: list, options: dict | None = None, **properties) -> np.ndarray:
    """K (12, 12) of one free element between two points, TX..RZ of each."""
    members = elements(
        key, np.array([[0, 1]]), options=options or {}, **{k: np.full(1, v) for k, v in properties.items()}
    )
    found = built(mesh(np.array(points, float), [members]))
    K = dense(Assembly(found.structure, found.terms, 0).matrices(np.zeros(0))[0])
    assert K.shape == (12, 12)
    return K


def tip(K: np.ndarray, load: int) -> np.ndarray:
    """Motion (6,) of the second end, the first one held, under a unit load."""
    return np.linalg.solve(K[6:, 6:], np.eye(6)[load])


def _integrals(depth: float) -> tuple[float, float, float, float]:
    """F1, F2, F3, F12: integrals of pi s Y_i Y_j (Tada, Paris and Irwin)."""
    t = lambda s: mpmath.pi * s / 2
    root = lambda s: mpmath.sqrt(mpmath.tan(t(s)) / t(s)) / mpmath.cos(t(s))
    bent = lambda s: root(s) * (0.923 + 0.199 * (1 - mpmath.sin(t(s))) ** 4)
    drawn = lambda s: root(s) * (0.752 + 2.02 * s + 0.37 * (1 - mpmath.sin(t(s))) ** 3)
    shorn = lambda s: (1.122 - 0.561 * s + 0.085 * s**2 + 0.180 * s**3) / mpmath.sqrt(1 - s)
    pairs = (bent, bent), (shorn, shorn), (drawn, drawn), (bent, drawn)
    return tuple(float(mpmath.quad(lambda s, f=f, g=g: mpmath.pi * s * f(s) * g(s), [0, depth])) for f, g in pairs)


@pytest.mark.parametrize("depth", [0.1, 0.35, 0.6])
def test_cracked_cantilever(depth):
    """Deflection under a force at the tip: l^3/3EI, the turning of the crack at midspan, (l/2)^2 times, and its sliding.

    Open on one side, it also parts: along the bar under the force across, l/2 times, and across it under a force along.
    """
    K = stiffness(
        "cracked_beam", [[0, 0, 0], [LENGTH, 0, 0]],
        E=E, nu=NU, A=A, Iy=I, Iz=I, J=I, depth=depth, height=HEIGHT,
    )  # fmt: skip
    F1, F2, F3, F12 = _integrals(depth)
    c = (1 - NU**2) * HEIGHT / (E * I)
    turning, sliding, parting, both = 6 * c * F1, c * HEIGHT**2 * F2 / 6, c * HEIGHT**2 * F3 / 6, c * HEIGHT * F12
    sound = LENGTH**3 / (3 * E * I)
    assert tip(K, 1)[1] == pytest.approx(sound + (LENGTH / 2) ** 2 * turning + sliding, rel=1e-10)
    assert tip(K, 2)[2] == pytest.approx(sound, rel=1e-10), "the crack does not open in the other plane"
    assert tip(K, 0)[0] == pytest.approx(LENGTH / (E * A) + parting, rel=1e-10)
    assert tip(K, 1)[0] == pytest.approx(LENGTH / 2 * both, rel=1e-8)
    assert tip(K, 0)[1] == pytest.approx(LENGTH / 2 * both, rel=1e-8)


@pytest.mark.parametrize("depth", [0.2, 0.5])
def test_the_two_stiffnesses_of_the_cracked_element(depth):
    """Free of axial force: k_thth as lecture 21-1 prints it, and k_ww with the 2 that it lacks (see docs)."""
    K = stiffness(
        "cracked_beam", [[0, 0, 0], [LENGTH, 0, 0]],
        E=E, nu=NU, A=A, Iy=I, Iz=I, J=I, depth=depth, height=HEIGHT,
    )  # fmt: skip
    K = K - np.outer(K[:, 6], K[6]) / K[6, 6]  # the second end moves along the bar
    alpha, strain = HEIGHT / LENGTH, 1 - NU**2
    F1, F2, _, _ = _integrals(depth)
    printed = (4 + strain * (18 * alpha * F1 + 2 * alpha**3 * F2)) / (
        (1 + 6 * strain * alpha * F1) * (1 + 2 * strain * alpha**3 * F2)
    )
    assert K[5, 5] * LENGTH / (E * I) == pytest.approx(printed, rel=1e-10)
    assert K[1, 1] * LENGTH**3 / (E * I) == pytest.approx(12 / (1 + 2 * strain * alpha**3 * F2), rel=1e-10)
    bending = K[5, 5] * LENGTH / (E * I) - K[1, 1] * LENGTH**3 / (4 * E * I)
    assert bending == pytest.approx(1 / (1 + 6 * strain * alpha * F1), rel=1e-10)


@pytest.mark.parametrize("nu", [0.0, 0.2, 0.45])
def test_modulus_of_a_thin_layer(nu):
    """lambda + 2 G of an isotropic layer that cannot shrink sideways is E (1 - nu)/((1 + nu)(1 - 2 nu)), its shear modulus G."""
    area, thickness = 2e-3, 1e-4
    K = stiffness(
        "thin_layer", [[0, 0, 0], [thickness, 0, 0]],
        E=E, nu=nu, A=area, Iy=2e-9, Iz=3e-9, J=4e-9, thickness=thickness,
    )  # fmt: skip
    held = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    assert K[0, 0] == pytest.approx(held * area / thickness, rel=1e-9)
    assert K[1, 1] == pytest.approx(E / (2 * (1 + nu)) * area / thickness, rel=1e-9)
    lamda = held - E / (1 + nu)
    shear = E / (2 * (1 + nu))
    assert lamda == pytest.approx(shear * (E - 2 * shear) / (3 * shear - E), abs=1e-3 * E)
    assert np.abs(K @ np.tile(np.eye(6)[:3], 2).T).max() < 1e-9 * K.max(), "no force on a translation"


def test_normal_and_shear_of_a_contact_are_told_apart():
    """Each revised by itself: a contact that slides easily still presses."""
    common = {"A": 1e-3, "Iy": 1e-9, "Iz": 1e-9, "J": 2e-9, "thickness": 1e-3}
    K = stiffness("thin_layer", [[0, 0, 0], [1e-3, 0, 0]], normal=5e10, shear=2e8, **common)
    assert K[0, 0] == pytest.approx(5e10) and K[1, 1] == pytest.approx(2e8, rel=1e-3)


def test_spot_weld():
    """A round stub of height h under force, moment and torque: h^3/3EI + h/(kappa G A), h/EI, h/GJ, twice as much when softened."""
    h, d = 1.6e-3, 6e-3
    area, inertia = np.pi * d**2 / 4, np.pi * d**4 / 64
    for softness in (1.0, 2.0):
        K = stiffness("spot_weld", [[0, 0, 0], [h, 0, 0]], E=E, nu=NU, diameter=d, softness=softness)
        assert tip(K, 1)[1] == pytest.approx(softness * (h**3 / (3 * E * inertia) + h / (0.9 * G * area)), rel=1e-9)
        assert tip(K, 5)[5] == pytest.approx(softness * h / (E * inertia), rel=1e-9)
        assert tip(K, 3)[3] == pytest.approx(softness * h / (G * 2 * inertia), rel=1e-9)


def test_generic_frame_element_of_the_lecture():
    """K^e = U0 k U0' over (w, L w', L theta) with the U0 that lecture 21-1 prints: six parameters, no other entry."""
    rng = np.random.default_rng(3)
    names = ("symmetric_y", "antisymmetric_y", "coupling_y", "symmetric_twist_y", "antisymmetric_twist_y")
    values = dict(zip(names, rng.uniform(0.1, 0.9, 5), strict=True))
    J = 6e-8
    K = stiffness(
        "beam", [[0, 0, 0], [LENGTH, 0, 0]], {"theory": "generic"}, E=E, nu=NU, A=A, Iy=I, Iz=I, J=J, **values
    )
    # local z is global Z: w = TZ, w' = -RY, theta = RX
    at = np.array([2, 4, 3, 8, 10, 9])
    scale = np.array([1, -1 / LENGTH, 1 / LENGTH, 1, -1 / LENGTH, 1 / LENGTH])
    own = K[np.ix_(at, at)] * np.outer(scale, scale)
    a, b = np.sqrt(2) / 2, np.sqrt(10) / 10
    U0 = np.array([[0, a, 0, 0, -a, 0], [2 * b, b, 0, -2 * b, b, 0], [0, 0, a, 0, 0, -a]]).T
    k = U0.T @ own @ U0
    assert np.abs(own - U0 @ k @ U0.T).max() < 1e-12 * np.abs(own).max()
    u1, u2, u3 = (
        np.sqrt(E * I / LENGTH**3) / a,
        np.sqrt(12 * E * I / LENGTH**3) / (2 * b),
        np.sqrt(G * J / LENGTH**3) / a,
    )
    expected = {(0, 0): u1**2 * values["symmetric_y"], (1, 1): u2**2 * values["antisymmetric_y"], (2, 2): u3**2}
    expected |= {(0, 1): u1 * u2 * values["coupling_y"], (0, 2): u1 * u3 * values["symmetric_twist_y"]}
    expected |= {(1, 2): u2 * u3 * values["antisymmetric_twist_y"]}
    for place, value in expected.items():
        assert abs(k[place]) == pytest.approx(value, rel=1e-10), place
