"""Best places for a mass, a spring or an absorber: one thing tried at every place (lecture 22, simplified expressions).

alpha_p(lambda) = sum_r phi_pr^2 / (lambda_r - lambda) + rho_p; mode i with a mass is the root of 1 - lambda m alpha_p = 0
between lambda_{i-1} and lambda_i, with a spring that of 1 + k alpha_p = 0 between lambda_i and lambda_{i+1}. rho_p stands for
modes beyond those found, and is such that alpha_p is exact midway below mode i.
"""

import numpy as np

from mouse_cli.coupling.connections import tuned
from mouse_cli.coupling.receptance import Receptance
from mouse_cli.dynamics.frequency import eigenvalue, frequency_hz
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.coupling import ABSORBER, MASS, Connection, Modification, Point, Sweep
from mouse_cli.model.modified import Place, Swept
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast

_MODES = 30  # of a sparse model
_HALVINGS = 60
_BESIDE = 0.4142  # of the way up to mode i where alpha is found exactly: seldom another eigenvalue


def swept(modification: Modification, sweep: Sweep, problem: Problem, after: Forecast) -> Swept:
    """The places in the order of their effect on the mode, about the model with the changes of the deck."""
    known, mode = Receptance(problem), sweep.mode - 1
    weights, names = known.places(modification, [], mode, after)
    solution = EigenSolver().solve(*known.matrices, min(max(_MODES, 2 * sweep.mode), known.assembly.n))
    lam, moved = np.maximum(solution.eigenvalues, 0.0), (weights @ solution.shapes) ** 2
    hz = float(frequency_hz(lam[mode]))
    if sweep.means == ABSORBER:
        return Swept(sweep, hz, _absorbers(sweep, names, hz, moved[:, mode]))
    rho = _residual(known, weights, lam, moved, mode) if not solution.complete else np.zeros(len(names))
    found = frequency_hz(_roots(sweep, lam, moved, rho, mode))
    order = np.argsort(found if sweep.means == MASS else -found, kind="stable")
    return Swept(sweep, hz, tuple(Place(names[i], float(found[i])) for i in order))


def _residual(known: Receptance, weights: Matrix, lam: np.ndarray, moved: np.ndarray, mode: int) -> np.ndarray:
    """rho (P,): what the modes found leave of the receptance below mode i."""
    beneath = lam[mode - 1] if mode else 0.0
    at = float(beneath + _BESIDE * (lam[mode] - beneath))
    return known.at(at, weights)[0] - (moved / (lam - at)).sum(axis=1)


def _roots(sweep: Sweep, lam: np.ndarray, moved: np.ndarray, rho: np.ndarray, mode: int) -> np.ndarray:
    """Eigenvalues (P,) of the mode with the thing at each place, by bisection: both sides are monotonic between two poles."""
    mass = sweep.means == MASS
    low = np.full(len(moved), lam[mode - 1] if mass and mode else 0.0 if mass else lam[mode])
    top = eigenvalue(1e6) if mode + 1 >= len(lam) else lam[mode + 1]
    high = np.full(len(moved), lam[mode] if mass else top)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            alpha = (moved / (lam - middle[:, None])).sum(axis=1) + rho
        below = 1 - middle * sweep.size * alpha < 0 if mass else 1 + sweep.size * alpha > 0
        high, low = np.where(below, middle, high), np.where(below, low, middle)
    return (low + high) / 2


def _absorbers(sweep: Sweep, names: tuple[str, ...], hz: float, moved: np.ndarray) -> tuple[Place, ...]:
    """Den Hartog's rule at every place: the heavier the absorber by the modal mass 1/phi^2, the lower the peak sqrt(1 + 2/mu)."""
    found = []
    for i in np.argsort(-moved, kind="stable"):
        mu = float(sweep.size * moved[i])
        if mu <= 0:
            found.append(Place(names[i], hz, 0.0))
            continue
        one = tuned(
            Connection("", Point(0, 0), mass=sweep.size, hung=True, tuned_to=sweep.mode), hz, 1 / float(moved[i])
        )
        own = np.sqrt(one.stiffness / one.mass)
        ratio = one.damping / (2 * one.mass * own)
        found.append(Place(names[i], hz, mu, float(own / (2 * np.pi)), float(ratio), float(np.sqrt(1 + 2 / mu))))
    return tuple(found)
