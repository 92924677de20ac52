"""The lowest modes of a large sparse model: block Lanczos, by residuals, with nothing converged thrown away."""

import numpy as np

from mouse_cli.dynamics.krylov import BLOCK, Krylov, Operator
from mouse_cli.dynamics.workspace import Workspace

INFINITE = 1e-11  # theta below this share of the largest belongs to motions without mass
_ENOUGH = 3  # vectors for each mode wanted: fewer, as a good start leaves, are a poor coarse space for derivatives
_LARGEST = 8  # columns for each mode wanted, beyond which the iteration is given up
_STRANGE = 1e-3  # share of a start from known shapes that is random
_EVERY = 2  # steps between tests of convergence


class NotConverged(np.linalg.LinAlgError):
    """Lanczos did not find the modes wanted."""


def initial_vectors(n: int, count: int) -> int:
    """Vectors that memory is taken for at first: as many as `count` modes usually need."""
    return min(n, 5 * count + 6 * BLOCK)


def start_block(n: int, known: np.ndarray | None, seed: int) -> np.ndarray:
    """BLOCK vectors (BLOCK, n), random but the same in every run: of `known` shapes (n, k) of a similar model, or of everything.

    A little of everything comes with known shapes too: were they those of this model, they would leave nothing but rounding.
    """
    rng = np.random.default_rng(seed)
    if known is None or known.shape[1] < BLOCK:
        return rng.standard_normal((BLOCK, n))
    block = rng.standard_normal((BLOCK, known.shape[1])) @ known.T
    return block + _STRANGE * np.abs(block).max() * rng.standard_normal((BLOCK, n))


def krylov_space(
    operator: Operator,
    count: int,
    tolerance: float,
    known: np.ndarray | None = None,
    workspace: Workspace | None = None,
    notice=lambda text: None,
) -> Krylov:
    """The space in which the lowest `count` modes have residuals below `tolerance` of theta, or all that have mass.

    operator: A = K - sigma M positive definite. Raises NotConverged.
    """
    space = Krylov(operator, initial_vectors(operator.M.shape[0], count), workspace)
    space.start(start_block(space.n, known, 0))
    return refined(space, count, tolerance, notice)


def refined(space: Krylov, count: int, tolerance: float, notice=lambda text: None) -> Krylov:
    """`space`, expanded until the lowest `count` modes have converged."""
    steps, floor = 0, 0.0 if space.operator.refined else INFINITE
    while True:
        alive = space.expand()
        steps += 1
        if not alive:
            alive = _another(space)
        if not alive:
            return space
        if space.reached >= min(_ENOUGH * count, space.n) and steps % _EVERY == 0:
            theta, _, residual = space.ritz()
            theta, residual = theta[:count], residual[:count]
            done = residual <= np.maximum(tolerance * theta, floor * theta[0])
            done |= theta <= INFINITE * theta[0]
            notice(f"{int(done.sum())} of {count} modes found")
            if done.all():
                return space
            if space.reached > _LARGEST * count + 20 * BLOCK:
                if (residual <= INFINITE * theta[0]).all():  # as far as rounding lets residuals fall
                    return space
                raise NotConverged(f"only {int(done.sum())} of {count} modes converged in {space.reached} vectors")


def _another(space: Krylov) -> bool:
    """A new random block where the space is invariant: what lies outside of it was not in the first one."""
    before = space.d
    space.start(start_block(space.n, None, before))
    return space.d > before
