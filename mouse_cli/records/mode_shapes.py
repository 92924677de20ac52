"""From residues to mode shapes: scaled, turned to be as real as they can be, with the covariance that they keep."""

from collections.abc import Callable

import numpy as np

_STEP = 0.01  # of a standard deviation


def collinearity(shapes: np.ndarray) -> np.ndarray:
    """Modal phase collinearity (m,) of shapes (s, m): |sum psi^2|^2 / (sum |psi|^2)^2; 1 where all phases agree.

    R. S. Pappa, K. B. Elliott, A. Schenk, Journal of Guidance, Control and Dynamics 16 (1993) 860, without removal of the mean.

    >>> import numpy as np
    >>> collinearity(np.array([[1, 1], [2, 1j]])).tolist()
    [1.0, 0.0]
    """
    size = (np.abs(shapes) ** 2).sum(axis=0)
    return np.abs((shapes**2).sum(axis=0)) ** 2 / np.where(size > 0, size, 1.0) ** 2


def turned(shape: np.ndarray) -> np.ndarray:
    """A shape (s,) turned by the phase that makes its real part largest; its largest component is positive."""
    real = shape * np.exp(-0.5j * np.angle((shape**2).sum()))
    return real * (np.sign(real[np.abs(real).argmax()].real) or 1.0)


def unit_length(shape: np.ndarray) -> np.ndarray:
    """A shape (s,) turned, with the real part at unit length."""
    real = turned(shape)
    return real / np.linalg.norm(real.real)


def unit_mass(pole: complex, drive: complex, shape: np.ndarray, point: int) -> np.ndarray:
    """The shape at unit modal mass, from receptance residues psi l_j where output `point` is at input j of participation `drive`.

    R_dd = phi_d^2 / (2 i w_d), so phi = psi sqrt(2 i w_d l_j / psi_d) (D. J. Ewins, Modal Testing, 2000, section 2.4).
    """
    return turned(shape * np.sqrt(2j * pole.imag * drive / shape[point]))


def drive_angle(pole: complex, drive: complex, at_point: complex) -> float:
    """Angle, degrees, of phi_d^2 at a driving point: 0 for a real shape and a sensor that looks along the force."""
    return float(np.degrees(np.angle(2j * pole.imag * drive * at_point)))


def propagated(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, covariance: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """function(at) (q,) and its covariance (q, q) to first order, by central differences."""
    value = function(at)
    step = np.maximum(_STEP * np.sqrt(np.maximum(np.diag(covariance), 0)), 1e-8 * np.abs(at)) + 1e-300
    slope = np.empty((len(value), len(at)))
    for k, size in enumerate(step):
        move = np.zeros_like(at)
        move[k] = size
        slope[:, k] = (function(at + move) - function(at - move)) / (2 * size)
    return value, slope @ covariance @ slope.T
