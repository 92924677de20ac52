"""Poles of measured frequency response functions, order by order: poly-reference least squares in the complex frequency domain.

H(w) = B(w) A(w)^-1 with matrix polynomials in z = exp(i pi (w - w_1) / (w_f - w_1)), so that the band is half a turn and every
pole of the band is of its own: the coefficients are complex and mirror poles take no part. B is eliminated, the normal
equations of A are formed once, for the highest order, and their leading blocks serve the lower ones (B. Peeters et al., Shock
and Vibration 11 (2004) 395, equations 8 to 20).
"""

from dataclasses import dataclass

import numpy as np

BEYOND = 0.05  # of the band, on either side of it, in which poles are found too


@dataclass(frozen=True)
class OrderPoles:
    """Poles that one order of the denominator has in the band and a little beyond.

    order: of the polynomial; poles (k,) complex, rad/s, unstable ones with a positive real part; participation (i, k): how much
    each input excites them, largest component 1.
    """

    order: int
    poles: np.ndarray
    participation: np.ndarray


def lscf(omega: np.ndarray, H: np.ndarray, weight: np.ndarray, orders: range) -> list[OrderPoles]:
    """Poles for each of `orders`. omega (f,) rad/s, ascending; H (f, o, i); weight (f, o, i), 0 where H is not measured.

    The coefficient of z^0 is the unit matrix: poles that noise alone makes then lie outside the unit circle, which tells them
    from those of the structure.
    """
    turn = np.pi / (omega[-1] - omega[0])
    powers = np.exp(1j * turn * (omega - omega[0]))[:, None] ** np.arange(max(orders) + 1)
    normal = _normal(powers, H, weight)
    inputs = H.shape[2]
    return [
        _solved(order, normal[: (order + 1) * inputs, : (order + 1) * inputs], inputs, omega, turn) for order in orders
    ]


def _normal(powers: np.ndarray, H: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Sum over outputs of T - S^H R^-1 S: the normal equations ((n + 1) i, (n + 1) i) of A alone."""
    lines, size = powers.shape
    inputs = H.shape[2]
    total = np.zeros((size * inputs, size * inputs), complex)
    for output in range(H.shape[1]):
        known = weight[:, output].min(axis=1) > 0
        w = known / np.sqrt(
            np.where(known, (1 / np.where(known[:, None], weight[:, output], 1) ** 2).mean(axis=1), 1.0)
        )
        response = np.where(known[:, None], H[:, output], 0)
        left = w[:, None] * powers
        right = (left[:, :, None] * response[:, None, :]).reshape(lines, -1)
        basis, _ = np.linalg.qr(left)
        right = right - basis @ (basis.conj().T @ right)
        total += right.conj().T @ right
    return total


def _solved(order: int, normal: np.ndarray, inputs: int, omega: np.ndarray, turn: float) -> OrderPoles:
    """Roots of det A(z) that lie in the band, as poles."""
    rest = -np.linalg.lstsq(normal[inputs:, inputs:], normal[inputs:, :inputs], rcond=None)[0]
    coefficients = np.concatenate([np.eye(inputs), rest]).reshape(order + 1, inputs, inputs)
    # transposed: the row vectors that A(z) annihilates are the participations; w = 1/z turns A into a monic polynomial
    blocks = coefficients.transpose(0, 2, 1)
    companion = np.eye(order * inputs, k=-inputs, dtype=complex)
    companion[:inputs] = np.concatenate(list(-blocks[1:]), axis=1)
    inverse, vectors = np.linalg.eig(companion)
    last = vectors[-inputs:] if order > 1 else vectors
    known = (np.abs(inverse) > 1e-8) & (np.abs(last).max(axis=0) > 0)
    poles = 1j * omega[0] - np.log(inverse[known]) / turn
    margin = BEYOND * (omega[-1] - omega[0])
    inside = (poles.imag > max(omega[0] - margin, 0)) & (poles.imag < omega[-1] + margin)
    return OrderPoles(order, poles[inside], unit_largest(last[:, known][:, inside]))


def unit_largest(vectors: np.ndarray) -> np.ndarray:
    """Columns (i, k) scaled so that the largest component of each is 1."""
    if not vectors.size:
        return vectors
    largest = np.abs(vectors).argmax(axis=0)
    return vectors / vectors[largest, np.arange(vectors.shape[1])]
