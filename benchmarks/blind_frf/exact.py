"""Frequency response of straight bending beams in closed form: no mesh, no modes.

Between forces, hinges and ends the deflection is w = a cos bx + b sin bx + c exp(-bx) + d exp(-b(l - x)) with
b^4 = rho A omega^2 / (E I (1 + i eta)), the Euler-Bernoulli equation with structural damping; the constants follow from what holds
at the ends and between neighbouring segments.
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Joint:
    """What is at x (m): compliance(omega) of a hinge, rad per N m, and dynamic stiffness(omega) to the ground, N/m; complex."""

    x: float
    compliance: object = None
    stiffness: object = None


@dataclass(frozen=True)
class Beam:
    """length m; EI N m^2; mass kg/m; eta: structural loss factor; ends: `pinned`, `clamped` or `free`, left and right."""

    length: float
    EI: float
    mass: float
    eta: float
    ends: tuple[str, str] = ("pinned", "pinned")
    joints: tuple[Joint, ...] = field(default=())


def receptance(beam: Beam, frequency_hz: np.ndarray, force: float, sensors: np.ndarray) -> np.ndarray:
    """Deflection at `sensors` (s,) for a unit transverse force at x = `force`: (f, s), m/N, complex, for e^{+i omega t}."""
    omega = 2 * np.pi * np.asarray(frequency_hz, dtype=float)
    EI = beam.EI * (1 + 1j * beam.eta)
    wave = (beam.mass * omega**2 / EI + 0j) ** 0.25
    wave = np.where(wave.real < 0, -wave, wave)
    inner = sorted({force, *(joint.x for joint in beam.joints)} - {0.0, beam.length})
    edges = np.array([0.0, *inner, beam.length])
    A, b = _conditions(beam, edges, omega, wave, EI, force)
    constants = np.linalg.solve(A, b[..., None])[..., 0].reshape(len(omega), -1, 4)
    segment = np.clip(np.searchsorted(edges, sensors, side="right") - 1, 0, len(edges) - 2)
    lengths = np.diff(edges)
    rows = [_shape(0, wave, x - edges[k], lengths[k]) for x, k in zip(sensors, segment, strict=True)]
    return np.stack([(row * constants[:, k]).sum(axis=1) for row, k in zip(rows, segment, strict=True)], axis=1)


def _shape(order: int, wave: np.ndarray, x: float, length: float) -> np.ndarray:
    """The `order`-th derivative (f, 4) at x of the four functions of a segment."""
    phase = wave * x
    sign = [(np.cos(phase), np.sin(phase)), (-np.sin(phase), np.cos(phase))]
    sign += [tuple(-v for v in pair) for pair in sign]
    far, near = np.exp(-phase), np.exp(-wave * (length - x))
    return np.stack([*sign[order], (-1) ** order * far, near], axis=1) * wave[:, None] ** order


def _conditions(beam: Beam, edges: np.ndarray, omega: np.ndarray, wave: np.ndarray, EI: complex, force: float) -> tuple:
    """Equations (f, 4k, 4k) for the constants of k segments, and their right-hand sides (f, 4k)."""
    lengths, k = np.diff(edges), len(edges) - 1
    A, b = np.zeros((len(omega), 4 * k, 4 * k), complex), np.zeros((len(omega), 4 * k), complex)
    row = 0
    for end, segment, x in ((0, 0, 0.0), (1, k - 1, lengths[-1])):
        for order in {"pinned": (0, 2), "clamped": (0, 1), "free": (2, 3)}[beam.ends[end]]:
            A[:, row, 4 * segment : 4 * segment + 4] = _shape(order, wave, x, lengths[segment])
            row += 1
    for i in range(k - 1):
        left = [_shape(order, wave, lengths[i], lengths[i]) for order in range(4)]
        right = [_shape(order, wave, 0.0, lengths[i + 1]) for order in range(4)]
        before, after = slice(4 * i, 4 * i + 4), slice(4 * i + 4, 4 * i + 8)
        for order in range(4):
            A[:, row + order, before], A[:, row + order, after] = -left[order], right[order]
        for joint in (joint for joint in beam.joints if joint.x == edges[i + 1]):
            if joint.compliance is not None:  # the slope jumps by compliance * EI w''
                A[:, row + 1, before] -= (joint.compliance(omega) * EI)[:, None] * left[2]
            if joint.stiffness is not None:  # EI (w'''+ - w'''-) = force - stiffness w
                A[:, row + 3, before] += (joint.stiffness(omega) / EI)[:, None] * left[0]
        if edges[i + 1] == force:
            b[:, row + 3] = 1 / EI
        row += 4
    scale = np.abs(A).max(axis=2, keepdims=True)
    return A / scale, b / scale[..., 0]
