"""Parameters that are added to a problem behind its own."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mouse_cli.model.parameter import Gaussian, Parameter
from mouse_cli.model.problem import Problem


def with_parameters(problem: Problem, new: Sequence[Parameter]) -> Problem:
    """The deck with further parameters behind its own, which no listed element follows and the prior holds independent."""
    A, prior = problem.A, problem.prior
    if not new:
        return problem
    if hasattr(A, "tocsr"):
        from scipy.sparse import csr_array, hstack

        A = csr_array(hstack([A, csr_array((A.shape[0], len(new)))]))
    else:
        A = np.hstack([A, np.zeros((A.shape[0], len(new)))])
    sd, p = np.array([each.sd for each in new]), len(prior.mean)
    cov = np.append(prior.cov, sd**2) if prior.cov.ndim == 1 else np.zeros((p + len(new), p + len(new)))
    if prior.cov.ndim == 2:
        cov[:p, :p], cov[range(p, len(cov)), range(p, len(cov))] = prior.cov, sd**2
    mean = np.append(prior.mean, [each.nominal for each in new])
    return replace(problem, A=A, parameters=problem.parameters + tuple(new), prior=Gaussian(mean, cov))
