"""The truth solver against what is known in closed form by other ways."""

import numpy as np

from benchmarks.blind_frf.exact import Beam, Joint, receptance

_PLAIN = Beam(1.0, 100.0, 2.0, 0.01)
_LINES = np.linspace(1.0, 400.0, 60)
_SENSORS = np.array([0.1, 0.33, 0.5, 0.8])
_FORCE = 0.3


def verify() -> dict[str, float]:
    """Largest relative difference, by what was compared."""
    return {
        "pinned beam, against 3000 modes": _modes(),
        "mass and spring at a point, against coupling of receptances": _coupled(),
        "hinge, static, against the work of moments": _hinge(),
        "cantilever, static, against its deflection": _cantilever(),
    }


def _modes() -> float:
    H, omega = receptance(_PLAIN, _LINES, _FORCE, _SENSORS), 2 * np.pi * _LINES[:, None]
    total = np.zeros_like(H)
    for n in range(1, 3001):
        a = n * np.pi
        shape = 2 / (_PLAIN.mass * _PLAIN.length) * np.sin(a * _FORCE) * np.sin(a * _SENSORS)
        total += shape / (_PLAIN.EI * (1 + 1j * _PLAIN.eta) * a**4 / _PLAIN.mass - omega**2)
    return float(abs(H / total - 1).max())


def _coupled() -> float:
    joint = Joint(0.4, stiffness=lambda w: 500 - 0.3 * w**2 + 0j)
    z = joint.stiffness(2 * np.pi * _LINES)
    at = np.array([joint.x])
    own = receptance(_PLAIN, _LINES, joint.x, at)[:, 0]
    across = receptance(_PLAIN, _LINES, joint.x, _SENSORS) * (
        z / (1 + z * own) * receptance(_PLAIN, _LINES, _FORCE, at)[:, 0]
    ).reshape(-1, 1)
    found = receptance(Beam(1.0, 100.0, 2.0, 0.01, joints=(joint,)), _LINES, _FORCE, _SENSORS)
    return float(abs(found / (receptance(_PLAIN, _LINES, _FORCE, _SENSORS) - across) - 1).max())


def _hinge() -> float:
    compliance, x, low = 0.01, 0.4, np.array([1e-4])
    stiff = Beam(1.0, 100.0, 2.0, 0.0)
    loose = Beam(1.0, 100.0, 2.0, 0.0, joints=(Joint(x, compliance=lambda w: compliance + 0j * w),))
    added = receptance(loose, low, _FORCE, _SENSORS) - receptance(stiff, low, _FORCE, _SENSORS)
    moment = lambda load: np.where(x < load, x * (1 - load), load * (1 - x))
    return float(abs(added[0] / (compliance * moment(_FORCE) * moment(_SENSORS)) - 1).max())


def _cantilever() -> float:
    beam, load, low = Beam(1.0, 100.0, 2.0, 0.0, ("clamped", "free")), 0.6, np.array([1e-4])
    x = np.array([0.2, 0.6, 0.9])
    near, far = np.minimum(x, load), np.maximum(x, load)
    expected = near**2 * (3 * far - near) / (6 * beam.EI)
    return float(abs(receptance(beam, low, load, x)[0] / expected - 1).max())
