"""Viscous damping that has given ratios in the modes of the prior model: C = M X diag(2 zeta_r omega_r) X'M, X'MX = I.

(Wilson and Penzien 1972.) X and omega are those of the nominal model, so that C follows the ratios alone, linearly; where stiffness
changes by a few per cent, ratios of the revised model differ from zeta by half as many.
"""

from dataclasses import replace

import numpy as np

from mouse_cli._errors import NumericalError
from mouse_cli.dynamics.eigen import dense_solution
from mouse_cli.model.arrays import is_sparse
from mouse_cli.model.modal_damping import ModalDamping
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem
from mouse_cli.model.term import Places, Slopes
from mouse_cli.terms.assembly import assembly
from mouse_cli.terms.further import with_parameters

LARGEST = 400  # degrees of freedom, as C is full
_ROUNDING = 1e-15  # of the largest eigenvalue, for each degree of freedom: what is a rigid-body mode


class ModalDampingTerm:
    """The term; K, M (n, n): of the nominal model. first: number of the first ratio among the parameters; None: they are held."""

    linear = True

    def __init__(self, K: np.ndarray, M: np.ndarray, damping: ModalDamping, first: int | None):
        self.damping, self.first = damping, first
        solution = dense_solution(K, M)
        elastic = solution.eigenvalues > max(solution.zero, _ROUNDING * len(K) * solution.eigenvalues[-1])
        omega, forces = np.sqrt(solution.eigenvalues[elastic]), M @ solution.shapes[:, elastic]
        last = len(damping.ratio) - 1
        group = np.minimum(np.arange(len(omega)), last)
        self._each = np.array(
            [((2 * omega * (group == g)) * forces @ forces.T).ravel() for g in range(len(damping.ratio))]
        )  # of a ratio of 1
        n = len(K)
        self._row, self._col = np.repeat(np.arange(n), n), np.tile(np.arange(n), n)
        self.places = {"C": Places(self._row, self._col)}

    def values(self, theta: np.ndarray) -> dict[str, np.ndarray]:
        """C (n^2,) at theta (p,)."""
        ratio = self.damping.ratio
        if self.first is not None:
            ratio = theta[self.first : self.first + len(ratio)]
        return {"C": ratio @ self._each}

    def slopes(self, theta: np.ndarray) -> dict[str, Slopes]:
        """dC by each ratio."""
        if self.first is None:
            return {}
        count, size = self._each.shape
        parameter = np.repeat(np.arange(self.first, self.first + count), size)
        return {"C": Slopes(parameter, np.tile(self._row, count), np.tile(self._col, count), self._each.ravel())}


def with_modal_damping(problem: Problem) -> Problem:
    """The problem with the term for its `modal_damping`, and its ratios among the parameters; itself where it has none.

    Raises NumericalError (MD519) for models larger than LARGEST.
    """
    damping = problem.modal_damping
    if damping is None:
        return problem
    structure = problem.structure
    if structure.n > LARGEST or is_sparse(structure.K):
        message = f"modal damping of a model of {structure.n} degrees of freedom; its matrix is full, and {LARGEST} are the most"
        help = "give the elements or their material a loss_factor, twice the damping ratio"
        raise NumericalError.of("MD519", message, problem.place("modal_damping"), help=help)
    K, M = assembly(problem).matrices(problem.prior.mean)
    first = len(problem.parameters) if damping.sd else None
    term = ModalDampingTerm(K, M, damping, first)
    found = replace(problem, terms=(*problem.terms, term), modal_damping=None)
    return found if first is None else with_parameters(found, _ratios(damping))


def _ratios(damping: ModalDamping) -> list[Parameter]:
    last = len(damping.ratio)
    names = [f"damping ratio of mode {i}" for i in range(1, last)]
    names.append(f"damping ratio of modes from {last} on" if last > 1 else "damping ratio of all modes")
    return [
        Parameter(name, damping.sd * ratio, ratio, transform="log")
        for name, ratio in zip(names, damping.ratio.tolist(), strict=True)
    ]
