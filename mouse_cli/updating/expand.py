"""Measured shapes on all degrees of freedom of the prior model, and how they pass the checks that modes pass."""

import numpy as np

from mouse_cli._errors import ERROR, Diagnostic, NumericalError
from mouse_cli.dynamics.condensation import LooseError
from mouse_cli.dynamics.eigen import EigenSolution
from mouse_cli.dynamics.expansion import Measured, expansion
from mouse_cli.dynamics.frequency import eigenvalue, frequency_hz
from mouse_cli.model.arrays import Matrix
from mouse_cli.model.correlation import ALONE, Expanded
from mouse_cli.model.problem import Problem


def expanded(
    problem: Problem, K: Matrix, M: Matrix, solution: EigenSolution, modes: np.ndarray, basis: np.ndarray, method: str,
    exact: bool,
) -> Expanded | None:  # fmt: skip
    """The measured shapes expanded by `method`; None when none was measured.

    Each at its measured frequency, else at that of its partner. Raises NumericalError when the method has no answer.
    """
    test, chosen = problem.test, expansion(method)
    squared = np.where(modes == ALONE, np.nan, solution.eigenvalues[np.where(modes == ALONE, 0, modes)])
    at = np.where(np.isfinite(test.frequency_hz), eigenvalue(test.frequency_hz), squared)
    kept = np.flatnonzero(np.isfinite(test.shapes).any(axis=0) & np.isfinite(at))
    if not len(kept) or not len(basis):
        return None
    shapes, sd = test.shapes[:, kept], test.shape_sd[:, kept]
    of_model = solution.eigenvalues[basis], solution.shapes[:, basis]
    try:
        found = chosen.expand(Measured(K, M, test.measured_at, shapes, sd, at[kept], *of_model, exact))
    except LooseError as reason:
        raise _refused(problem, method, str(reason)) from None
    error = (test.read(found) - shapes) / sd
    length = np.sqrt(np.einsum("ij,ij->j", found, M @ found))
    unit = np.divide(found, length, out=np.full_like(found, np.nan), where=length > 0)  # a shape of zeros has no scale
    energy = unit.T @ (K @ unit)
    omega = np.sqrt(at[kept])
    return Expanded(
        key=chosen.key,
        title=chosen.title,
        exact=exact or chosen.smooths == "never",
        modes=kept,
        shapes=unit,
        mass=unit.T @ (M @ unit),
        stiffness=energy / np.outer(omega, omega),
        hz=frequency_hz(energy.diagonal()),
        misfit=np.sqrt(np.nanmean(error**2, axis=0)),
    )


def _refused(problem: Problem, method: str, reason: str) -> NumericalError:
    return NumericalError(
        Diagnostic(
            "MD514",
            ERROR,
            f"the shapes measured for '{problem.title.strip()}' cannot be expanded by {method}: {reason}, or the model is too "
            "ill-conditioned for this method",
            problem.place("order"),
            help="use --expand serep, measure at more points, or name a coarser model",
        )
    )
