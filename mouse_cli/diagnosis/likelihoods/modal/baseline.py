"""The model as the deck has it, to which causes are added: in all of its modes, or of a large one in a subspace."""

import numpy as np

from mouse_cli.diagnosis.likelihoods.modal.reduced import WHOLE, Reduced, exact
from mouse_cli.diagnosis.likelihoods.modal.subspace import large
from mouse_cli.dynamics.solver import EigenSolver
from mouse_cli.model.problem import Problem
from mouse_cli.terms.assembly import assembly


def reduced(problem: Problem, theta: np.ndarray, solver: EigenSolver | None = None) -> Reduced:
    """The model of `problem` at theta (p,), reduced where it is large; solver: one that may have its modes."""
    total = assembly(problem)
    K, M = total.matrices(theta)
    if K.shape[0] > WHOLE:
        return large(problem, total, K, M, theta, solver)
    return exact(problem, total, K, M, theta)
