"""The three problems on which mouse is compared with its peers: a chain, a clamped beam, a bar of hexahedra."""

from dataclasses import replace

import element_matrices
import numpy as np
from _user_model import UserModel
from scale_models import Block, ElementGroups, Grid, bricks, reference_modes, simulated, spread, with_factors

from mouse_cli.model.problem import Problem
from mouse_cli.model.structure import Structure
from mouse_cli.terms.assembly import Assembly

PRIOR_SD, SPREAD = 0.50, 0.20  # weak prior around 1.0; true factors within so much of 1.0


def chain() -> tuple[Structure, Grid]:
    """Four masses of 1 kg, four springs of 5000 N/m, the first to the ground."""
    spring = 5000.0 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    dofs = np.array([[-1, 0], [0, 1], [1, 2], [2, 3]])
    return Structure(np.zeros((4, 4)), np.eye(4)), Grid(
        4, (Block(dofs, spring, 0 * spring, np.arange(4)),), np.arange(4)
    )


def clamped_beam() -> tuple[Structure, Grid]:
    """A cantilever of 10 m and 100 x 100 mm in 70 elements, deflection and rotation at each node."""
    K, M = (matrix[np.ix_([1, 5, 7, 11], [1, 5, 7, 11])] for matrix in element_matrices.beam(10.0 / 70, 0, 0.1, 0.1))
    dofs = 2 * np.arange(-1, 69)[:, None] + np.arange(4)
    zero = np.zeros((140, 140))
    return Structure(zero, zero), Grid(140, (Block(dofs, K, M, np.arange(70)),), np.arange(0, 140, 2))


def bar() -> tuple[Structure, Grid]:
    """A cantilever of 5 m and 80 x 60 mm in 500 x 8 x 6 hexahedra; sensors at random nodes, across either way."""
    from scipy.sparse import csr_array

    grid = bricks((500, 8, 6), (5.0, 0.08, 0.06))
    zero = csr_array((grid.n, grid.n))
    across = np.flatnonzero(np.arange(grid.n) % 3 > 0)
    return Structure(zero, zero), replace(grid, translations=spread(across, 60))


PROBLEMS = {  # model, stiffness groups, modes, sensors
    "P1": (chain, 4, 4, 4),
    "P2": (clamped_beam, 7, 6, 14),
    "P3": (bar, 8, 6, 60),
}


class PeerProblem:
    """One of PROBLEMS: its truth, and for any draw of the noise the problem for mouse and for a user's own program."""

    def __init__(self, name: str):
        make, self.p, modes, sensors = PROBLEMS[name]
        self.name, (self.structure, grid) = name, make()
        elements = len(grid.blocks[0].rank)
        group = np.arange(elements) * self.p // elements
        self.term = ElementGroups(grid.blocks, {"K": [group], "M": [np.full(elements, -1)]})
        self.assembly = Assembly(self.structure, (self.term,), self.p)
        self.truth = np.random.default_rng(7).uniform(1 - SPREAD, 1 + SPREAD, self.p)
        self.dofs = grid.translations[np.linspace(-1, len(grid.translations) - 1, sensors + 1).astype(int)[1:]]
        K, M = self.assembly.matrices(self.truth)
        if isinstance(K, np.ndarray):
            from scipy.linalg import eigh

            self.eigenvalues, shapes = eigh(K, M, subset_by_index=[0, modes - 1])
        else:
            self.eigenvalues, shapes = reference_modes(K, M, modes)
        self.seen = shapes[self.dofs]

    def draw(self, seed: int) -> tuple[Problem, UserModel]:
        """What mouse and what a user's program is given, with the noise of `seed`."""
        test = simulated(self.eigenvalues, self.seen, self.dofs, np.random.default_rng(seed))
        prior_sd = np.full(self.p, PRIOR_SD)
        problem = with_factors(self.name, self.structure, self.term, prior_sd, test)
        unit = np.eye(self.p)
        K = [self.assembly.matrices(row)[0] for row in unit]
        M = self.assembly.matrices(np.ones(self.p))[1]
        K = np.array(K) if isinstance(M, np.ndarray) else K
        measured = (test.frequency_hz, test.frequency_sd_hz, test.shapes, test.shape_sd)
        return problem, UserModel(K, M, self.dofs, *measured, prior_sd)

    def worst(self, theta: np.ndarray) -> float:
        """Largest relative error of the factors theta (p,)."""
        return float(np.abs(theta / self.truth - 1).max())
