"""A chain of three masses in closed form: modes, frequency response functions, and responses to white forces."""

import numpy as np

MASS = np.array([1.0, 1.2, 0.9])
SPRING = np.array([4e4, 3e4, 3.5e4])  # the first one to ground


def modes(zeta: float | np.ndarray = 0.02) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """omega (3,) rad/s, damping (3,), shapes (3, 3) of unit modal mass: K phi = omega^2 M phi."""
    K = np.diag(SPRING + np.append(SPRING[1:], 0)) - np.diag(SPRING[1:], 1) - np.diag(SPRING[1:], -1)
    values, vectors = np.linalg.eigh(K / np.sqrt(np.outer(MASS, MASS)))
    return np.sqrt(values), np.broadcast_to(zeta, 3).astype(float), vectors / np.sqrt(MASS)[:, None]


def accelerance(
    hz: np.ndarray, omega: np.ndarray, zeta: np.ndarray, shapes: np.ndarray, inputs: list[int]
) -> np.ndarray:
    """H (f, o, i) by superposition of modes; forces at `inputs`."""
    w = 2 * np.pi * hz[:, None]
    return np.einsum("or,ir,fr->foi", shapes, shapes[inputs], -(w**2) / (omega**2 - w**2 + 2j * zeta * omega * w))


def disturbed(H: np.ndarray, share: float, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """H with circular normal errors whose sd is a share of the root mean square of each channel, and their variance."""
    sd = share * np.sqrt((np.abs(H) ** 2).mean(axis=0)) * np.ones(H.shape)
    noise = random.standard_normal((2, *H.shape)) / np.sqrt(2)
    return H + sd * (noise[0] + 1j * noise[1]), sd**2


def responses(rate_hz: float, count: int, zeta: float, share: float, random: np.random.Generator) -> np.ndarray:
    """Accelerations (t, 3) under independent white forces, with noise that is a share of the sd of each channel."""
    whole = forced(rate_hz, random.standard_normal((count, 3)), zeta)
    return whole + share * whole.std(axis=0) * random.standard_normal(whole.shape)


def forced(rate_hz: float, forces: np.ndarray, zeta: float) -> np.ndarray:
    """Accelerations (t, 3) under forces (t, 3) that are held over each sample, modes filtered by scipy.signal."""
    from scipy.signal import cont2discrete, lfilter, ss2tf

    omega, damping, shapes = modes(zeta)
    answers = np.empty((len(forces), 3))
    for r in range(3):
        rates = [[-(omega[r] ** 2), -2 * damping[r] * omega[r]]]
        system = np.array([[0, 1], *rates]), np.array([[0.0], [1.0]]), np.array(rates), np.array([[1.0]])
        b, a = ss2tf(*cont2discrete(system, 1 / rate_hz)[:4])
        answers[:, r] = lfilter(b[0], a, forces @ shapes[:, r])
    return answers @ shapes.T
