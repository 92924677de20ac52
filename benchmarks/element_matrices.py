"""Stiffness and mass matrices of one element each, by closed form or exact quadrature, for models made of repeated elements."""

import numpy as np

STEEL = 210e9, 0.3, 7850.0  # Young's modulus in N/m^2, Poisson's ratio, density in kg/m^3


def brick(hx: float, hy: float, hz: float) -> tuple[np.ndarray, np.ndarray]:
    """K, M (24, 24) of the eight-node hexahedron with edges hx, hy, hz in m; degrees of freedom node by node.

    Trilinear shape functions, 2 x 2 x 2 Gauss points (Hughes 1987); consistent mass. Nodes in the order of
    `np.ndindex(2, 2, 2)`: z fastest.
    """
    E, nu, rho = STEEL
    lame, shear = E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))
    D = np.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lame
    corner = 2.0 * np.array(list(np.ndindex(2, 2, 2))) - 1
    K, M = np.zeros((24, 24)), np.zeros((24, 24))
    for point in corner / np.sqrt(3):
        factor = (1 + corner * point) / 2
        N = factor.prod(axis=1)
        slope = np.stack([corner[:, i] / 2 * np.delete(factor, i, 1).prod(axis=1) for i in range(3)])
        dx, dy, dz = 2 * slope / np.array([[hx], [hy], [hz]])
        B = np.zeros((6, 24))
        B[0, 0::3], B[1, 1::3], B[2, 2::3] = dx, dy, dz
        B[3, 0::3], B[3, 1::3] = dy, dx
        B[4, 1::3], B[4, 2::3] = dz, dy
        B[5, 0::3], B[5, 2::3] = dz, dx
        K += B.T @ D @ B * (hx * hy * hz / 8)
        M += np.kron(np.outer(N, N), np.eye(3)) * (rho * hx * hy * hz / 8)
    return K, M


def plate(hx: float, hy: float, thickness: float) -> tuple[np.ndarray, np.ndarray]:
    """K, M (12, 12) of the rectangular plate-bending element of Adini, Clough and Melosh; w, dw/dy, -dw/dx node by node.

    Cubic in each direction, w = sum of 12 monomials (Adini and Clough 1960, Melosh 1963); consistent mass. Nodes in the
    order of `np.ndindex(2, 2)`: y fastest. Worked out in coordinates from -1 to 1, where it is well conditioned.
    """
    E, nu, rho = STEEL
    bending = E * thickness**3 / (12 * (1 - nu**2))
    D = bending * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
    power = np.array([(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (1, 3)])

    def monomials(x: float, y: float, i: int, j: int) -> np.ndarray:
        """d^(i+j) / dx^i dy^j of each monomial."""
        a, b = power[:, 0], power[:, 1]
        falling = np.prod([a - k for k in range(i)], axis=0) * np.prod([b - k for k in range(j)], axis=0)
        return falling * x ** np.maximum(a - i, 0) * y ** np.maximum(b - j, 0) * ((a >= i) & (b >= j))

    rx, ry = hx / 2, hy / 2
    nodes = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
    rows = [r for n in nodes for r in (monomials(*n, 0, 0), monomials(*n, 0, 1) / ry, -monomials(*n, 1, 0) / rx)]
    shape = np.linalg.inv(np.array(rows))
    K, M = np.zeros((12, 12)), np.zeros((12, 12))
    points, weights = np.polynomial.legendre.leggauss(4)
    rule = list(zip(points, weights, strict=True))
    for (x, wx), (y, wy) in [(a, b) for a in rule for b in rule]:
        N = monomials(x, y, 0, 0) @ shape
        B = np.array(
            [-monomials(x, y, 2, 0) / rx**2, -monomials(x, y, 0, 2) / ry**2, -2 * monomials(x, y, 1, 1) / rx / ry]
        )
        B = B @ shape
        K += B.T @ D @ B * (wx * wy * rx * ry)
        M += np.outer(N, N) * (wx * wy * rx * ry * rho * thickness)
    return K, M


def beam(length: float, axis: int, width: float, height: float) -> tuple[np.ndarray, np.ndarray]:
    """K, M (12, 12) of the Bernoulli-Euler beam along global `axis`, section width x height; six degrees of freedom a node.

    Axial, torsional and two bending parts, consistent mass (Przemieniecki 1968, without shear).
    """
    E, nu, rho = STEEL
    A, Iy, Iz = width * height, width * height**3 / 12, height * width**3 / 12
    thin = min(width, height) / max(width, height)
    J = max(width, height) * min(width, height) ** 3 * (1 / 3 - 0.21 * thin * (1 - thin**4 / 12))
    K, M, L = np.zeros((12, 12)), np.zeros((12, 12)), length
    rod, rod_mass = np.array([[1, -1], [-1, 1]]) / L, np.array([[2, 1], [1, 2]]) * (L / 6)
    for first, stiffness, inertia in ((0, E * A, rho * A), (3, E / (2 * (1 + nu)) * J, rho * (Iy + Iz))):
        at = np.ix_([first, first + 6], [first, first + 6])
        K[at] += stiffness * rod
        M[at] += inertia * rod_mass
    bend = np.array([[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2]])
    bend = np.vstack([bend, -bend[0], [6 * L, 2 * L**2, -6 * L, 4 * L**2]]) / L**3
    mass = np.array([[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2]])
    mass = np.vstack([mass, [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L**2, -22 * L, 4 * L**2]]) * (L / 420)
    for dofs, sign, inertia in (([1, 5, 7, 11], 1.0, Iz), ([2, 4, 8, 10], -1.0, Iy)):
        turn = np.outer([1, sign, 1, sign], [1, sign, 1, sign])
        K[np.ix_(dofs, dofs)] += E * inertia * bend * turn
        M[np.ix_(dofs, dofs)] += rho * A * mass * turn
    order = np.concatenate(
        [3 * part + (np.arange(3) - axis) % 3 for part in range(4)]
    )  # local axes, permuted cyclically
    return K[np.ix_(order, order)], M[np.ix_(order, order)]
