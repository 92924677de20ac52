"""Writes functions.csv: accelerances of a chain of five masses in closed form, with a spring that its deck does not have.

A uniform chain, fixed at its lower end, has (Rayleigh; Blevins 1979, table 8-1) with m = 2 kg and k = 1e5 N/m

    omega_r^2 = 4 k/m sin^2(a_r / 2),  x_r(j) = sqrt(4 / (m (2 n + 1))) sin(j a_r),  a_r = (2 r - 1) pi / (2 n + 1)

so that its receptance is H_0 = sum_r x_r x_r' / (omega_r^2 (1 + i eta) - omega^2). A spring kappa = k_c (1 + i eta_c) from mass c
to the ground makes of it (Sherman and Morrison 1950)

    H = H_0 - H_0(:, c) kappa / (1 + kappa H_0(c, c)) H_0(c, :)

Noise of 1 % of each value from a fixed seed, on real and imaginary part.
"""

from pathlib import Path

import numpy as np

N, MASS, STIFFNESS, LOSS = 5, 2.0, 1.0e5, 0.02
AT, SPRING, OWN_LOSS = 3, 2.0e4, 0.25  # the concealed spring to the ground
FORCE, RESPONSES, NOISE = 5, (1, 3, 5), 0.01


def receptance(hz: np.ndarray, spring: complex = SPRING * (1 + 1j * OWN_LOSS)) -> np.ndarray:
    """(f, n, n) of the chain with a spring at mass AT."""
    a = (2 * np.arange(1, N + 1) - 1) * np.pi / (2 * N + 1)
    shapes = np.sqrt(4 / (MASS * (2 * N + 1))) * np.sin(np.arange(1, N + 1)[:, None] * a)
    squares = 4 * STIFFNESS / MASS * np.sin(a / 2) ** 2
    omega = 2 * np.pi * hz[:, None]
    free = np.einsum("ir,fr,jr->fij", shapes, 1 / (squares * (1 + 1j * LOSS) - omega**2), shapes)
    column = free[:, :, [AT - 1]]
    return free - column @ np.swapaxes(column, 1, 2) * (spring / (1 + spring * column[:, AT - 1]))[:, None]


def main() -> None:
    """Write the file."""
    hz = np.round(np.linspace(2.0, 80.0, 313), 2)
    H = -((2 * np.pi * hz) ** 2)[:, None] * receptance(hz)[:, [j - 1 for j in RESPONSES], FORCE - 1]
    rng = np.random.default_rng(1972)
    H = H + NOISE * np.abs(H) * (rng.standard_normal(H.shape) + 1j * rng.standard_normal(H.shape))
    head = "frequency (Hz)," + ",".join(f"a{j}" for j in RESPONSES)
    rows = [f"{f:.2f}," + ",".join(f"{z.real:.5g}{z.imag:+.5g}j" for z in row) for f, row in zip(hz, H, strict=True)]
    Path(__file__).with_name("functions.csv").write_text("\n".join([head, *rows]) + "\n")


if __name__ == "__main__":
    main()
